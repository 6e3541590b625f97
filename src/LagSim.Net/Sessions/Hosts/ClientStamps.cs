using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>When a client's events are stamped: what it has promised about those to come, and where those that happened lie.</summary>
internal sealed class ClientStamps
{
    /// <summary>
    /// The shared time before which none of its events is stamped but those that were validated; the earliest instant without a promise.
    /// </summary>
    internal SimTime Promised { get; set; } = SimTime.MinValue;

    /// <summary>The latest time of its events that happened; the earliest instant if it has done nothing since it is in.</summary>
    internal SimTime Latest { get; private set; } = SimTime.MinValue;

    /// <summary>The latest time of those that were moved; the earliest instant if none was.</summary>
    internal SimTime LatestMoved { get; private set; } = SimTime.MinValue;

    /// <summary>
    /// When the host judged the newest of its events that happened or came too late; the earliest instant if there is none since it is in.
    /// </summary>
    internal SimTime Acted { get; set; } = SimTime.MinValue;

    /// <summary>Records an event that happened.</summary>
    /// <param name="time">When.</param>
    /// <param name="isMoved">Whether it was stamped earlier than that.</param>
    internal void Note(SimTime time, bool isMoved)
    {
        Latest = SimTime.Max(Latest, time);
        LatestMoved = isMoved ? SimTime.Max(LatestMoved, time) : LatestMoved;
    }
}
