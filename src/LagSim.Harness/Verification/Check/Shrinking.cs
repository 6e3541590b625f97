using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;

namespace LagSim.Harness.Verification.Check;

/// <summary>
/// Finds the least of a failing session that still fails, by delta debugging (Zeller and Hildebrandt 2002): first the actions, then the
/// bodies.
/// </summary>
/// <remarks>Deterministic. The effort is bounded by the number of replays.</remarks>
internal sealed class Shrinking
{
    private readonly ulong seed;
    private readonly CheckOptions options;
    private readonly CancellationToken cancellation;
    private int plays;

    private Shrinking(CheckOutcome whole, CheckOptions options, CancellationToken cancellation)
    {
        seed = whole.Seed;
        this.options = options;
        this.cancellation = cancellation;
        Least = whole;
        plays = options.ShrinkingPlays;
    }

    private CheckOutcome Least { get; set; }

    /// <summary>The least that was found to fail.</summary>
    internal static CheckOutcome Shrink(CheckOutcome whole, CheckOptions options, CancellationToken cancellation)
    {
        Shrinking shrinking = new(whole, options, cancellation);
        try
        {
            shrinking.Run();
        }
        catch (OperationCanceledException) when (cancellation.IsCancellationRequested)
        {
            // The least that was found so far.
        }

        return shrinking.Least;
    }

    private void Run()
    {
        int before;
        do
        {
            before = Size;
            Reduce(Least.Actions, FailsWithActions);
            Reduce(Least.Bodies, FailsWithBodies);
        }
        while (Size < before && CanPlay);
    }

    private int Size => Least.Actions.Count + Least.Bodies.Count;

    private bool CanPlay => plays > 0 && !cancellation.IsCancellationRequested;

    /// <summary>Leaves out a half, a quarter and so on, down to one at a time, as long as the rest fails.</summary>
    private void Reduce(IReadOnlyList<int> all, Predicate<IReadOnlyList<int>> fails)
    {
        IReadOnlyList<int> kept = all;
        if (kept.Count > 0 && CanPlay && fails([]))
        {
            return;
        }

        for (int size = Math.Max(1, kept.Count / 2); kept.Count > 0 && CanPlay; size = Math.Max(1, size / 2))
        {
            bool any = false;
            for (int from = 0; from < kept.Count && CanPlay;)
            {
                int[] without = [.. kept.Take(from), .. kept.Skip(from + size)];
                if (without.Length < kept.Count && fails(without))
                {
                    kept = without;
                    any = true;
                }
                else
                {
                    from += size;
                }
            }

            if (size == 1 && !any)
            {
                return;
            }
        }
    }

    private bool FailsWithActions(IReadOnlyList<int> actions) => Fails(Least.Bodies, actions);

    private bool FailsWithBodies(IReadOnlyList<int> bodies) => bodies.Count > 0 && Fails(bodies, Least.Actions);

    private bool Fails(IReadOnlyList<int> bodies, IReadOnlyList<int> actions)
    {
        plays--;
        CheckOutcome outcome = CheckSession.Play(seed, options with { Bodies = bodies, Events = actions }, cancellation);
        if (outcome.Failure is null)
        {
            return false;
        }

        Least = outcome;
        return true;
    }
}
