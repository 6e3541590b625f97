using LagSim.Events;
using LagSim.Time;

namespace LagSim.Collisions;

/// <summary>The least event considered so far, and its partner.</summary>
internal struct NextEvent
{
    internal bool Any;
    internal EventKey Key;
    internal int Partner;
    internal int Surface;
    internal int Piece;
    internal double Residual;
    internal bool IsTied; // something else was considered at that tick

    /// <summary>
    /// The time up to which contacts may come before those considered so far: contacts that come soon may be at once
    /// (<see cref="ContactTime.IsSoonAfter"/>).
    /// </summary>
    internal readonly SimTime Horizon(SimTime from, SimTime until) =>
        Any ? SimTime.Min(until, SimTime.Max(Key.Time, from + ContactTime.Soon)) : until;

    internal bool Consider(in EventKey key)
    {
        IsTied = Any && (key.Time == Key.Time || (key.Time > Key.Time && IsTied));
        if (Any && EventKey.Compare(key, Key) >= 0)
        {
            return false;
        }

        Any = true;
        Key = key;
        Partner = PendingContact.NoPartner;
        return true;
    }
}
