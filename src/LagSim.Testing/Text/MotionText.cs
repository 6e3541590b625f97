using LagSim.Scenes;

namespace LagSim.Testing.Text;

/// <summary>The names of motion laws in errors and scene files.</summary>
internal static class MotionText
{
    /// <summary>The name of any law, including those a scene cannot choose.</summary>
    internal static string Of(MotionLaw law) => law switch
    {
        MotionLaw.Ballistic => "ballistic",
        MotionLaw.RungeKutta4 => "rk4",
        MotionLaw.ClosedForm => "closed-form",
        MotionLaw.DormandPrince54 => "dp54",
        MotionLaw.Automatic => "auto",
        _ => law.ToString().ToLowerInvariant(),
    };
}
