using System;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>
/// The datagram that peers exchange all the time: clock readings, acknowledgements, the watermark, and events not yet acknowledged.
/// </summary>
/// <remarks>
/// <para>One object, reused: encoding and decoding allocate nothing. For one thread at a time.</para>
/// <para>A missing time is <see cref="SimTime.MinValue"/>. All times are within <see cref="WireFormat.MaxTimeTicks"/> of their
/// origin.</para>
/// </remarks>
internal sealed partial class UpdateDatagram
{
    /// <summary>The most entries that a datagram can hold: that many numbers of the addressee's own events.</summary>
    public const int MaxEntries = (WireFormat.MaxPlainBytes - WireFormat.EmptyUpdateBytes) / OwnEntryBytes;

    /// <summary>The most hashes that a datagram can hold.</summary>
    public const int MaxHashes = 8;

    private const int VerdictBytes = 1;
    private const int OwnEntryBytes = VerdictBytes + sizeof(uint);
    private const byte OwnFlag = 0x80;
    private const byte HashFlag = 1;
    private const byte ReadyFlag = 2;
    private const byte StartFlag = 4;
    private const int HashesShift = 3; // three bits of the flags: the number of hashes, less one

    private readonly UpdateEntry[] entries = new UpdateEntry[MaxEntries];
    private readonly ulong[] hashes = new ulong[MaxHashes];
    private int hashCount;
    private int count;
    private int entryBytes;

    /// <summary>Creates a cleared update.</summary>
    public UpdateDatagram() => Clear();

    /// <summary>The session.</summary>
    public ulong SessionId { get; set; }

    /// <summary>The sender; 0 is the host.</summary>
    public byte Peer { get; set; }

    /// <summary>Counts the sender's updates to this addressee.</summary>
    public uint Number { get; set; }

    /// <summary>When this was sent, by the sender's own clock.</summary>
    public SimTime Sent { get; set; }

    /// <summary><see cref="Number"/> of the newest update that the sender has received from the addressee; 0 for none yet.</summary>
    public uint EchoNumber { get; set; }

    /// <summary>
    /// Which of the 32 updates before that one the sender has: bit n is set for <see cref="EchoNumber"/> - 1 - n. 0 without
    /// <see cref="EchoNumber"/>.
    /// </summary>
    public uint EchoBits { get; set; }

    /// <summary>When the newest one arrived, by the sender's own clock. Not sent without <see cref="EchoNumber"/>.</summary>
    public SimTime EchoReceived { get; set; }

    /// <summary>
    /// The shared time at which the session starts; <see cref="SimTime.MinValue"/> if not decided, or known to the addressee.
    /// </summary>
    public SimTime Start { get; set; }

    /// <summary>
    /// The shared time before which no accepted event comes after this update's last entry; <see cref="SimTime.MinValue"/> for none.
    /// </summary>
    public SimTime Watermark { get; set; }

    /// <summary>
    /// From a client: how many entries of the host's log it has without a gap. From the host: up to which sequence number it has all of the
    /// client's own events.
    /// </summary>
    public uint EventsReceived { get; set; }

    /// <summary>Whether the sender's clock is good enough to begin.</summary>
    public bool Ready { get; set; }

    /// <summary>Whether <see cref="HashTime"/> and <see cref="StateHashes"/> are sent.</summary>
    public bool HasStateHash => hashCount > 0;

    /// <summary>The committed shared time of the first of <see cref="StateHashes"/>; zero without one.</summary>
    public SimTime HashTime { get; private set; }

    /// <summary>
    /// The hashes of the sender's committed states, newest first, up to <see cref="MaxHashes"/>; each is one commit interval before the
    /// previous one. Valid until the next change to this object.
    /// </summary>
    public ReadOnlySpan<ulong> StateHashes => hashes.AsSpan(0, hashCount);

    /// <summary>The same for use in this library; see <see cref="Held"/>.</summary>
    internal Span<ulong> Hashes => hashes.AsSpan(0, hashCount);

    /// <summary>
    /// The number of the first entry; for the host its index in the log. The next entry has the next number, and none is above
    /// 4,294,967,295. It may be beyond what the addressee has; the entries between are in other updates.
    /// </summary>
    public uint FirstIndex { get; set; }

    /// <summary>The entries, valid until the next change to this object.</summary>
    public ReadOnlySpan<UpdateEntry> Entries => Held;

    /// <summary>
    /// The same for use in this library, which never indexes a read-only span: some Mono runtimes cannot link that (docs/ARCHITECTURE.md).
    /// </summary>
    internal Span<UpdateEntry> Held => entries.AsSpan(0, count);

    /// <summary>The current encoded length of the datagram, in bytes.</summary>
    public int EncodedLength => WireFormat.EmptyUpdateBytes + HashBytes + StartBytes + entryBytes;

    private int HashBytes => hashCount == 0 ? 0 : WireFormat.StateHashBytes + ((hashCount - 1) * sizeof(ulong));

    private int StartBytes => Start == SimTime.MinValue ? 0 : WireFormat.StartBytes;

    /// <summary>Makes every field zero, false or none, and removes all entries.</summary>
    public void Clear()
    {
        SessionId = 0;
        Number = EchoNumber = EchoBits = EventsReceived = FirstIndex = 0;
        Peer = 0;
        Sent = HashTime = SimTime.Zero;
        EchoReceived = Start = Watermark = SimTime.MinValue;
        Ready = false;
        hashCount = 0;
        ClearEntries();
    }

    /// <summary>Removes all entries.</summary>
    public void ClearEntries() => count = entryBytes = 0;

    /// <summary>Adds the hash of one more committed state at the end.</summary>
    /// <param name="time">For the first hash its committed shared time; ignored for the others.</param>
    /// <param name="hash">The hash.</param>
    /// <returns>False if there are <see cref="MaxHashes"/> already.</returns>
    public bool TryAddHash(SimTime time, ulong hash)
    {
        if (hashCount == MaxHashes)
        {
            return false;
        }

        HashTime = hashCount == 0 ? time : HashTime;
        hashes[hashCount++] = hash;
        return true;
    }

    /// <summary>Adds an entry at the end, if it fits; room for the start is always reserved. Add hashes first.</summary>
    /// <returns>False if the datagram is full for an event of this kind.</returns>
    /// <exception cref="ArgumentException">
    /// The event is not <see cref="EventFormat.IsWellFormed"/>, or the verdict none of the enum's.
    /// </exception>
    public bool TryAdd(Verdict verdict, in ExternalEvent what) => TryAdd(new UpdateEntry(verdict, what));

    /// <summary>Adds the addressee's own event of that number at the end, if it fits.</summary>
    /// <returns>False if the datagram is full.</returns>
    /// <exception cref="ArgumentException">The number is 0, or the verdict none of the enum's.</exception>
    public bool TryAddOwn(Verdict verdict, uint sequence)
    {
        if (sequence == 0 || verdict > Verdicts.Last)
        {
            throw new ArgumentException(
                $"Verdict {(byte)verdict} on event {sequence} cannot travel: events count from 1, verdicts go to {(byte)Verdicts.Last}.", nameof(sequence));
        }

        return TryAdd(new UpdateEntry(verdict, sequence));
    }

    /// <summary>Adds an entry at the end, if it fits, as the two above do.</summary>
    internal bool TryAdd(in UpdateEntry entry)
    {
        if (!entry.IsOwn && (!EventFormat.IsWellFormed(entry.Event) || entry.Verdict > Verdicts.Last))
        {
            throw new ArgumentException($"'{entry.Event}' cannot travel: its kind, sequence, time or a number in it is out of range.", nameof(entry));
        }

        int length = LengthOf(entry);
        bool fits = count < MaxEntries
            && WireFormat.EmptyUpdateBytes + HashBytes + WireFormat.StartBytes + entryBytes + length <= WireFormat.MaxPlainBytes;
        if (fits)
        {
            entries[count++] = entry;
            entryBytes += length;
        }

        return fits;
    }

    internal static int LengthOf(in UpdateEntry entry) =>
        entry.IsOwn ? OwnEntryBytes : VerdictBytes + EventFormat.EncodedLength(entry.Event);
}
