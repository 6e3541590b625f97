using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>The newest updates sent over a link: when, with which entries, which of them arrived, and which are lost.</summary>
/// <remarks>
/// An update is lost if it did not arrive though one sent three later did; or if one sent later arrived and nine eighths of a round trip
/// have passed (RFC 9002, 6.1). Only updates with entries are awaited.
/// </remarks>
internal sealed class SentDatagrams
{
    /// <summary>The number of updates remembered; a power of two. An older one that is still awaited is given up.</summary>
    internal const int Span = SeenNumbers.Span;

    private const uint Overtaken = 3;

    private Datagram[] ring = Array.Empty<Datagram>(); // allocated on the first send: many a link never gets there
    private uint newest;
    private uint newestThatCame;
    private uint oldestWaited = 1; // none before it is awaited

    /// <summary>The number of updates that are awaited.</summary>
    internal int Waited { get; private set; }

    /// <summary>Adds an update; numbers count up by one. Without entries, the last is below the first.</summary>
    /// <returns>The update that it overwrites, if that was still awaited.</returns>
    internal Datagram? Add(uint number, SimTime at, int bytes, uint first, uint last)
    {
        ring = ring.Length == 0 ? new Datagram[Span] : ring;
        ref Datagram slot = ref ring[number % Span];
        Datagram? forgotten = slot.IsWaitedFor ? slot : null;
        Waited -= slot.IsWaitedFor ? 1 : 0;
        bool hasEntries = last >= first;
        slot = new Datagram(number, at, bytes, first, last, hasEntries);
        newest = number;
        Waited += hasEntries ? 1 : 0;
        return forgotten;
    }

    /// <summary>When an update was sent; false for one that was not, or is forgotten.</summary>
    internal bool TryGetTime(uint number, out SimTime at)
    {
        Datagram sent = ring.Length == 0 ? default : ring[number % Span];
        at = sent.At;
        return number != 0 && sent.Number == number;
    }

    /// <summary>Records that an update arrived; returns true, and the update, if it was awaited.</summary>
    internal bool TryAcknowledge(uint number, out Datagram datagram)
    {
        datagram = ring.Length == 0 ? default : ring[number % Span];
        if (number == 0 || datagram.Number != number)
        {
            return false;
        }

        newestThatCame = Math.Max(newestThatCame, number);
        return End(number);
    }

    /// <summary>Takes the oldest awaited update whose entries have all been acknowledged otherwise; false if there is none.</summary>
    internal bool TryTakeCovered(uint acknowledged, out Datagram datagram)
    {
        for (uint number = Oldest(); number <= newest && Waited > 0; number++)
        {
            datagram = ring[number % Span];
            if (datagram.IsWaitedFor && datagram.Last <= acknowledged)
            {
                return End(number);
            }
        }

        datagram = default;
        return false;
    }

    /// <summary>Takes the oldest update that is lost by now; false if there is none.</summary>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="trip">The longer of the mean and the newest round trip.</param>
    /// <param name="datagram">The update.</param>
    internal bool TryTakeLost(SimTime now, SimDuration trip, out Datagram datagram)
    {
        SimDuration most = trip + (trip / 8);
        for (uint number = Oldest(); number < newestThatCame && Waited > 0; number++)
        {
            datagram = ring[number % Span];
            if (datagram.IsWaitedFor && (newestThatCame - number >= Overtaken || now - datagram.At >= most))
            {
                return End(number);
            }
        }

        datagram = default;
        return false;
    }

    /// <summary>When the oldest awaited update was sent; false if there is none.</summary>
    internal bool TryPeekOldest(out SimTime at)
    {
        at = Waited > 0 ? ring[Oldest() % Span].At : default;
        return Waited > 0;
    }

    /// <summary>Takes the oldest awaited update, as lost; false if there is none.</summary>
    internal bool TryTakeOldest(out Datagram datagram)
    {
        uint number = Oldest();
        datagram = Waited > 0 ? ring[number % Span] : default;
        return Waited > 0 && End(number);
    }

    /// <summary>Whether a later update carried all of those entries, and arrived or may still arrive.</summary>
    internal bool IsCarriedLater(in Datagram than, uint first, uint last)
    {
        for (uint number = than.Number + 1; number <= newest; number++)
        {
            ref Datagram later = ref ring[number % Span];
            if (later.Number == number && later.First <= first && later.Last >= last && !later.IsLost)
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Marks an update as lost, so that nothing relies on it.</summary>
    internal void NoteLost(in Datagram datagram) => ring[datagram.Number % Span].IsLost |= ring[datagram.Number % Span].Number == datagram.Number;

    /// <summary>When the oldest awaited update was sent, of those sent before one that arrived; false if there is none.</summary>
    internal bool TryGetOvertaken(out SimTime at)
    {
        uint number = Oldest();
        at = Waited > 0 ? ring[number % Span].At : default;
        return Waited > 0 && number < newestThatCame;
    }

    private uint Oldest()
    {
        oldestWaited = newest >= Span ? Math.Max(oldestWaited, newest - Span + 1) : oldestWaited;
        while (Waited > 0 && !ring[oldestWaited % Span].IsWaitedFor)
        {
            oldestWaited++;
        }

        return oldestWaited;
    }

    private bool End(uint number)
    {
        ref Datagram slot = ref ring[number % Span];
        bool was = slot.IsWaitedFor;
        slot.IsWaitedFor = false;
        Waited -= was ? 1 : 0;
        return was;
    }

    /// <summary>An update that was sent, and the entries that it carried.</summary>
    internal struct Datagram
    {
        internal Datagram(uint number, SimTime at, int bytes, uint first, uint last, bool isWaitedFor)
        {
            Number = number;
            At = at;
            Bytes = bytes;
            First = first;
            Last = last;
            IsWaitedFor = isWaitedFor;
            IsLost = false;
        }

        internal uint Number { get; }

        internal SimTime At { get; }

        /// <summary>The size in bytes, UDP and IP headers included.</summary>
        internal int Bytes { get; }

        internal uint First { get; }

        internal uint Last { get; }

        internal bool IsWaitedFor { get; set; }

        internal bool IsLost { get; set; }
    }
}
