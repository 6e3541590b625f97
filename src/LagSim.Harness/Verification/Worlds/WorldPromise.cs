using System.Collections.Generic;
using System.Globalization;
using LagSim.Time;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>A promise about the physics of any world, watched from instant to instant.</summary>
internal abstract class WorldPromise
{
    /// <summary>How numbers are written.</summary>
    protected static CultureInfo Invariant => CultureInfo.InvariantCulture;

    /// <summary>Its name, as reports have it.</summary>
    internal abstract string Name { get; }

    /// <summary>How it was broken first, as a sentence; null if it was not.</summary>
    internal string? Broken { get; private set; }

    /// <summary>The promises that are held to a world.</summary>
    internal static IReadOnlyList<WorldPromise> All(WorldScene world) =>
    [
        new PlacePromise(), new SpeedPromise(world), new EnergyPromise(world), new MomentumPromise(world), new DepthPromise(world),
            new RestPromise(), new CarryPromise(),
        new ReboundPromise(),
    ];

    /// <summary>Looks at a world at an instant, later than those before.</summary>
    internal virtual void Look(WorldMoment moment)
    {
    }

    /// <summary>Looks at all that has happened, at the end.</summary>
    internal virtual void Finish(WorldMoment end, IReadOnlyCollection<SimTime> ticksOfActs)
    {
    }

    /// <summary>Notes that it was broken, if it is for the first time.</summary>
    protected void Break(WorldMoment at, string how) => Broken ??= string.Create(Invariant, $"{Name} at {at.Seconds:0.######} s: {how}");
}
