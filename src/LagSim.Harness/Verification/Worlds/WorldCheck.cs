using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Threading;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>
/// The check of single worlds: none ends by what players do, each has the same bits however late its events come, and keeps the promises
/// about its physics.
/// </summary>
/// <remarks>Each world is drawn from its own seed and played on one thread, so every figure except the time taken is the same in every
/// run.</remarks>
public static class WorldCheck
{
    /// <summary>The most failing worlds of which acts are left out.</summary>
    public const int MaxShrunk = 3;

    /// <summary>Plays all worlds, several at a time.</summary>
    /// <param name="options">The options.</param>
    /// <param name="progress">Called from time to time on the caller's thread with the number of finished worlds; may be null.</param>
    /// <param name="cancellation">Ends it early, with a report of the worlds that were done by then.</param>
    public static WorldReport Run(WorldOptions options, Action<int>? progress = null, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(options);
        ArgumentOutOfRangeException.ThrowIfLessThan(options.Worlds, 1);
        ArgumentOutOfRangeException.ThrowIfLessThan(options.Workers, 1);
        Stopwatch watch = Stopwatch.StartNew();
        (IReadOnlyList<WorldOutcome> played, _) = ParallelPlay.Run(
            options.Worlds, options.Workers, "LagSim worlds", n => WorldPlay.Of(unchecked(options.Seed + (ulong)n), options, cancellation), progress, cancellation);
        return new WorldReport(Shrunk([.. played], options, cancellation), options.Worlds,
            watch.Elapsed.TotalSeconds);
    }

    private static WorldOutcome[] Shrunk(WorldOutcome[] outcomes, WorldOptions options, CancellationToken cancellation)
    {
        int left = options.ShrinkingPlays > 0 ? MaxShrunk : 0;
        for (int n = 0; n < outcomes.Length && left > 0; n++)
        {
            if (outcomes[n].FailureKind == WorldFailureKind.None)
            {
                continue;
            }

            left--;
            try
            {
                outcomes[n] = WorldShrinking.Shrink(outcomes[n], options, cancellation);
            }
            catch (OperationCanceledException) when (cancellation.IsCancellationRequested)
            {
                return outcomes;
            }
        }

        return outcomes;
    }
}
