using System;
using System.Threading;

namespace LagSim.Harness.Verification.Check;

/// <summary>Draws a session from a seed, plays it, and evaluates the result.</summary>
internal static class CheckSession
{
    /// <summary>Plays the session of a seed, or the parts of it in the options.</summary>
    /// <exception cref="OperationCanceledException">It was asked to stop before the end: there is no outcome.</exception>
    internal static CheckOutcome Play(ulong seed, CheckOptions options, CancellationToken cancellation)
    {
        CheckCase drawn = new(seed, options, cancellation);

        // Linked, since the token of all sessions would keep these peers alive.
        using CancellationTokenSource stop = CancellationTokenSource.CreateLinkedTokenSource(cancellation);
        CheckPlay play = new(drawn, options, stop.Token);
        CheckOutcome outcome = new() { Seed = drawn.Seed, Bodies = drawn.BodyIndices, Actions = drawn.ActionIndices };
        string? failure;
        try
        {
            failure = play.Run(CheckPlan.Of(drawn));
            if (failure is null)
            {
                return CheckJudgement.Of(outcome, drawn, play.Members, play.Log, options, stop.Token);
            }
        }
        catch (TooManyEventsException)
        {
            return outcome with { IsUnfinished = true, Peers = play.Members.Count };
        }
        catch (Exception thrown) when (thrown is not OperationCanceledException and not OutOfMemoryException)
        {
            string[] stack = (thrown.GetBaseException().StackTrace ?? "").Split('\n');
            string? place = Array.Find(stack, line => line.Contains(" LagSim.", StringComparison.Ordinal))?.Trim();
            failure = $"{thrown.GetType().Name}: {thrown.Message} ({place})";
        }

        return outcome with { Failure = failure, Peers = play.Members.Count, TooLateEvents = play.Log.TooLate };
    }
}
