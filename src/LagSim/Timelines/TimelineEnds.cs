namespace LagSim.Timelines;

/// <summary>The ends of a body's timeline: its oldest segment that is kept, and its newest.</summary>
internal struct TimelineEnds
{
    /// <summary>Those of a body without segments.</summary>
    internal static readonly TimelineEnds None = new() { First = TimelineStore.None, Last = TimelineStore.None };

    internal int First;
    internal int Last;
}
