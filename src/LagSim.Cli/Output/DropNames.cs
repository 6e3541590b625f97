using LagSim.Harness.Experiments.Drop;

namespace LagSim.Cli.Output;

/// <summary>The names of the harness's values in JSON and CSV.</summary>
internal static class DropNames
{
    internal static string Case(DropCase which) => which == DropCase.SameStart ? "same-start" : "teleport";

    internal static string Time(DropOptions options) => options.IsVirtual ? "virtual" : "real";

    /// <summary>The name of the carrier. In virtual time there is no socket.</summary>
    internal static string Transport(DropOptions options) => options.IsVirtual ? "virtual" : options.Carrier.Name;
}
