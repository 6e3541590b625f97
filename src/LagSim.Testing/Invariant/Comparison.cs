using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Testing.Invariant;

/// <summary>
/// Compares worlds with the one that had every accepted event before it began: states, hashes of events, and whole timelines.
/// </summary>
internal sealed class Comparison
{
    private const int Instants = 12;

    private readonly Simulation expected;
    private readonly List<(BodyId Body, TimelineEntry[] Entries)> timelines = [];

    /// <param name="expected">
    /// The world that never had a delay; advanced beyond all that are compared with it, with unlimited history.
    /// </param>
    internal Comparison(Simulation expected)
    {
        this.expected = expected;
        for (int n = 0; n < expected.BodyCount; n++)
        {
            timelines.Add((expected.BodyAt(n), Happened(expected, expected.BodyAt(n), expected.SimulatedTo)));
        }
    }

    /// <summary>The number of states, hashes and timeline entries compared.</summary>
    internal long Compared { get; private set; }

    /// <summary>The number of those that differ in any bit.</summary>
    internal long Differing { get; private set; }

    /// <summary>The first event that differs; of several peers that of the first.</summary>
    internal FirstDifference? First { get; private set; }

    /// <summary>
    /// The first hash of states or events in which a peer differs, as a sentence; of several peers that of the first. The timelines may
    /// agree all the same, if a committed state became right afterwards, or an event was counted that changed nothing.
    /// </summary>
    internal string? FirstHash { get; private set; }

    /// <summary>Compares a peer's committed state.</summary>
    internal void Take(int peer, in CommittedState state)
    {
        Take(peer, state.StateHash == expected.StateHash(state.Time), "committed another state", state.Time);
        Take(peer, state.EventHash == expected.EventHash(state.Time), "committed the hash of other events", state.Time);
    }

    /// <summary>Compares a peer's whole world, as far as it keeps it.</summary>
    internal void Take(int peer, Simulation actual)
    {
        SimTime from = SimTime.Max(actual.HistoryEdge, actual.Start);
        SimTime to = actual.SimulatedTo;
        for (int i = 0; i <= Instants; i++)
        {
            SimTime time = from + ((to - from) / Instants * i);
            Take(peer, actual.StateHash(time) == expected.StateHash(time), "ends with another state", time);
            Take(peer, actual.EventHash(time) == expected.EventHash(time), "ends with the hash of other events", time);
        }

        FirstDifference? first = null;
        foreach ((BodyId body, TimelineEntry[] entries) in timelines)
        {
            first = Earlier(first, Take(peer, actual, body, entries, from, to));
        }

        for (int n = 0; n < actual.BodyCount; n++)
        {
            BodyId body = actual.BodyAt(n);
            if (expected.Timeline(body).Count == 0)
            {
                first = Earlier(first, Take(peer, actual, body, [], from, to)); // a body that should never have existed
            }
        }

        First ??= first;
    }

    private void Take(int peer, bool isSame, string what, SimTime time)
    {
        if (!isSame)
        {
            FirstHash ??= FormattableString.Invariant($"Peer {peer} {what} {(time - expected.Start).ToSeconds():0.############} s after the start.");
        }

        Count(isSame);
    }

    private FirstDifference? Take(int peer, Simulation actual, BodyId body, TimelineEntry[] should, SimTime from, SimTime to)
    {
        TimelineEntry[] entries = Happened(actual, body, to);

        // A peer keeps the entries from some time on, and the one before that; a body that had gone by then is unknown to it.
        int at = 0;
        while (at < should.Length && (entries.Length == 0 ? should[at].Key.Time < from : should[at].Key < entries[0].Key))
        {
            at++;
        }

        if (entries.Length == 0 && at > 0)
        {
            Count(should[at - 1].State.Motion == MotionLaw.Absent);
        }

        FirstDifference? first = null;
        int i = 0;
        for (; at < should.Length && should[at].Key.Time <= to; at++, i++)
        {
            bool isSame = i < entries.Length && should[at].Key == entries[i].Key && should[at].State.IsSameBits(entries[i].State);
            Count(isSame);
            first = isSame ? first : first ?? Difference(peer, body, should[at], i < entries.Length ? entries[i] : null);
        }

        for (; i < entries.Length; i++)
        {
            Count(false);
            first ??= Difference(peer, body, null, entries[i]);
        }

        return first;
    }

    private FirstDifference Difference(int peer, BodyId body, TimelineEntry? should, TimelineEntry? entry) =>
        new(peer, body, expected.Start, should?.Key, should?.State ?? default, entry?.Key, entry?.State ?? default);

    private static FirstDifference? Earlier(FirstDifference? a, FirstDifference? b) =>
        a is null || (b is not null && b.Key < a.Key) ? b : a;

    /// <summary>Returns what happened to a body up to that time; first learning of a body is not an event.</summary>
    private static TimelineEntry[] Happened(Simulation simulation, BodyId body, SimTime to)
    {
        List<TimelineEntry> happened = [];
        foreach (TimelineEntry entry in simulation.Timeline(body))
        {
            if (entry.Key.Kind != EventKind.None && entry.Key.Time <= to)
            {
                happened.Add(entry);
            }
        }

        return [.. happened];
    }

    private void Count(bool isSame)
    {
        Compared++;
        Differing += isSame ? 0 : 1;
    }
}
