namespace LagSim.Cli.Output;

/// <summary>The height errors of drop tests in the thesis's published logs, in metres (Zonnenberg, TU Delft 2024).</summary>
internal static class ThesisFigures
{
    internal const double SameStart = 0;
    internal const double TeleportMax = 0.084;
    internal const double TeleportMean = 0.022;
    internal const double TeleportRms = 0.029;
}
