using System;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>What peers send each other all the time: clock readings, acknowledgements, the watermark, and events not yet acknowledged.</summary>
/// <remarks>
/// <para>One object, used again and again: encoding and decoding allocate nothing. For one thread at a time.</para>
/// <para>Times that may be missing say so with <see cref="SimTime.MinValue"/>. All times are within <see cref="WireFormat.MaxTimeTicks"/>
/// of their origin.</para>
/// </remarks>
public sealed partial class UpdateDatagram
{
    /// <summary>The most entries that a datagram can hold: that many numbers of the addressee's own events.</summary>
    public const int MaxEntries = (WireFormat.MaxBytes - WireFormat.EmptyUpdateBytes) / OwnEntryBytes;

    private const int VerdictBytes = 1;
    private const int OwnEntryBytes = VerdictBytes + sizeof(uint);
    private const byte OwnFlag = 0x80;
    private const byte HashFlag = 1;
    private const byte ReadyFlag = 2;

    private readonly UpdateEntry[] entries = new UpdateEntry[MaxEntries];
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

    /// <summary><see cref="Sent"/> of the newest update that the sender has of the addressee; <see cref="SimTime.MinValue"/>: none yet.</summary>
    public SimTime EchoSent { get; set; }

    /// <summary>When that one arrived, by the sender's own clock. Without <see cref="EchoSent"/> it does not travel.</summary>
    public SimTime EchoReceived { get; set; }

    /// <summary>The shared time at which the session starts; <see cref="SimTime.MinValue"/>: not decided.</summary>
    public SimTime Start { get; set; }

    /// <summary>The shared time before which no accepted event comes after this update's last entry; <see cref="SimTime.MinValue"/>: none.</summary>
    public SimTime Watermark { get; set; }

    /// <summary>
    /// From a joiner: how many entries of the host's log it has without a gap. From the host: up to which of the joiner's own sequence
    /// numbers it has all.
    /// </summary>
    public uint EventsReceived { get; set; }

    /// <summary>The sender's clock is good enough to begin.</summary>
    public bool Ready { get; set; }

    /// <summary>Whether <see cref="HashTime"/> and <see cref="StateHash"/> travel.</summary>
    public bool HasStateHash { get; set; }

    /// <summary>The committed shared time of <see cref="StateHash"/>; zero without one.</summary>
    public SimTime HashTime { get; set; }

    /// <summary>The hash of the sender's state; zero without one.</summary>
    public ulong StateHash { get; set; }

    /// <summary>
    /// The number of the first entry: from the host its index in the log. The entry after it has the next number, and none is above
    /// 4,294,967,295. It may be beyond what the addressee has: what is between is in other updates.
    /// </summary>
    public uint FirstIndex { get; set; }

    /// <summary>The entries, valid until the next change to this object.</summary>
    public ReadOnlySpan<UpdateEntry> Entries => Held;

    /// <summary>The same for this library, which indexes no read-only span: some Mono runtimes cannot link that (docs/ARCHITECTURE.md).</summary>
    internal Span<UpdateEntry> Held => entries.AsSpan(0, count);

    /// <summary>The datagram's length as it stands, in bytes.</summary>
    public int EncodedLength => WireFormat.EmptyUpdateBytes + (HasStateHash ? WireFormat.StateHashBytes : 0) + entryBytes;

    /// <summary>Makes every field zero, false or none, and takes all entries out.</summary>
    public void Clear()
    {
        SessionId = StateHash = 0;
        Number = EventsReceived = FirstIndex = 0;
        Peer = 0;
        Sent = HashTime = SimTime.Zero;
        EchoSent = EchoReceived = Start = Watermark = SimTime.MinValue;
        Ready = HasStateHash = false;
        ClearEntries();
    }

    /// <summary>Takes all entries out.</summary>
    public void ClearEntries() => count = entryBytes = 0;

    /// <summary>Puts one more entry at the end, if it fits; room for a state hash is always kept.</summary>
    /// <returns>False when the datagram is full for an event of this kind.</returns>
    /// <exception cref="ArgumentException">The event is not <see cref="EventFormat.IsWellFormed"/>, or the verdict none of the enum's.</exception>
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
            && WireFormat.EmptyUpdateBytes + WireFormat.StateHashBytes + entryBytes + length <= WireFormat.MaxBytes;
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
