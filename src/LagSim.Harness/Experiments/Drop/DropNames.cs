namespace LagSim.Harness.Experiments.Drop;

/// <summary>The names of the harness's values in JSON and CSV.</summary>
public static class DropNames
{
    /// <summary>The name of a case.</summary>
    public static string Case(DropCase which) => which == DropCase.SameStart ? "same-start" : "teleport";

    /// <summary>The name of the time that a test runs in.</summary>
    public static string Time(DropOptions options) => options.IsVirtual ? "virtual" : "real";

    /// <summary>The name of the carrier. In virtual time there is no socket.</summary>
    public static string Transport(DropOptions options) => options.IsVirtual ? "virtual" : options.Carrier.Name;
}
