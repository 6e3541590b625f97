using System;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Testing;

/// <summary>The results for one player of a test.</summary>
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
    /// The number of other players' events that came after their timestamp, among the first
    /// <see cref="SessionCounters.MaxKeptLatenesses"/>.
    /// </summary>
    public long LateEvents { get; }

    /// <summary>The lateness of the latest of them; zero if none was late.</summary>
    public SimDuration WorstLateness { get; }

    /// <summary>How often this player's world rewrote its past for a late event.</summary>
    public long Heals { get; }

    /// <summary>The number of frames sampled, at 60 per second of true time, from when it was in.</summary>
    public long Frames { get; }

    /// <summary>
    /// The number of those that could not be drawn, because its world did not cover the moment. Machines are infinitely fast here, so only
    /// an interrupted session stalls.
    /// </summary>
    public long StalledFrames { get; }

    /// <summary>
    /// The number of accepted events that it should have received and did not, or received too late for its history. Always 0 unless a
    /// session is broken.
    /// </summary>
    public long EventsLost { get; }

    /// <summary>How often it got a fresh snapshot of the host's world, because it was out for too long or its own world differed.</summary>
    public long Renewals { get; }

    /// <summary>The traffic through its port, from joining to the end; bytes with UDP and IP headers.</summary>
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
