using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Testing.Text;

namespace LagSim.Harness.SceneFiles;

/// <summary>The names of the motion laws in scene files, tables and on the command line.</summary>
public static class MotionNames
{
    private static readonly string[] FlightNames = ["ballistic", "rk4", "closed-form", "dp54", "auto"];

    /// <summary>The laws that a scene can choose for a body.</summary>
    public static IReadOnlyList<string> Flight => FlightNames;

    /// <summary>Returns the name of any law, including those that a scene cannot choose.</summary>
    public static string Of(MotionLaw law) => MotionText.Of(law);

    /// <summary>Finds the law of a name; false if there is none.</summary>
    public static bool TryParseFlight(string name, out MotionLaw law)
    {
        law = name switch
        {
            "ballistic" => MotionLaw.Ballistic,
            "rk4" => MotionLaw.RungeKutta4,
            "closed-form" => MotionLaw.ClosedForm,
            "dp54" => MotionLaw.DormandPrince54,
            "auto" => MotionLaw.Automatic,
            _ => MotionLaw.Absent,
        };
        return law != MotionLaw.Absent;
    }

    /// <summary>Returns the laws as listed in an error: <c>"ballistic", "rk4"</c>.</summary>
    internal static string Quoted => "\"" + string.Join("\", \"", FlightNames) + "\"";
}
