using System.Linq;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>What players did not put into one another is no deeper in one another than a few contact tolerances.</summary>
internal sealed class DepthPromise(WorldScene world) : WorldPromise
{
    private readonly Overlaps overlaps = new(world);

    internal override string Name => "depth";

    internal override void Look(WorldMoment moment)
    {
        overlaps.Look(moment);
        if (!overlaps.ArePutIn && moment.Depths.FirstOrDefault(d => d.Metres > Overlaps.Bound(moment, d)) is WorldDepth deep)
        {
            Break(moment, string.Create(Invariant,
                $"{deep} is {deep.Metres:G4} m deep; the tolerance is {moment.Scene.ContactTolerance:G3} m, so {Overlaps.Bound(moment, deep):G3} m at most."));
        }
    }
}
