using System;
using System.IO;

namespace LagSim.Corpus;

/// <summary>Replays a folder of recordings on the runtime that runs it: <c>LagSim.Corpus FOLDER</c>. <c>.ci/corpus</c> runs it on all there are.</summary>
internal static class Program
{
    private static int Main(string[] arguments)
    {
        if (arguments.Length != 1)
        {
            Console.Error.WriteLine("usage: LagSim.Corpus FOLDER, a folder of recordings (*.lagsim)");
            return 2;
        }

        try
        {
            return CorpusCheck.Run(arguments[0], Console.Out);
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException)
        {
            Console.Error.WriteLine(failure.Message);
            return 3;
        }
    }
}
