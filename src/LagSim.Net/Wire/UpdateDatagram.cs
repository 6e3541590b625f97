using System;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>
/// What peers send each other all the time: clock readings, acknowledgements, the watermark, and events not yet acknowledged.
/// </summary>
/// <remarks>
/// <para>One object, used again and again: encoding and decoding allocate nothing. For one thread at a time.</para>
/// <para>Times that may be missing say so with <see cref="SimTime.MinValue"/>. All times are within <see cref="WireFormat.MaxTimeTicks"/>
/// of their origin.</para>
/// </remarks>
internal sealed partial class UpdateDatagram
{
    /// <summary>The most entries that a datagram can hold: that many numbers of the addressee's own events.</summary>
    public const int MaxEntries = (WireFormat.MaxBytes - WireFormat.EmptyUpdateBytes) / OwnEntryBytes;

    /// <summary>The most hashes that a datagram can hold.</summary>
    public const int MaxHashes = 8;

    private const int VerdictBytes = 1;
    private const int OwnEntryBytes = VerdictBytes + sizeof(uint);
    private const byte OwnFlag = 0x80;
    private const byte HashFlag = 1;
    private const byte ReadyFlag = 2;
    private const byte StartFlag = 4;
    private const int HashesShift = 3; // three bits of the flags: how many hashes, less one

    private readonly UpdateEntry[] entries = new UpdateEntry[MaxEntries];
    private readonly ulong[] hashes = new ulong[MaxHashes];
    private int hashCount;
    private int count;
    private int entryBytes;

    /// <summary>A cleared update.</summary>
    public UpdateDatagram() => Clear();

    /// <summary>The session.</summary>
    public ulong SessionId { get; set; }

    /// <summary>The sender; 0 is the host.</summary>
    public byte Peer { get; set; }

    /// <summary>Counts the sender's updates to this addressee.</summary>
    public uint Number { get; set; }

    /// <summary>When this was sent, by the sender's own clock.</summary>
    public SimTime Sent { get; set; }

    /// <summary><see cref="Number"/> of the newest update that the sender has of the addressee; 0: none yet.</summary>
    public uint EchoNumber { get; set; }

    /// <summary>
    ///  Which of the 32 updates before that one the sender has: bit n is set for <see cref="EchoNumber"/> - 1 - n. 0 without
    /// <see cref="EchoNumber"/>.
    /// </summary>
    public uint EchoBits { get; set; }

    /// <summary>When the newest one arrived, by the sender's own clock. Without <see cref="EchoNumber"/> it does not travel.</summary>
    public SimTime EchoReceived { get; set; }

    /// <summary>
    /// The shared time at which the session starts; <see cref="SimTime.MinValue"/>: not decided, or the addressee knows it.
    /// </summary>
    public SimTime Start { get; set; }

    /// <summary>
    /// The shared time before which no accepted event comes after this update's last entry; <see cref="SimTime.MinValue"/>: none.
    /// </summary>
    public SimTime Watermark { get; set; }

    /// <summary>
    /// From a client: how many entries of the host's log it has without a gap. From the host: up to which of the client's own sequence
    /// numbers it has all.
    /// </summary>
    public uint EventsReceived { get; set; }

    /// <summary>The sender's clock is good enough to begin.</summary>
    public bool Ready { get; set; }

    /// <summary>Whether <see cref="HashTime"/> and <see cref="StateHashes"/> travel.</summary>
    public bool HasStateHash => hashCount > 0;

    /// <summary>The committed shared time of the first of <see cref="StateHashes"/>; zero without one.</summary>
    public SimTime HashTime { get; private set; }

    /// <summary>
    ///  The hashes of the sender's committed states, newest first, up to <see cref="MaxHashes"/>: each of the instant one commit interval
    /// before that of the one before it. Valid until the next change to this object.
    /// </summary>
    public ReadOnlySpan<ulong> StateHashes => hashes.AsSpan(0, hashCount);

    /// <summary>The same for this library; see <see cref="Held"/>.</summary>
    internal Span<ulong> Hashes => hashes.AsSpan(0, hashCount);

    /// <summary>
    /// The number of the first entry: from the host its index in the log. The entry after it has the next number, and none is above
    /// 4,294,967,295. It may be beyond what the addressee has: what is between is in other updates.
    /// </summary>
    public uint FirstIndex { get; set; }

    /// <summary>The entries, valid until the next change to this object.</summary>
    public ReadOnlySpan<UpdateEntry> Entries => Held;

    /// <summary>
    /// The same for this library, which indexes no read-only span: some Mono runtimes cannot link that (docs/ARCHITECTURE.md).
    /// </summary>
    internal Span<UpdateEntry> Held => entries.AsSpan(0, count);

    /// <summary>The datagram's length as it stands, in bytes.</summary>
    public int EncodedLength => WireFormat.EmptyUpdateBytes + HashBytes + StartBytes + entryBytes;

    private int HashBytes => hashCount == 0 ? 0 : WireFormat.StateHashBytes + ((hashCount - 1) * sizeof(ulong));

    private int StartBytes => Start == SimTime.MinValue ? 0 : WireFormat.StartBytes;

    /// <summary>Makes every field zero, false or none, and takes all entries out.</summary>
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

    /// <summary>Takes all entries out.</summary>
    public void ClearEntries() => count = entryBytes = 0;

    /// <summary>Puts the hash of one more committed state at the end.</summary>
    /// <param name="time">Of the first, its committed shared time; of others it is not looked at.</param>
    /// <param name="hash">The hash.</param>
    /// <returns>False where there are <see cref="MaxHashes"/>.</returns>
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

    /// <summary>Puts one more entry at the end, if it fits; room for the start is always kept. Hashes are put in before.</summary>
    /// <returns>False when the datagram is full for an event of this kind.</returns>
    /// <exception cref="ArgumentException">
    /// The event is not <see cref="EventFormat.IsWellFormed"/>, or the verdict none of the enum's.
    /// </exception>
    public bool TryAdd(Verdict verdict, in ExternalEvent what) => TryAdd(new UpdateEntry(verdict, what));

    /// <summary>Puts the addressee's own event of that number at the end, if it fits.</summary>
    /// <returns>False when the datagram is full.</returns>
    /// <exception cref="ArgumentException">The number is 0, or the verdict none of the enum's.</exception>
    public bool TryAddOwn(Verdict verdict, uint sequence)
    {
        if (sequence == 0 || verdict > Verdict.Invalid)
        {
            throw new ArgumentException(
                $"Verdict {(byte)verdict} on event {sequence} cannot travel: events count from 1, verdicts go to {(byte)Verdict.Invalid}.", nameof(sequence));
        }

        return TryAdd(new UpdateEntry(verdict, sequence));
    }

    /// <summary>Puts an entry at the end, if it fits, as the two above do.</summary>
    internal bool TryAdd(in UpdateEntry entry)
    {
        if (!entry.IsOwn && (!EventFormat.IsWellFormed(entry.Event) || entry.Verdict > Verdict.Invalid))
        {
            throw new ArgumentException($"'{entry.Event}' cannot travel: its kind, sequence, time or a number in it is out of range.", nameof(entry));
        }

        int length = LengthOf(entry);
        bool fits = count < MaxEntries
            && WireFormat.EmptyUpdateBytes + HashBytes + WireFormat.StartBytes + entryBytes + length <= WireFormat.MaxBytes;
        if (fits)
        {
            entries[count++] = entry;
            entryBytes += length;
        }

        return fits;
    }

    internal static int LengthOf(in UpdateEntry entry) =>
        entry.IsOwn ? OwnEntryBytes : VerdictBytes + EventFormat.EncodedLength(entry.Event.Kind);
}
