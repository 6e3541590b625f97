using System;
using System.IO;

namespace LagSim.Build;

/// <summary>Takes out of an assembly's XML documentation what only the assembly itself can use.</summary>
/// <remarks>The compiler writes down every member that has a comment. To who has the package, the others are names that he cannot call.</remarks>
internal static class Program
{
    private static int Main(string[] args)
    {
        if (args is not [string assembly, string docs])
        {
            Console.Error.WriteLine("PublicDocs ASSEMBLY DOCUMENTATION: leaves the public members in the documentation.");
            return 2;
        }

        try
        {
            File.WriteAllText(docs, PublicDocs.Prune(DocumentedMembers.Of(assembly), File.ReadAllText(docs)));
            return 0;
        }
        catch (Exception failure) when (failure is InvalidDataException or IOException or BadImageFormatException)
        {
            Console.Error.WriteLine($"{docs} : error LAGSIM003: {failure.Message}");
            return 1;
        }
    }
}
