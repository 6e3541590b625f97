using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>What a client promises its host: before which instant it stamps no event any more. It keeps to the latest.</summary>
/// <param name="seat">What the host asks for.</param>
internal sealed class OwnPromises(SeatDatagram seat)
{
    private readonly SimDuration pace = SimDuration.FromMilliseconds(seat.PromiseMilliseconds);
    private readonly SimDuration lasts = seat.PromisedFor;
    private SimTime lastAct = SimTime.MinValue;

    /// <summary>Whether the host has a use for promises.</summary>
    internal bool AreWanted => pace > SimDuration.Zero;

    /// <summary>The shared time before which this peer stamps nothing any more: the host may have settled it.</summary>
    internal SimTime Earliest { get; private set; } = seat.PromiseMilliseconds > 0 ? seat.Earliest : SimTime.MinValue;

    /// <summary>The longest pause until the next update, which brings the next promise; no limit while nobody waits for one.</summary>
    /// <param name="now">The shared time.</param>
    internal SimDuration Pause(SimTime now) =>
        lasts == SimDuration.MaxValue || (lastAct != SimTime.MinValue && now - lastAct <= lasts) ? pace : SimDuration.MaxValue;

    /// <summary>Records an own event.</summary>
    internal void NoteAct(SimTime stamp) => lastAct = SimTime.Max(lastAct, stamp);

    /// <summary>Promises that no own event after that one is stamped before an instant: see <see cref="Earliest"/>.</summary>
    /// <param name="unconfirmed">The own events that the host has not judged yet.</param>
    /// <param name="after">The number of the last own event that the promise comes with.</param>
    /// <param name="now">The shared time: whatever is done from now on is stamped no earlier.</param>
    internal SimTime Make(OwnEvents unconfirmed, uint after, SimTime now)
    {
        SimTime promised = SimTime.Max(now, Earliest);
        uint oldest = unconfirmed.Count > 0 ? unconfirmed.Oldest.Sequence : uint.MaxValue;
        for (uint number = unconfirmed.Last; number > after && number >= oldest; number--)
        {
            promised = SimTime.Min(promised, unconfirmed[number].Event.Time);
        }

        Earliest = SimTime.Max(Earliest, promised);
        return promised;
    }
}
