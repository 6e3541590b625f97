using System;
using LagSim.Time;

namespace LagSim;

/// <summary>The report of a heal: the rewriting of the past for one late event, or for several that came before it was finished.</summary>
/// <remarks>Immutable. The counts follow from the world and the late events alone, not from the machine.</remarks>
public readonly struct HealReport : IEquatable<HealReport>
{
    /// <summary>Creates a report with these values.</summary>
    public HealReport(SimTime from, SimTime to, int lateEvents, int bodies, long segmentsCut, long events, SimTime? reconvergedAt = null)
    {
        ReconvergedAt = reconvergedAt;
        From = from;
        To = to;
        LateEvents = lateEvents;
        Bodies = bodies;
        SegmentsCut = segmentsCut;
        Events = events;
    }

    /// <summary>The time of the earliest late event in it.</summary>
    public SimTime From { get; }

    /// <summary>How far the world was simulated when the first late event came. The heal brings it back there.</summary>
    public SimTime To { get; }

    /// <summary>The number of late or retracted events it served; at least one.</summary>
    public int LateEvents { get; }

    /// <summary>
    /// The number of bodies that were predicted again because of it: the causal cone. All bodies for a full rollback, and for a heal that
    /// grew to more than 32 of them and an eighth.
    /// </summary>
    public int Bodies { get; }

    /// <summary>How many segments were cut off.</summary>
    public long SegmentsCut { get; }

    /// <summary>The number of events simulated again, the late ones included.</summary>
    public long Events { get; }

    /// <summary>
    /// The instant from which all paths equalled the old ones, bit for bit, so that the heal was done; later segments stay as they were.
    /// Null if that never came, or was not tested: after a full rollback, after more late events before the heal was finished, and where it
    /// had cut more than 256 segments.
    /// </summary>
    public SimTime? ReconvergedAt { get; }

    /// <inheritdoc/>
    public bool Equals(HealReport other) =>
        (From, To, LateEvents, Bodies, SegmentsCut, Events, ReconvergedAt)
            == (other.From, other.To, other.LateEvents, other.Bodies, other.SegmentsCut, other.Events, other.ReconvergedAt);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is HealReport other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => (From, To, LateEvents, Bodies, SegmentsCut, Events, ReconvergedAt).GetHashCode();

    /// <summary>Same in every part.</summary>
    public static bool operator ==(in HealReport a, in HealReport b) => a.Equals(b);

    /// <summary>Different in some part.</summary>
    public static bool operator !=(in HealReport a, in HealReport b) => !a.Equals(b);
}
