using System;

namespace LagSim.Net.Wire;

/// <summary>
/// Who has which number: the host's list of peers, as far as it has changed since the revision that the client has. Repeated until a
/// <see cref="RosterReceivedDatagram"/> acknowledges it.
/// </summary>
/// <remarks>One object, reused. For one thread at a time.</remarks>
internal sealed class RosterDatagram
{
    /// <summary>The most entries, all of numbers that nobody has.</summary>
    public const int MaxEntries = byte.MaxValue;

    private readonly RosterEntry[] entries = new RosterEntry[MaxEntries];
    private int count;
    private int entryBytes;

    /// <summary>The session.</summary>
    public ulong SessionId { get; set; }

    /// <summary>The revision that the client has; 0 for none.</summary>
    public uint After { get; set; }

    /// <summary>The revision that the client has once it has these entries.</summary>
    public uint UpTo { get; set; }

    /// <summary>The host's revision; later than <see cref="UpTo"/> if more entries follow.</summary>
    public uint Newest { get; set; }

    /// <summary>The entries, by ascending revision. Valid until the next change to this object.</summary>
    public Span<RosterEntry> Entries => entries.AsSpan(0, count);

    /// <summary>The encoded length.</summary>
    public int EncodedLength => WireFormat.EmptyRosterBytes + entryBytes;

    /// <summary>Makes every field zero, and removes all entries.</summary>
    public void Clear()
    {
        SessionId = 0;
        After = UpTo = Newest = 0;
        count = entryBytes = 0;
    }

    /// <summary>Adds an entry at the end, if it fits into a datagram of that many bytes before sealing.</summary>
    public bool TryAdd(in RosterEntry entry, int most = WireFormat.MaxPlainBytes)
    {
        bool fits = count < MaxEntries && EncodedLength + entry.EncodedLength <= most;
        if (fits)
        {
            entries[count++] = entry;
            entryBytes += entry.EncodedLength;
        }

        return fits;
    }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="EncodedLength"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    public int Encode(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Roster);
        writer.WriteUInt64(SessionId);
        writer.WriteUInt32(After);
        writer.WriteUInt32(UpTo);
        writer.WriteUInt32(Newest);
        writer.WriteByte((byte)count);
        foreach (ref readonly RosterEntry entry in Entries)
        {
            entry.Write(ref writer);
        }

        return writer.Position;
    }

    /// <summary>Reads a datagram into this object; never throws. A refused one leaves it cleared.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public bool TryDecode(ReadOnlySpan<byte> datagram, out WireRefusal refusal)
    {
        Clear();
        WireReader reader = WireReader.Open(datagram, DatagramType.Roster);
        SessionId = reader.ReadUInt64();
        After = reader.ReadUInt32();
        UpTo = reader.ReadUInt32();
        Newest = reader.ReadUInt32();
        reader.Require(After < UpTo && UpTo <= Newest);
        int announced = reader.ReadByte();
        reader.Require(announced > 0);
        while (count < announced && reader.Refusal == WireRefusal.None)
        {
            RosterEntry entry = RosterEntry.Read(ref reader);
            entries[count++] = entry;
            entryBytes += entry.EncodedLength;
        }

        bool accepted = reader.Finish(out refusal);
        if (!accepted)
        {
            Clear();
        }

        return accepted;
    }
}
