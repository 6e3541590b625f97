using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// Tracks what arrived from the other end of a link: which updates, when the last, and the round trips that its answers show.
/// </summary>
internal class LinkReceipts
{
    private readonly SeenNumbers seen = new();
    private SimDuration unheard;
    private uint echoed; // the newest number a round trip was measured with

    /// <param name="now">The time by the local clock.</param>
    internal LinkReceipts(SimTime now) => Heard = now;

    /// <summary>When the last update arrived, by the local clock.</summary>
    internal SimTime Heard { get; private set; }

    /// <summary>When the newest update arrived; the earliest instant before there is one.</summary>
    internal SimTime NewestCame { get; private set; } = SimTime.MinValue;

    /// <summary>The number of the newest update; 0 before there is one.</summary>
    internal uint Newest => (uint)seen.Newest;

    /// <summary>Which of the 32 before it arrived.</summary>
    internal uint BitsBeforeNewest => seen.BitsBefore(seen.Newest);

    /// <summary>
    /// The longer of two silences: since anything arrived here, and since anything arrived at the other end, as it last reported.
    /// </summary>
    internal SimDuration Silence(SimTime now) => now - Heard > unheard ? now - Heard : unheard;

    /// <summary>Records another datagram that only the other end can have sent, and only now.</summary>
    internal void NoteHeard(SimTime now) => Heard = now;

    /// <summary>Records an update that arrived.</summary>
    /// <param name="update">The update.</param>
    /// <param name="now">When it arrived, by the local clock.</param>
    /// <param name="sent">The datagrams sent, which it may answer.</param>
    /// <param name="trips">Where its round trip is added.</param>
    /// <param name="isNewest">False for one that was overtaken.</param>
    /// <returns>False for one that arrived before, or is so old that it may have.</returns>
    internal bool Note(UpdateDatagram update, SimTime now, SentDatagrams sent, RoundTrips trips, out bool isNewest)
    {
        isNewest = update.Number > seen.Newest;
        if (!seen.Add(update.Number))
        {
            return false; // possibly a replay: it does not even show that the other end is there
        }

        if (isNewest)
        {
            Heard = now;
            NewestCame = now;
            SimDuration held = update.EchoNumber == 0 ? SimDuration.Zero : update.Sent - update.EchoReceived; // both by the other's clock
            unheard = held;
            if (IsNewTrip(update.EchoNumber, echoed) && sent.TryGetTime(update.EchoNumber, out SimTime at)
                && held >= SimDuration.Zero && held <= now - at) // otherwise the times are forged
            {
                trips.Add(now - at - held, now);
                echoed = update.EchoNumber;
            }
        }

        return true;
    }

    /// <summary>Whether the round trip of an answered update has not been counted.</summary>
    /// <param name="answered">The number of the update.</param>
    /// <param name="counted">The newest update whose round trip was counted.</param>
    internal virtual bool IsNewTrip(uint answered, uint counted) => answered > counted;
}
