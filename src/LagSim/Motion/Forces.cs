using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>The acceleration of a free body: uniform gravity, and what the scene supplies for it. Time is counted from the scene's start.</summary>
internal readonly struct Forces
{
    private readonly Scene scene;
    private readonly SimTime start;

    internal Forces(Scene scene, SimTime start)
    {
        this.scene = scene;
        this.start = start;
    }

    internal Vector3D At(byte supplied, SimTime epoch, double seconds, in Vector3D position, in Vector3D velocity) =>
        supplied == 0
            ? scene.Gravity
            : scene.Gravity + scene.AccelerationArray[supplied - 1].At(epoch.SecondsSince(start) + seconds, position, velocity);
}
