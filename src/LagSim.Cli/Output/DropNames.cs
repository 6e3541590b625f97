using LagSim.Harness.Drop;
using LagSim.Scenes;

namespace LagSim.Cli.Output;

/// <summary>The words of the contract for what the harness has as values.</summary>
internal static class DropNames
{
    internal static string Case(DropCase which) => which == DropCase.SameStart ? "same-start" : "teleport";

    internal static string Motion(MotionLaw law) => law switch
    {
        MotionLaw.RungeKutta4 => "rk4",
        MotionLaw.Ballistic => "ballistic",
        MotionLaw.Sliding => "sliding",
        MotionLaw.Resting => "resting",
        _ => "absent",
    };

    internal static string Time(DropOptions options) => options.IsVirtual ? "virtual" : "real";
}
