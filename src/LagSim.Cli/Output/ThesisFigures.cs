namespace LagSim.Cli.Output;

/// <summary>What the thesis's published logs give for the height error of its drop tests, in metres (Zonnenberg, TU Delft 2024).</summary>
internal static class ThesisFigures
{
    internal const double SameStart = 0;
    internal const double TeleportMax = 0.084;
    internal const double TeleportMean = 0.022;
    internal const double TeleportRms = 0.029;
}
