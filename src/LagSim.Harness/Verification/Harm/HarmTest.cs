using System;
using System.Collections.Generic;
using System.Threading;

namespace LagSim.Harness.Verification.Harm;

/// <summary>
/// Runs seeded attacks by one player. The other players' worlds must stay in real time, or be back in it soon after the attacker is out.
/// </summary>
/// <remarks>In virtual time, each attack on one thread from its seed, so every figure is the same in every run.</remarks>
public static class HarmTest
{
    /// <summary>Runs all attacks, several at a time.</summary>
    /// <param name="options">The attacks to run.</param>
    /// <param name="progress">Called with each outcome as it is ready, on any thread but never on two at once; may be null.</param>
    /// <param name="cancellation">Ends the test early. The outcomes so far are returned.</param>
    /// <returns>One outcome for each attack, in the order of seeds.</returns>
    public static IReadOnlyList<HarmOutcome> Run(HarmOptions options, Action<HarmOutcome>? progress = null, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(options);
        return ParallelPlay.Run(
            options.Attacks, options.Workers, "LagSim harm",
            (n, stop) => new HarmRun(new HarmCase(options.Seed + (ulong)n), options, stop).Play(), progress, cancellation);
    }
}
