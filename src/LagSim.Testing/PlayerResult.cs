using System;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Testing;

/// <summary>What one player of a test went through.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class PlayerResult
{
    internal PlayerResult(
        int number, LinkProfile? link, Session session, PortTraffic traffic, long frames, long stalledFrames, long eventsLost)
    {
        Number = number;
        Link = link;
        Traffic = traffic;
        Frames = frames;
        StalledFrames = stalledFrames;
        EventsLost = eventsLost;
        Heals = session.Counters.Heals;
        Renewals = session.Counters.Renewals;
        foreach (SimDuration late in session.Counters.Lateness)
        {
            LateEvents += late > SimDuration.Zero ? 1 : 0;
            WorstLateness = late > WorstLateness ? late : WorstLateness;
        }
    }

    /// <summary>The player's number in the test; 0 is the host.</summary>
    public int Number { get; }

    /// <summary>The link to the host; null for the host.</summary>
    public LinkProfile? Link { get; }

    /// <summary>
    /// How many events of others came after the time stamped on them, of the first <see cref="SessionCounters.MaxKeptLatenesses"/>.
    /// </summary>
    public long LateEvents { get; }

    /// <summary>By how much the latest of them came late; zero if none did.</summary>
    public SimDuration WorstLateness { get; }

    /// <summary>How often this player's world rewrote its past for a late event.</summary>
    public long Heals { get; }

    /// <summary>How many frames it was watched, at 60 a second of true time, from when it was in.</summary>
    public long Frames { get; }

    /// <summary>
    /// How many of these could not be drawn, because its world did not cover the moment. Machines are infinitely fast here: only a session
    /// that is interrupted stalls.
    /// </summary>
    public long StalledFrames { get; }

    /// <summary>
    /// How many accepted events it should have heard of and did not, or too late for the history that it keeps. Always 0, but where a
    /// session is broken.
    /// </summary>
    public long EventsLost { get; }

    /// <summary>How often it got a fresh copy of the host's world, because it was out for too long or its own world differed.</summary>
    public long Renewals { get; }

    /// <summary>What went through its port, from joining to the end; bytes with UDP and IP headers.</summary>
    public PortTraffic Traffic { get; }

    /// <summary>One line with the figures.</summary>
    public override string ToString()
    {
        string late = FormattableString.Invariant($"{LateEvents} late events, the latest by {WorstLateness.ToMilliseconds():0.#} ms");
        string stalled = FormattableString.Invariant($"{StalledFrames} of {Frames} frames stalled");
        string bytes = FormattableString.Invariant($"{Traffic.BytesSent} bytes sent, {Traffic.BytesReceived} received");
        return $"player {Number} ({Link?.Name ?? "host"}): {late}, {Heals} heals, {stalled}, {bytes}";
    }
}
