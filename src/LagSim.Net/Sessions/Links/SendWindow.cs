using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// Chooses which entries the next update of a link carries: what was lost first, then what is new, then repetitions as far as they are
/// allowed.
/// </summary>
/// <remarks>
/// <para>Each entry has to go once, and again for each time that it was lost with everything that carried it (<see cref="Lose"/>). That is
/// needed, whatever the link is like. Repetition of what is on its way hides losses before they are known, and is for links with
/// room.</para>
/// <para>At most <see cref="MaxEntries"/> are under way. Keyframes are made up for by later ones, so they are repeated once, with the
/// next.</para>
/// </remarks>
internal class SendWindow
{
    /// <summary>
    /// So many entries beyond the acknowledged ones are sent at most; a receiver keeps as many that came before their turn.
    /// </summary>
    internal const int MaxEntries = 4096;

    /// <summary>So many datagrams go out at a time at most; the next a millisecond later.</summary>
    internal const int MaxDatagramsAtOnce = 4;

    /// <summary>What the entries of one update take at most, in bytes.</summary>
    private const int Room = WireFormat.MaxBytes - WireFormat.EmptyUpdateBytes - WireFormat.MostHashBytes - WireFormat.StartBytes;

    private readonly List<(uint First, uint Last)> lost = new(); // ascending, apart, above what is acknowledged
    private uint sent;
    private uint lostUpTo; // the greatest number that was ever sent in vain

    /// <param name="acknowledged">The other has the entries up to this one.</param>
    internal SendWindow(uint acknowledged) => Acknowledged = sent = acknowledged;

    /// <summary>The other has the entries up to this one.</summary>
    internal uint Acknowledged { get; private set; }

    /// <summary>The greatest number that was sent, or acknowledged.</summary>
    internal uint Sent => sent;

    /// <summary>The number up to which entries are in the update, once one more was put in: that one's.</summary>
    internal virtual uint After(uint added, uint first, uint last) => added;

    /// <summary>Begins anew with entries after that number, before any was sent.</summary>
    internal void StartAfter(uint acknowledged)
    {
        Acknowledged = sent = acknowledged;
        lostUpTo = 0;
        lost.Clear();
    }

    /// <summary>
    ///  Whether the next of its kind carries what this one would have, if it is lost: it waits for its acknowledgement, and need not be
    /// sent again and again.
    /// </summary>
    internal static bool IsMadeUpFor(in ExternalEvent external) => external.Kind == EventKind.HoldKeyframe;

    /// <summary>Notes that the other has the entries up to a number; a lower one than before says nothing.</summary>
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

    /// <summary>Notes that entries were sent in vain: they have to go again, unless they are on their way again already.</summary>
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
    ///  Whether something was sent in vain that is not acknowledged yet. Then all of it is worth a repetition, keyframes too: links lose
    /// several datagrams in a row, however far apart, so whoever sends again only when the answer is overdue may wait for seconds.
    /// </summary>
    internal bool HasLost => lostUpTo > Acknowledged;

    /// <summary>Whether anything has to go again.</summary>
    internal bool HasToGoAgain => lost.Count > 0;

    /// <summary>Whether anything has to go.</summary>
    internal bool HasNeeded(IEntrySource source) => lost.Count > 0 || sent < LastOf(source);

    /// <summary>How many bytes the entries take that a repetition would carry; 0 if there are none.</summary>
    /// <param name="source">The entries.</param>
    internal int RepetitionBytes(IEntrySource source)
    {
        int bytes = 0;
        for (uint number = Acknowledged; number < sent && bytes < Room; number++)
        {
            bytes += UpdateDatagram.LengthOf(source[number + 1]);
        }

        return Math.Min(bytes, Room);
    }

    /// <summary>Puts entries into an update that has none, and sets the number of the first.</summary>
    /// <param name="update">The update.</param>
    /// <param name="source">The entries.</param>
    /// <param name="repetition">How many bytes may be repetition; of an update that is nothing else, its own bytes among them.</param>
    /// <param name="own">How many bytes an update has beside its entries, UDP and IP included.</param>
    /// <param name="room">How many bytes its entries may take; one always goes.</param>
    /// <returns>How many were.</returns>
    internal int Fill(UpdateDatagram update, IEntrySource source, int repetition, int own, int room)
    {
        uint last = LastOf(source);
        (uint first, uint end) = lost.Count > 0 ? lost[0] : (sent + 1, last);
        end = end == sent ? last : end; // what is new follows at once
        bool isNeeded = first <= end && (lost.Count > 0 || sent < last);
        int allowed = isNeeded ? repetition : repetition - own;
        room = isNeeded ? Math.Clamp(room, UpdateDatagram.LengthOf(source[first]), Room) : Math.Min(room, Room);

        // All that is not acknowledged, if that is one datagram and not too much repetition.
        bool isMadeUpFor = !HasLost && AreKeyframes(source, last);
        if (!isNeeded && isMadeUpFor)
        {
            update.FirstIndex = sent + 1; // so much the other has been sent: what the update promises comes after that
            return 0;
        }

        uint from = isMadeUpFor ? Math.Max(Acknowledged + 1, Math.Min(sent, last)) : Acknowledged + 1;
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
            // The oldest, which keep the others waiting.
            uint held = Carry(update, source, Acknowledged + 1, sent, Math.Min(room, allowed));
            if (held > Acknowledged)
            {
                return own + Length(source, Acknowledged + 1, held);
            }

            update.FirstIndex = sent + 1;
            return 0;
        }

        int repeated = 0;
        if (Length(source, first, end) is int length && length <= room)
        {
            while (first > Acknowledged + 1)
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

    private uint LastOf(IEntrySource source) => source.Last - Acknowledged > MaxEntries ? Acknowledged + MaxEntries : source.Last;

    /// <summary>
    ///  Whether all entries that are not acknowledged, up to the last, are keyframes. Then it is the newest sent before that is repeated,
    /// with the next; where there is anything else, it is all, since what comes after one that is lost can be taken only with it.
    /// </summary>
    private bool AreKeyframes(IEntrySource source, uint last)
    {
        for (uint number = Acknowledged; number < last; number++) // the last may be the greatest number there is
        {
            UpdateEntry entry = source[number + 1];
            if (entry.IsOwn || !IsMadeUpFor(entry.Event))
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>How many bytes entries take, or more than fits into a datagram.</summary>
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

    /// <summary>Has an update carry entries, as many as fit; the number of the last, or of the one before the first.</summary>
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
