using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>Checks a scene in a periodic box: what goes with one, and that bodies start inside.</summary>
internal static class PeriodicBoxCheck
{
    /// <exception cref="SceneException">Something is not valid; the sentence names the value and what is allowed.</exception>
    internal static void Throw(
        string scene, in PeriodicBox box, in Vector3D gravity, int planes, int spheres, int forces, int sensors, List<SceneBody> bodies)
    {
        if (gravity != Vector3D.Zero || planes + spheres + forces > 0)
        {
            throw new SceneException(
                $"Scene '{scene}' has a periodic box, gravity {gravity} m/s^2, {Limits.Count(planes, "plane")},"
                + $" {Limits.Count(spheres, "static sphere")} and {Limits.Count(forces, "other force")}; a periodic box goes with none of"
                + " those.");
        }

        if (sensors > 0)
        {
            throw new SceneException(
                $"Scene '{scene}' has a periodic box and {Limits.Count(sensors, "sensor")}; a periodic box goes with none.");
        }

        foreach (SceneBody body in bodies)
        {
            Limits.CheckInBox(body.Spec, body.Position, box, SceneBuilder.Whose(body));
        }
    }
}
