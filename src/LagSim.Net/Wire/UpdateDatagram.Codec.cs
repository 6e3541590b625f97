using System;
using LagSim.Time;

namespace LagSim.Net.Wire;

// How an update is encoded and decoded; the layout is in docs/WIRE.md.
internal sealed partial class UpdateDatagram
{
    /// <summary>Writes the datagram.</summary>
    /// <param name="destination">At least <see cref="EncodedLength"/> bytes; <see cref="WireFormat.MaxPlainBytes"/> always do.</param>
    /// <returns>Its length, <see cref="EncodedLength"/>.</returns>
    /// <exception cref="ArgumentException">The destination is too short, or a time is out of range.</exception>
    /// <exception cref="InvalidOperationException">
    /// The numbers of the entries do not end by 4,294,967,295, or bits of an echo are set without its number.
    /// </exception>
    public int Encode(Span<byte> destination)
    {
        if (!AreIndicesInRange)
        {
            throw new InvalidOperationException($"{count} entries from number {FirstIndex} on run past the last number there is.");
        }

        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Update);
        writer.WriteUInt64(SessionId);
        writer.WriteByte(Peer);
        writer.WriteUInt32(Number);
        writer.WriteTime(Sent);
        WriteEcho(ref writer);
        writer.WriteOptionalTime(Watermark);
        writer.WriteUInt32(EventsReceived);
        writer.WriteByte((byte)((HasStateHash ? HashFlag | ((hashCount - 1) << HashesShift) : 0) | (Ready ? ReadyFlag : 0) | (Start == SimTime.MinValue ? 0 : StartFlag)));
        if (Start != SimTime.MinValue)
        {
            writer.WriteTime(Start);
        }

        if (HasStateHash)
        {
            writer.WriteTime(HashTime);
            foreach (ulong hash in Hashes)
            {
                writer.WriteUInt64(hash);
            }
        }

        writer.WriteUInt32(FirstIndex);
        writer.WriteByte((byte)count);
        foreach (ref readonly UpdateEntry entry in Held)
        {
            writer.WriteByte((byte)((byte)entry.Verdict | (entry.IsOwn ? OwnFlag : 0)));
            if (entry.IsOwn)
            {
                writer.WriteUInt32(entry.Sequence);
            }
            else
            {
                EventFormat.Write(ref writer, entry.Event);
            }
        }

        return writer.Position;
    }

    /// <summary>Reads a datagram into this object; never throws, never allocates. A refused one leaves it cleared.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public bool TryDecode(ReadOnlySpan<byte> datagram, out WireRefusal refusal)
    {
        Clear();
        WireReader reader = WireReader.Open(datagram, DatagramType.Update);
        ReadFields(ref reader);
        int announced = reader.ReadByte();
        reader.Require(announced <= MaxEntries);
        while (count < announced && reader.Refusal == WireRefusal.None)
        {
            UpdateEntry entry = ReadEntry(ref reader);
            entries[count++] = entry;
            entryBytes += LengthOf(entry);
        }

        reader.Require(AreIndicesInRange);
        bool accepted = reader.Finish(out refusal);
        if (!accepted)
        {
            Clear();
        }

        return accepted;
    }

    private static UpdateEntry ReadEntry(ref WireReader reader)
    {
        byte first = reader.ReadByte();
        Verdict verdict = (Verdict)(first & ~OwnFlag);
        reader.Require(verdict <= Verdicts.Last);
        if ((first & OwnFlag) == 0)
        {
            return new UpdateEntry(verdict, EventFormat.Read(ref reader));
        }

        uint sequence = reader.ReadUInt32();
        reader.Require(sequence > 0);
        return new UpdateEntry(verdict, sequence);
    }

    private bool AreIndicesInRange => count == 0 || FirstIndex <= uint.MaxValue - (uint)(count - 1);

    private void WriteEcho(ref WireWriter writer)
    {
        if (EchoNumber == 0 && EchoBits != 0)
        {
            throw new InvalidOperationException("Without the number of an update that came, there are none before it.");
        }

        writer.WriteUInt32(EchoNumber);
        writer.WriteUInt32(EchoBits);
        if (EchoNumber == 0)
        {
            writer.WriteOptionalTime(SimTime.MinValue);
        }
        else
        {
            writer.WriteTime(EchoReceived);
        }
    }

    private void ReadFields(ref WireReader reader)
    {
        SessionId = reader.ReadUInt64();
        Peer = reader.ReadByte();
        Number = reader.ReadUInt32();
        Sent = reader.ReadTime();
        EchoNumber = reader.ReadUInt32();
        EchoBits = reader.ReadUInt32();
        EchoReceived = reader.ReadOptionalTime();
        reader.Require((EchoNumber == 0) == (EchoReceived == SimTime.MinValue) && (EchoNumber > 0 || EchoBits == 0)); // all or none
        Watermark = reader.ReadOptionalTime();
        EventsReceived = reader.ReadUInt32();
        byte flags = reader.ReadByte();
        int more = flags >> HashesShift;
        reader.Require(more < MaxHashes && (more == 0 || (flags & HashFlag) != 0));
        Ready = (flags & ReadyFlag) != 0;
        Start = (flags & StartFlag) != 0 ? reader.ReadTime() : SimTime.MinValue;
        hashCount = 0;
        HashTime = SimTime.Zero;
        if ((flags & HashFlag) != 0)
        {
            HashTime = reader.ReadTime();
            for (; hashCount <= more && more < MaxHashes; hashCount++)
            {
                hashes[hashCount] = reader.ReadUInt64();
            }
        }

        FirstIndex = reader.ReadUInt32();
    }
}
