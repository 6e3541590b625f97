using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>
/// A tall column of balls falls into a narrow shaft. The lowest contacts carry the weight of a hundred layers while impacts from above
/// continue.
/// </summary>
/// <param name="balls">The number of balls.</param>
/// <param name="seconds">The simulated time, in seconds.</param>
internal sealed class ShaftWork(int balls = 1000, double seconds = 3) : ContactWork
{
    private const double Radius = 0.1;
    private const double Half = 0.4;
    private const double Friction = 0.3;
    private const double Restitution = 0.2;
    private const ulong Seed = 1000;

    public override string Name => "shaft";

    public override string Title => string.Create(
        CultureInfo.InvariantCulture,
        $"{balls} balls of r {Radius} m with friction {Friction} and restitution {Restitution} fall"
            + $" into a shaft of {2 * Half} m by {2 * Half} m, {seconds} s");

    public override double Seconds => seconds;

    public override IReadOnlyList<string> ErrorKinds { get; } = [Overlap, EnergyGain];

    public override WorkScene Small => new ShaftWork(30, 0.5);

    private protected override SceneBuilder Begin()
    {
        BodySpec ball = new(Radius, 1, Restitution, friction: Friction);
        return Pit.Pour(
            Pit.Dig(new SceneBuilder(Name), Half), [.. Enumerable.Repeat(ball, balls)], Radius, Half, 3 * Radius, new SeededRandom(Seed));
    }
}
