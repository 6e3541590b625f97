using System;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>Bodies are at finite places, within the coordinates that a scene may have, with finite velocities and spins.</summary>
internal sealed class PlacePromise : WorldPromise
{
    private const double Far = 1e12; // metres

    internal override string Name => "place";

    internal override void Look(WorldMoment moment)
    {
        foreach (WorldBody body in moment.Bodies)
        {
            BodyState state = body.State;
            double furthest = Math.Max(Math.Abs(state.Position.X), Math.Max(Math.Abs(state.Position.Y), Math.Abs(state.Position.Z)));
            if (!state.Position.IsFinite || !state.Velocity.IsFinite || !state.Spin.IsFinite || furthest > Far)
            {
                Break(moment, string.Create(Invariant, $"{body.Id} is at {state.Position} m with {state.Velocity} m/s."));
            }
        }
    }
}
