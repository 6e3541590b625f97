using System;
using LagSim.Events;

namespace LagSim.Net.Wire;

/// <summary>One of the events that a <see cref="DesyncQueryDatagram"/> asked for, or the statement that there are none.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct DesyncReportDatagram
{
    /// <summary>Creates a report of one event.</summary>
    /// <param name="sessionId">The session.</param>
    /// <param name="total">How many events there are.</param>
    /// <param name="index">Which of them this is, counted from 0.</param>
    /// <param name="logIndex">Its place in the host's log, counted from 1.</param>
    /// <param name="what">The event.</param>
    public DesyncReportDatagram(ulong sessionId, uint total, uint index, uint logIndex, in ExternalEvent what)
    {
        SessionId = sessionId;
        IsWhole = true;
        Total = total;
        Index = index;
        LogIndex = logIndex;
        Event = what;
    }

    /// <summary>
    /// Creates a report without events: whole if nothing happened in that time; not whole if the host no longer has all that did.
    /// </summary>
    public DesyncReportDatagram(ulong sessionId, bool isWhole)
    {
        SessionId = sessionId;
        IsWhole = isWhole;
        Total = Index = LogIndex = 0;
        Event = default;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>Whether the host still has all events of the requested time; if not, it sends none.</summary>
    public bool IsWhole { get; }

    /// <summary>The number of events.</summary>
    public uint Total { get; }

    /// <summary>Which of them this is, counted from 0, below <see cref="Total"/>; 0 if there are none.</summary>
    public uint Index { get; }

    /// <summary>Its place in the host's log, counted from 1; 0 if there are none.</summary>
    public uint LogIndex { get; }

    /// <summary>The event; meaningless if there are none.</summary>
    public ExternalEvent Event { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length: <see cref="WireFormat.EmptyDesyncReportBytes"/>, and with an event 4 and the event's more.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that, or the event cannot be encoded.</exception>
    public int Encode(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.DesyncReport);
        writer.WriteUInt64(SessionId);
        writer.WriteByte((byte)(IsWhole ? 1 : 0));
        writer.WriteUInt32(Total);
        writer.WriteUInt32(Index);
        if (Total > 0)
        {
            writer.WriteUInt32(LogIndex);
            EventFormat.Write(ref writer, Event);
        }

        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="report">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out DesyncReportDatagram report, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.DesyncReport);
        ulong session = reader.ReadUInt64();
        byte whole = reader.ReadByte();
        uint total = reader.ReadUInt32();
        uint index = reader.ReadUInt32();
        reader.Require(whole <= 1 && (total == 0 ? index == 0 : whole == 1 && index < total));
        if (total > 0)
        {
            uint place = reader.ReadUInt32();
            reader.Require(place > 0);
            report = new DesyncReportDatagram(session, total, index, place, EventFormat.Read(ref reader));
        }
        else
        {
            report = new DesyncReportDatagram(session, whole == 1);
        }

        return reader.Finish(out refusal);
    }
}
