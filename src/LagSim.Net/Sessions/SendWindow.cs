using System;
using System.Collections.Generic;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>Chooses which entries the next update of a link carries, so that a long way costs no throughput and a loss as little time as can be.</summary>
/// <remarks>
/// <para>What fits into one datagram travels in every datagram until it is acknowledged: a loss costs a resend interval. Of more than that each datagram
/// carries what has not been sent; what a datagram carried is sent again when it was not acknowledged for longer than an answer takes. Once a resend interval a
/// datagram is filled up with entries that were sent before.</para>
/// <para>At most <see cref="MaxEntries"/> are under way. Where nothing is acknowledged though all was sent twice, the wait doubles, and only the oldest
/// go on at the resend interval: who lets itself be sent to and answers nothing costs little.</para>
/// <para>Knots are made up for by later ones, so they travel twice, and then wait; once one <see cref="HasLost"/> its time, they too travel in every
/// datagram.</para>
/// </remarks>
internal sealed class SendWindow
{
    /// <summary>So many entries beyond the acknowledged ones are sent at most; a receiver keeps as many that came before their turn.</summary>
    internal const int MaxEntries = 4096;

    /// <summary>So many datagrams go out at a time at most; the next a millisecond later.</summary>
    internal const int MaxDatagramsAtOnce = 4;

    private const int MostDoublings = 8;

    private readonly Queue<Flight> flights = new(); // by when they were sent; each entry under way is in one at least
    private uint sent;
    private int stalls; // how often the oldest entry was sent again in vain
    private SimTime repeated = SimTime.MinValue; // when a datagram was last filled up with what had been sent before

    /// <param name="acknowledged">The other has the entries up to this one.</param>
    internal SendWindow(uint acknowledged) => Acknowledged = sent = acknowledged;

    /// <summary>The other has the entries up to this one.</summary>
    internal uint Acknowledged { get; private set; }

    /// <summary>
    /// Whether something was not acknowledged in time, and nothing has been since. From then on all of it is worth a datagram each resend interval: links lose
    /// several datagrams in a row, however far apart, so whoever asks again only after each answer's time may wait for seconds.
    /// </summary>
    internal bool HasLost { get; private set; }

    /// <summary>Notes that the other has the entries up to a number; a lower one than before says nothing.</summary>
    internal void Acknowledge(uint number)
    {
        if (number > Acknowledged)
        {
            Acknowledged = number;
            sent = Math.Max(sent, number);
            stalls = 0;
            HasLost = false;
        }
    }

    /// <summary>Puts entries into an update that has none, and sets the number of the first.</summary>
    /// <param name="update">The update.</param>
    /// <param name="source">The entries.</param>
    /// <param name="now">When it is sent.</param>
    /// <param name="times">How long answers take, and to wait for them.</param>
    /// <returns>Whether more is to be sent at once.</returns>
    internal bool Fill(UpdateDatagram update, IEntrySource source, SimTime now, in ResendTimes times)
    {
        uint last = source.Last - Acknowledged > MaxEntries ? Acknowledged + MaxEntries : source.Last;
        bool mayRepeat = repeated == SimTime.MinValue || now - repeated >= times.Interval;
        while (flights.TryPeek(out Flight past) && past.Last <= Acknowledged)
        {
            flights.Dequeue();
        }

        SimDuration wait = Wait(times.Answer);
        uint first = Acknowledged + 1;
        HasLost |= IsOverdue(now, wait + times.AckDelay);
        uint needed = HasLost ? first : FirstNeeded(source, last);
        if (Add(update, source, needed, last) == last)
        {
            if (needed == first)
            {
                flights.Clear();
                sent = Acknowledged;
            }

            Note(sent + 1, last, now);
            repeated = now;
            return false;
        }

        if (needed != first)
        {
            Add(update, source, first, last);
        }

        if (mayRepeat && (stalls > 0 || (sent == last && !IsOverdue(now, wait))))
        {
            repeated = now; // from the oldest on, as it is already filled
        }
        else if (IsOverdue(now, wait))
        {
            Repeat(update, source, now, wait);
        }
        else if (sent < last)
        {
            first = mayRepeat ? FirstBefore(source, last) : sent + 1;
            repeated = mayRepeat ? now : repeated;
            Note(sent + 1, Add(update, source, Math.Min(first, sent + 1), last), now);
        }
        else
        {
            update.ClearEntries();
            update.FirstIndex = sent + 1;
        }

        return sent < last || IsOverdue(now, Wait(times.Answer));
    }

    /// <summary>
    /// The first entry that goes out in any case, of those that are not acknowledged, up to the last. Where they are knots alone it is the newest that was sent
    /// before; where there is anything else, it is the first, since what comes after one that is lost can be taken only with it.
    /// </summary>
    private uint FirstNeeded(IEntrySource source, uint last)
    {
        for (uint number = Acknowledged; number < last; number++) // the last may be the greatest number there is
        {
            UpdateEntry entry = source[number + 1];
            if (entry.IsOwn || !Session.IsMadeUpFor(entry.Event))
            {
                return Acknowledged + 1;
            }
        }

        return Math.Max(Acknowledged + 1, Math.Min(sent, last));
    }

    /// <summary>Sends again what was in the datagram that was sent the longest ago, and what follows on it and was overdue as well.</summary>
    private void Repeat(UpdateDatagram update, IEntrySource source, SimTime now, SimDuration wait)
    {
        Flight oldest = flights.Dequeue();
        uint first = Math.Max(oldest.First, Acknowledged + 1), last = oldest.Last;
        stalls = first == Acknowledged + 1 ? Math.Min(stalls + 1, MostDoublings) : stalls;
        uint held = Add(update, source, first, last);
        while (IsOverdue(now, wait) && flights.Peek() is Flight next && next.First == last + 1)
        {
            held = Extend(update, source, held, next.Last);
            if (held < next.Last)
            {
                break;
            }

            last = next.Last;
            flights.Dequeue();
        }

        flights.Enqueue(new Flight(first, last, now));
    }

    /// <summary>The first of the entries up to the last that fit into one datagram together.</summary>
    private uint FirstBefore(IEntrySource source, uint last)
    {
        int room = WireFormat.MaxBytes - WireFormat.EmptyUpdateBytes - WireFormat.StateHashBytes;
        uint first = last + 1;
        while (first > Acknowledged + 1)
        {
            room -= UpdateDatagram.LengthOf(source[first - 1]);
            if (room < 0)
            {
                break;
            }

            first--;
        }

        return first;
    }

    private SimDuration Wait(SimDuration answer) => answer * (1L << Math.Max(0, stalls - 1));

    private bool IsOverdue(SimTime now, SimDuration wait) => flights.TryPeek(out Flight oldest) && now - oldest.At >= wait;

    private void Note(uint first, uint last, SimTime now)
    {
        if (first <= last)
        {
            flights.Enqueue(new Flight(first, last, now));
            sent = last;
        }
    }

    /// <summary>Has an update carry the entries from the first on, up to the last if they fit; the number of the one that it ends with.</summary>
    private static uint Add(UpdateDatagram update, IEntrySource source, uint first, uint last)
    {
        update.ClearEntries();
        update.FirstIndex = first;
        return Extend(update, source, first - 1, last);
    }

    private static uint Extend(UpdateDatagram update, IEntrySource source, uint held, uint last)
    {
        while (held < last && update.TryAdd(source[held + 1]))
        {
            held++;
        }

        return held;
    }

    /// <summary>The entries that a datagram carried for the first time, or again, and when it was sent.</summary>
    private readonly struct Flight
    {
        internal Flight(uint first, uint last, SimTime at)
        {
            First = first;
            Last = last;
            At = at;
        }

        internal uint First { get; }

        internal uint Last { get; }

        internal SimTime At { get; }
    }
}
