using LagSim.Scenes;

namespace LagSim.Testing.Text;

/// <summary>What a motion law is called in an error and in a scene file.</summary>
internal static class MotionText
{
    /// <summary>The name of any law, those a scene cannot choose included.</summary>
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
