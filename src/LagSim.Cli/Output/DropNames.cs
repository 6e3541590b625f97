using LagSim.Harness.Experiments.Drop;

namespace LagSim.Cli.Output;

/// <summary>The words of the contract for what the harness has as values.</summary>
internal static class DropNames
{
    internal static string Case(DropCase which) => which == DropCase.SameStart ? "same-start" : "teleport";

    internal static string Time(DropOptions options) => options.IsVirtual ? "virtual" : "real";

    /// <summary>What carried the datagrams: no socket has a part in virtual time.</summary>
    internal static string Transport(DropOptions options) => options.IsVirtual ? "virtual" : options.Carrier.Name;
}
