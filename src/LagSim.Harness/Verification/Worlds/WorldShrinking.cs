using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>Leaves out one act after another as long as the world fails in the same way.</summary>
/// <remarks>Deterministic. The effort is bounded by the number of replays.</remarks>
internal static class WorldShrinking
{
    /// <summary>Returns the outcome with the least acts that were found to fail in the same way.</summary>
    internal static WorldOutcome Shrink(WorldOutcome whole, WorldOptions options, CancellationToken cancellation)
    {
        WorldScene world = WorldPlay.DrawScene(whole.Seed);
        List<ExternalEvent> least = [.. WorldPlay.DrawActs(whole.Seed, world, options, cancellation).All];
        int plays = options.ShrinkingPlays;
        for (int n = least.Count - 1; n >= 0 && plays > 0; n--)
        {
            List<ExternalEvent> without = [.. least.Where((_, i) => i != n)];
            plays--;
            WorldOutcome played = WorldPlay.Of(whole.Seed, world, without, options, cancellation);
            if (played.FailureKind == whole.FailureKind && played.Promise == whole.Promise)
            {
                least = without;
            }
        }

        return whole with { LeastActs = [.. least.Select(Text)] };
    }

    private static string Text(ExternalEvent act) => FormattableString.Invariant(
        $"{act.Time.ToSeconds():R} s {act.Kind} of {act.Body} by {act.Peer}.{act.Sequence} ({act.WhenOccupied}) at {act.Position} with {act.Velocity}");
}
