using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Links;

/// <summary>Chooses the entries of a link's next update: lost ones first, then new ones, then repetitions as far as allowed.</summary>
/// <remarks>
/// <para>Each entry has to be sent once, and again each time that every datagram that carried it was lost (<see cref="Lose"/>). That is
/// needed on any link. Entries that go in several updates in a row hide losses before they are known; in how many is the caller's to
/// say, and it is for links with spare room.</para>
/// <para>At most <see cref="MaxEntries"/> are in flight. Keyframes are superseded by later ones, so they are repeated once, with the
/// next.</para>
/// </remarks>
internal class SendWindow
{
    /// <summary>The most entries sent beyond the acknowledged ones; a receiver buffers as many early ones.</summary>
    internal const int MaxEntries = 4096;

    /// <summary>The most datagrams sent at a time; the next follows a millisecond later.</summary>
    internal const int MaxDatagramsAtOnce = 4;

    /// <summary>The most bytes that the entries of one update take.</summary>
    private const int Room = WireFormat.MaxPlainBytes - WireFormat.EmptyUpdateBytes - WireFormat.MaxHashBytes - WireFormat.StartBytes;

    private readonly List<(uint First, uint Last)> lost = new(); // ascending, disjoint, above what is acknowledged
    private readonly uint[] firsts = new uint[LossRuns.MaxCopies]; // the first new entry of each of the newest updates that carried any
    private int filled; // how many such updates there were
    private uint sent;
    private uint lostUpTo; // the greatest number that was ever lost

    /// <param name="acknowledged">The last entry that the other has without a gap.</param>
    internal SendWindow(uint acknowledged) => Acknowledged = sent = acknowledged;

    /// <summary>The last entry that the other has without a gap.</summary>
    internal uint Acknowledged { get; private set; }

    /// <summary>The greatest number that was sent or acknowledged.</summary>
    internal uint Sent => sent;

    /// <summary>The number up to which entries are in the update after another was added: that one's.</summary>
    internal virtual uint After(uint added, uint first, uint last) => added;

    /// <summary>Starts over with entries after that number, before any was sent.</summary>
    internal void StartAfter(uint acknowledged)
    {
        Acknowledged = sent = acknowledged;
        lostUpTo = 0;
        filled = 0;
        lost.Clear();
    }

    /// <summary>
    /// Whether the next event of its kind carries the same information, so that this one need not be sent again if it is lost.
    /// </summary>
    internal static bool IsMadeUpFor(in ExternalEvent external) => external.Kind == EventKind.HoldKeyframe;

    /// <summary>Records that the other has the entries up to a number; a number below an earlier one is ignored.</summary>
    internal void Acknowledge(uint number)
    {
        if (number <= Acknowledged)
        {
            return;
        }

        Acknowledged = number;
        sent = Math.Max(sent, number);
        while (lost.Count > 0 && lost[0].First <= number)
        {
            if (lost[0].Last > number)
            {
                lost[0] = (number + 1, lost[0].Last);
                return;
            }

            lost.RemoveAt(0);
        }
    }

    /// <summary>Records that entries were lost: they have to be sent again, unless they are in flight again already.</summary>
    internal void Lose(uint first, uint last, bool isOnItsWay = false)
    {
        first = Math.Max(first, Acknowledged + 1);
        last = Math.Min(last, sent);
        if (first > last)
        {
            return;
        }

        lostUpTo = Math.Max(lostUpTo, last);
        if (isOnItsWay)
        {
            return;
        }

        int at = 0;
        while (at < lost.Count && lost[at].Last + 1L < first)
        {
            at++;
        }

        while (at < lost.Count && lost[at].First <= last + 1L)
        {
            first = Math.Min(first, lost[at].First);
            last = Math.Max(last, lost[at].Last);
            lost.RemoveAt(at);
        }

        lost.Insert(at, (first, last));
    }

    /// <summary>
    /// Whether a lost entry is not acknowledged yet. Then everything is worth repeating, keyframes too: links lose several datagrams in a
    /// row, however far apart, so resending only when the answer is overdue may take seconds.
    /// </summary>
    internal bool HasLost => lostUpTo > Acknowledged;

    /// <summary>Whether any entry has to be sent again.</summary>
    internal bool HasToGoAgain => lost.Count > 0;

    /// <summary>Whether any entry has to be sent.</summary>
    internal bool HasNeeded(IEntrySource source) => lost.Count > 0 || sent < LastOf(source);

    /// <summary>Whether an entry in flight goes again before it is known to be lost.</summary>
    /// <param name="copies">In how many updates in a row each goes.</param>
    internal bool HasCopiesLeft(int copies) => FirstToCopy(copies) <= sent;

    /// <summary>The size in bytes of the entries that a repetition would carry; 0 if there are none.</summary>
    /// <param name="source">The entries.</param>
    /// <param name="copies">In how many updates in a row each goes.</param>
    internal int RepetitionBytes(IEntrySource source, int copies)
    {
        int bytes = 0;
        for (uint number = FirstToCopy(copies) - 1; number < sent && bytes < Room; number++)
        {
            bytes += UpdateDatagram.LengthOf(source[number + 1]);
        }

        return Math.Min(bytes, Room);
    }

    /// <summary>Adds entries to an empty update, and sets the number of the first.</summary>
    /// <param name="update">The update.</param>
    /// <param name="source">The entries.</param>
    /// <param name="repetition">How many bytes may be repetition; for an update that is only repetition, its own bytes included.</param>
    /// <param name="own">The bytes of an update besides its entries, UDP and IP headers included.</param>
    /// <param name="room">How many bytes its entries may take; one is always sent.</param>
    /// <param name="copies">In how many updates in a row each entry goes, as far as there is room.</param>
    /// <returns>How many bytes were repetition, counted likewise.</returns>
    internal int Fill(UpdateDatagram update, IEntrySource source, int repetition, int own, int room, int copies)
    {
        uint before = sent;
        int repeated = Choose(update, source, repetition, own, room, copies);
        if (update.Held.Length > 0)
        {
            firsts[filled % firsts.Length] = before + 1;
            filled = filled < 2 * firsts.Length ? filled + 1 : firsts.Length + 1;
        }

        return repeated;
    }

    private int Choose(UpdateDatagram update, IEntrySource source, int repetition, int own, int room, int copies)
    {
        uint last = LastOf(source);
        (uint first, uint end) = lost.Count > 0 ? lost[0] : (sent + 1, last);
        end = end == sent ? last : end; // new entries follow at once
        bool isNeeded = first <= end && (lost.Count > 0 || sent < last);
        int allowed = isNeeded ? repetition : repetition - own;
        room = isNeeded ? Math.Clamp(room, UpdateDatagram.LengthOf(source[first]), Room) : Math.Min(room, Room);

        // Everything that has not gone often enough, if that fits one datagram and is not too much repetition.
        bool isMadeUpFor = !HasLost && AreKeyframes(source, last);
        if (!isNeeded && isMadeUpFor)
        {
            update.FirstIndex = sent + 1; // the other was sent this much: the update's promise comes after it
            return 0;
        }

        uint from = FirstToCopy(copies);
        from = isMadeUpFor ? Math.Max(from, Math.Min(sent, last)) : from;
        int all = Length(source, from, last);
        int needed = LengthNeeded(source, from, last);
        if (from <= last && all <= room && all - needed <= allowed && (isNeeded || all > 0))
        {
            Carry(update, source, from, last, room);
            lost.RemoveAll(range => range.First >= from);
            sent = Math.Max(sent, last);
            return all - needed + (isNeeded ? 0 : own);
        }

        if (!isNeeded)
        {
            // The oldest, which the others wait for.
            uint held = Carry(update, source, from, sent, Math.Min(room, allowed));
            if (held >= from)
            {
                return own + Length(source, from, held);
            }

            update.FirstIndex = sent + 1;
            return 0;
        }

        int repeated = 0;
        if (Length(source, first, end) is int length && length <= room)
        {
            while (first > from)
            {
                int more = UpdateDatagram.LengthOf(source[first - 1]);
                if (length + more > room || repeated + more > allowed)
                {
                    break;
                }

                (length, repeated, first) = (length + more, repeated + more, first - 1);
            }
        }

        uint carried = Carry(update, source, first, end, room);
        if (lost.Count > 0)
        {
            lost[0] = (Math.Min(carried, lost[0].Last) + 1, lost[0].Last);
            if (lost[0].First > lost[0].Last)
            {
                lost.RemoveAt(0);
            }
        }

        sent = Math.Max(sent, carried);
        return repeated;
    }

    /// <summary>The oldest entry that has not gone in that many updates; the one after the last that was sent if there is none.</summary>
    /// <remarks>Once one was lost with all its copies, all go again and again until it has come: links lose several datagrams in a row.</remarks>
    private uint FirstToCopy(int copies)
    {
        if (HasLost || copies > filled)
        {
            return Acknowledged + 1;
        }

        uint first = copies <= 1 ? sent + 1 : firsts[(filled - copies + 1) % firsts.Length];
        return Math.Max(Acknowledged + 1, first);
    }

    private uint LastOf(IEntrySource source) => source.Last - Acknowledged > MaxEntries ? Acknowledged + MaxEntries : source.Last;

    /// <summary>Whether all unacknowledged entries, up to the last, are keyframes.</summary>
    /// <remarks>
    /// Then only the newest one sent before is repeated, with the next. Otherwise all are repeated, since entries after a lost one can be
    /// taken only together with it.
    /// </remarks>
    private bool AreKeyframes(IEntrySource source, uint last)
    {
        for (uint number = Acknowledged; number < last; number++) // the last may be the greatest possible number
        {
            UpdateEntry entry = source[number + 1];
            if (entry.IsOwn || !IsMadeUpFor(entry.Event))
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>The size of entries in bytes, or more than fits into a datagram.</summary>
    private static int Length(IEntrySource source, uint first, uint last)
    {
        int bytes = 0;
        for (long number = first; number <= last && bytes <= Room; number++)
        {
            bytes += UpdateDatagram.LengthOf(source[(uint)number]);
        }

        return bytes;
    }

    private int LengthNeeded(IEntrySource source, uint first, uint last)
    {
        int bytes = Length(source, Math.Max(first, sent + 1), last);
        foreach ((uint First, uint Last) range in lost)
        {
            bytes += Length(source, Math.Max(first, range.First), Math.Min(last, range.Last));
        }

        return bytes;
    }

    /// <summary>Adds entries to an update, as many as fit; returns the number of the last, or of the one before the first.</summary>
    private uint Carry(UpdateDatagram update, IEntrySource source, uint first, uint last, int most = Room)
    {
        update.FirstIndex = first;
        uint held = first - 1;
        while (held < last && (most -= UpdateDatagram.LengthOf(source[held + 1])) >= 0 && update.TryAdd(source[held + 1]))
        {
            held = After(held + 1, first, last);
        }

        return held;
    }
}
