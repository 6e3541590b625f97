using LagSim.Scenes;

namespace LagSim.Corpus;

/// <summary>A ball on a spring to (0, 2, 0), in air that brakes it with the square of its speed.</summary>
public sealed class DragAndSpring : IAcceleration
{
    private const double StiffnessPerMass = 12.5;
    private const double DragPerMetre = 0.07;

    public string Name => "corpus drag and spring";

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) =>
        ((new Vector3D(0, 2, 0) - position) * StiffnessPerMass) - (velocity * (DragPerMetre * velocity.Length));
}
