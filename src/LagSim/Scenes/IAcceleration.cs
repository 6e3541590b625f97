namespace LagSim.Scenes;

/// <summary>
/// An acceleration a(t, x, v) of a program's own, which acts as a <see cref="Force"/> besides uniform gravity on the bodies that name it.
/// </summary>
/// <remarks>
/// It must be a pure function and deterministic under the rules of the simulated world: only <c>+ - * /</c>, square root and comparison on
/// <see cref="double"/>. It is called on the simulation's thread, five to seven times a step and body; it must not allocate if the event
/// path shall not.
/// </remarks>
public interface IAcceleration
{
    /// <summary>The name of the force, 1 to 64 characters; it is part of the scene's hash.</summary>
    string Name { get; }

    /// <summary>The author's version, raised with every change of a result; it is part of the scene's hash.</summary>
    int Version { get; }

    /// <summary>
    /// The acceleration in metres per second squared, whatever the body's mass. A result that is not finite, or an exception, ends the
    /// simulation with a <see cref="SimulationException"/>.
    /// </summary>
    /// <param name="seconds">Seconds since the start of the scene.</param>
    /// <param name="position">The body's centre in metres.</param>
    /// <param name="velocity">The body's velocity in metres per second.</param>
    Vector3D At(double seconds, in Vector3D position, in Vector3D velocity);
}
