using System;
using System.Linq;
using ArchUnitNET.Domain;
using ArchUnitNET.Loader;

namespace LagSim.Tests.Architecture;

/// <summary>Which type uses which, read from compiled code: bases, signatures, attributes and the bodies of methods and lambdas.</summary>
/// <remarks>Two uses leave no trace there: a constant, whose value is copied, and <c>nameof</c>.</remarks>
internal static class Arrows
{
    internal static Arrow[] Between(ArchLoader loaded) => loaded.Build().Types
        .SelectMany(type => type.Dependencies.Where(use => use.Target is not GenericParameter).Select(use => (From: type, To: use.Target)))
        .Where(use => Folder(use.From).Length > 0 && Folder(use.To).Length > 0)
        .Select(use => new Arrow(Folder(use.From), Outermost(use.From), Folder(use.To), Outermost(use.To)))
        .Where(arrow => arrow.From != arrow.To)
        .Distinct()
        .ToArray();

    /// <summary>The folder below <c>src</c>, by the house rule that a folder is a namespace; empty for types of others and of the compiler.</summary>
    private static string Folder(IType type)
    {
        string space = type.Namespace?.FullName ?? "";
        if (!space.StartsWith("LagSim", StringComparison.Ordinal))
        {
            return "";
        }

        // What could not be found has no assembly: it is of a package, for all of ours are loaded.
        string project = type.Assembly.Name.Split(',')[0];
        return space.StartsWith(project + ".", StringComparison.Ordinal) ? project + space[project.Length..].Replace('.', '/') : project;
    }

    private static string Outermost(IType type) => type.FullName.Split('+')[0];
}
