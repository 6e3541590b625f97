using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// What was heard of the other end of a link: which of its updates came, when it was last heard, and the round trips that its answers show.
/// </summary>
internal class LinkHearing
{
    private readonly SeenNumbers seen = new();
    private SimDuration unheard;
    private uint echoed; // the newest number that a round trip was taken of

    /// <param name="now">By the own clock.</param>
    internal LinkHearing(SimTime now) => Heard = now;

    /// <summary>When the last update came, by the own clock.</summary>
    internal SimTime Heard { get; private set; }

    /// <summary>When the newest update came; the earliest instant before there is one.</summary>
    internal SimTime NewestCame { get; private set; } = SimTime.MinValue;

    /// <summary>The number of the newest update; 0 before there is one.</summary>
    internal uint Newest => seen.Newest;

    /// <summary>Which of the 32 before it came.</summary>
    internal uint BitsBeforeNewest => seen.BitsBefore(seen.Newest);

    /// <summary>
    /// The longer of two silences: for how long nothing came, and for how long the other said, when it last wrote, that nothing came there.
    /// </summary>
    internal SimDuration Silence(SimTime now) => now - Heard > unheard ? now - Heard : unheard;

    /// <summary>Notes something else that only the other can have sent, and only now.</summary>
    internal void NoteHeard(SimTime now) => Heard = now;

    /// <summary>Notes an update that came.</summary>
    /// <param name="update">The update.</param>
    /// <param name="now">When it came, by the own clock.</param>
    /// <param name="sent">What was sent, which it may answer.</param>
    /// <param name="trips">Where the round trip is added that it shows.</param>
    /// <param name="isNewest">False for one that was overtaken.</param>
    /// <returns>False for one that came before, or is so old that it may have.</returns>
    internal bool Note(UpdateDatagram update, SimTime now, SentDatagrams sent, RoundTrips trips, out bool isNewest)
    {
        isNewest = update.Number > seen.Newest;
        if (!seen.Add(update.Number))
        {
            return false; // perhaps somebody plays it again: it does not even show that the other is there
        }

        if (isNewest)
        {
            Heard = now;
            NewestCame = now;
            SimDuration held = update.EchoNumber == 0 ? SimDuration.Zero : update.Sent - update.EchoReceived; // both by its own clock
            unheard = held;
            if (IsNewTrip(update.EchoNumber, echoed) && sent.TryGetTime(update.EchoNumber, out SimTime at)
                && held >= SimDuration.Zero && held <= now - at) // else it is made up
            {
                trips.Add(now - at - held, now);
                echoed = update.EchoNumber;
            }
        }

        return true;
    }

    /// <summary>Whether the round trip of an update that is answered has not been counted.</summary>
    /// <param name="answered">The number of the update.</param>
    /// <param name="counted">The newest one of which it has.</param>
    internal virtual bool IsNewTrip(uint answered, uint counted) => answered > counted;
}
