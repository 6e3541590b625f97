using System.Linq;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>Nothing sleeps deeper in anything than the contact tolerance, and half of it again for what solvers leave.</summary>
internal sealed class RestPromise : WorldPromise
{
    private const double Most = 1.5;

    internal override string Name => "rest";

    internal override void Look(WorldMoment moment)
    {
        if (moment.Depths.FirstOrDefault(d => d.IsAsleep && d.Metres > Most * moment.Scene.ContactTolerance) is WorldDepth deep)
        {
            Break(moment, string.Create(Invariant,
                $"{deep} rests {deep.Metres:G4} m deep; the tolerance is {moment.Scene.ContactTolerance:G3} m."));
        }
    }
}
