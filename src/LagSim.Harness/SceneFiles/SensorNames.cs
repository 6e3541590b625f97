using System;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>The names of the shapes and coverages of sensors in scene files.</summary>
internal static class SensorNames
{
    internal const string Plane = "plane";

    internal const string Sphere = "sphere";

    private static readonly string[] Coverages = ["centre", "part", "whole"];

    /// <summary>Returns the coverages, as listed in an error.</summary>
    internal static string QuotedCoverages => "\"" + string.Join("\", \"", Coverages) + "\"";

    internal static string Of(SensorShape shape) => shape == SensorShape.Plane ? Plane : Sphere;

    internal static string Of(SensorCoverage coverage) => Coverages[(int)coverage];

    internal static bool TryParse(string name, out SensorCoverage coverage)
    {
        int at = Array.IndexOf(Coverages, name);
        coverage = (SensorCoverage)Math.Max(at, 0);
        return at >= 0;
    }
}
