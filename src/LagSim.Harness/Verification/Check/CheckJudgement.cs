using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Threading;
using LagSim.Harness.Reports;
using LagSim.Testing.Invariant;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Harness.Verification.Check;

/// <summary>Compares every peer's world of a played session with a reference that has all events on time.</summary>
internal static class CheckJudgement
{
    /// <summary>Returns the outcome of a session.</summary>
    /// <param name="outcome">The session, and the parts of it that were played.</param>
    /// <param name="drawn">The session as drawn.</param>
    /// <param name="members">Its peers, the host first.</param>
    /// <param name="log">The host's verdicts on every event.</param>
    /// <param name="options">The options of the check.</param>
    /// <param name="cancellation">Stops the comparison.</param>
    internal static CheckOutcome Of(
        CheckOutcome outcome,
        CheckCase drawn,
        IReadOnlyList<CheckMember> members,
        HostLog log,
        CheckOptions options,
        CancellationToken cancellation)
    {
        SimTime end = members.Where(m => m.Session.World is not null).Max(m => m.Session.World!.Simulation.SimulatedTo);
        SimTime start = members[0].Session.World!.Simulation.Start;
        SimulationOptions usual = new(start, SimDuration.MaxValue, cancellation: cancellation);
        Simulation alone = log.Replay(drawn.Scene, options.PrepareAlone(usual), end);
        Comparison comparison = Compare(alone, members);
        long lost = members.Sum(m => m.Trace.Lost);
        return outcome with
        {
            Peers = members.Count,
            Events = members.Sum(m => m.Session.World?.Simulation.EventsProcessed ?? 0),
            ExternalEvents = log.Accepted.Count,
            TiedEvents = log.Accepted.GroupBy(e => e.Time).Where(g => g.Skip(1).Any()).Sum(g => g.Count()),
            LateEvents = members.Sum(m => m.Session.Counters.Lateness.Count(late => late > SimDuration.Zero)),
            Heals = members.Sum(m => m.Heals.Sum(h => h.Heals)),
            HealsThatChangedAnImpact = members.Sum(m => m.Heals.Sum(h => h.Changed)),
            EventsRerun = members.Sum(m => m.Heals.Sum(h => h.Events)),
            Impacts = alone.ImpactsProcessed,
            Met = SceneFeatures.Of(alone, log.Accepted, drawn.ContactSteps),
            TooLateEvents = log.TooLate + lost,
            LostEvents = lost,
            RefusedEvents = log.Refused - log.TooLate,
            HasFullLinks = drawn.HasFullLinks,
            HasStops = drawn.HasStops,
            Copies = members.Sum(m => m.Session.Counters.Renewals),
            LateClients = members.Count(m => drawn.Players[m.Peer].AsksAtSeconds is not null && m.Session.World is not null),
            Leavers = members.Count(m => m.HasGone),
            Compared = comparison.Compared,
            DifferingBits = comparison.Differing,
            Failure = Failure(drawn, members, comparison, lost, log.TooLate),
            Difference = comparison.First,
        };
    }

    private static Comparison Compare(Simulation alone, IReadOnlyList<CheckMember> members)
    {
        Comparison comparison = new(alone);
        foreach (CheckMember member in members)
        {
            member.Trace.CompareCommitted(member.Peer, comparison);
        }

        foreach (CheckMember member in members)
        {
            member.Trace.CompareWrong(member.Peer, comparison);
        }

        foreach (CheckMember member in members.Where(m => !m.HasGone))
        {
            comparison.Take(member.Peer, member.Session.World!.Simulation);
        }

        return comparison;
    }

    /// <summary>Returns a sentence about what failed; null if nothing did.</summary>
    private static string? Failure(CheckCase drawn, IReadOnlyList<CheckMember> members, Comparison comparison, long lost, long tooLate)
    {
        bool mayBeRefused = drawn.HasFullLinks || drawn.HasStops; // events that could not arrive in time are refused
        return comparison.Differing > 0 ? string.Create(
                CultureInfo.InvariantCulture,
                $"{comparison.Differing} of {comparison.Compared} compared states and events differ. {comparison.FirstHash}").TrimEnd()
            : lost > 0 ? $"{NumberText.Count(lost, "accepted event was", many: "accepted events were")} lost."
            : tooLate > 0 && !mayBeRefused ? $"{NumberText.Count(tooLate, "event was", many: "events were")} too late."
            : members.Sum(m => m.Session.Counters.StatesDiffered) > 0 ? "A client's committed state was not what the host said."
            : null;
    }
}
