using System;
using System.Globalization;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Events;

/// <summary>The place of an event in the one canonical order: time, round, rank of kind, body identities, peer, sequence.</summary>
/// <remarks>
/// <para>An effect at the tick of its cause takes the next <see cref="Round"/>, so a cause sorts before its effect. Every cut of a timeline
/// compares whole keys. Two different events of one world never have equal keys.</para>
/// <para>Immutable, safe on any thread; comparison is integers only and a total order. <c>default</c> is before every event at the
/// origin.</para>
/// </remarks>
public readonly struct EventKey : IEquatable<EventKey>, IComparable<EventKey>
{
    private readonly ulong rank; // round in the high 32 bits, kind in the low 8

    /// <summary>A key of these parts; bodies in the order given, the lesser identity first.</summary>
    public EventKey(SimTime time, uint round, EventKind kind, BodyId body, BodyId other, byte peer, uint sequence)
    {
        Time = time;
        rank = ((ulong)round << 32) | (byte)kind;
        Body = body;
        Other = other;
        Origin = ((ulong)peer << 32) | sequence;
    }

    private EventKey(in EventKey like, ulong origin)
    {
        this = like;
        Origin = origin;
    }

    /// <summary>When it happens.</summary>
    public SimTime Time { get; }

    /// <summary>How many causes at the same tick precede it; 0 for what comes from outside or from an earlier tick.</summary>
    public uint Round => (uint)(rank >> 32);

    /// <summary>The kind of the event.</summary>
    public EventKind Kind => (EventKind)(byte)rank;

    /// <summary>The body it happens to; for an impact the least identity among its bodies.</summary>
    public BodyId Body { get; }

    /// <summary>
    /// For an impact, the partner of <see cref="Body"/> with the least identity, or <see cref="Body"/> itself where it hit only static
    /// geometry; for any other event, <see cref="Body"/>.
    /// </summary>
    public BodyId Other { get; }

    /// <summary>The peer an external event came from; 0 for what the model made.</summary>
    public byte Peer => (byte)(Origin >> 32);

    /// <summary>
    /// The sequence number of an external event at its peer; for a crossing the index of its sensor; 0 for all else that the model made.
    /// </summary>
    public uint Sequence => (uint)Origin;

    internal ulong Origin { get; }

    /// <summary>The least key after this one, of no event: what is keyed before it has happened once this event has.</summary>
    internal EventKey JustAfter => new(this, Origin + 1);

    /// <summary>The key before every event at or after <paramref name="time"/>.</summary>
    public static EventKey Before(SimTime time) => new(time, 0, EventKind.None, default, default, 0, 0);

    /// <summary>The key before all impacts of a tick and round.</summary>
    internal static EventKey BeforeImpacts(SimTime time, uint round) => new(time, round, EventKind.Impact, default, default, 0, 0);

    /// <inheritdoc/>
    public int CompareTo(EventKey other) => Compare(this, other);

    /// <summary>Negative, zero or positive as <paramref name="a"/> is before, at or after <paramref name="b"/>.</summary>
    public static int Compare(in EventKey a, in EventKey b)
    {
        int byTime = a.Time.CompareTo(b.Time);
        if (byTime != 0)
        {
            return byTime;
        }

        int byRank = a.rank.CompareTo(b.rank);
        if (byRank != 0)
        {
            return byRank;
        }

        int byBody = a.Body.CompareTo(b.Body);
        if (byBody != 0)
        {
            return byBody;
        }

        int byOther = a.Other.CompareTo(b.Other);
        return byOther != 0 ? byOther : a.Origin.CompareTo(b.Origin);
    }

    /// <inheritdoc/>
    public bool Equals(EventKey other) => Compare(this, other) == 0;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is EventKey other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() =>
        Time.GetHashCode() ^ (rank.GetHashCode() * 31) ^ (Body.GetHashCode() * 397) ^ (Other.GetHashCode() * 7919) ^ Origin.GetHashCode();

    /// <summary>Same place.</summary>
    public static bool operator ==(in EventKey a, in EventKey b) => Compare(a, b) == 0;

    /// <summary>Different places.</summary>
    public static bool operator !=(in EventKey a, in EventKey b) => Compare(a, b) != 0;

    /// <summary>Before.</summary>
    public static bool operator <(in EventKey a, in EventKey b) => Compare(a, b) < 0;

    /// <summary>After.</summary>
    public static bool operator >(in EventKey a, in EventKey b) => Compare(a, b) > 0;

    /// <summary>Not after.</summary>
    public static bool operator <=(in EventKey a, in EventKey b) => Compare(a, b) <= 0;

    /// <summary>Not before.</summary>
    public static bool operator >=(in EventKey a, in EventKey b) => Compare(a, b) >= 0;

    /// <summary>All parts, for logs and error messages.</summary>
    public override string ToString() => string.Format(
        CultureInfo.InvariantCulture, "{0} round {1} {2} {3}/{4} by {5}.{6}", Time.ToShortString(), Round, Kind, Body, Other, Peer, Sequence);
}
