using System;
using LagSim.Net.Wire;

namespace LagSim.Tests.Wire;

/// <summary>All datagram types through one door, as a session's receive path uses them.</summary>
internal static class AnyDatagram
{
    internal delegate int Encoder(Span<byte> destination);

    internal static byte[] Bytes(Encoder encode)
    {
        Span<byte> buffer = stackalloc byte[WireFormat.MaxBytes];
        return buffer.Slice(0, encode(buffer)).ToArray();
    }

    internal static byte[] ChunkBytes(ulong session, uint index, ReadOnlySpan<byte> data)
    {
        Span<byte> buffer = stackalloc byte[WireFormat.MaxBytes];
        return buffer.Slice(0, new SnapshotChunkDatagram(session, index, data).Encode(buffer)).ToArray();
    }

    internal static byte[] SecureAnswerBytes(DatagramType type, ulong nonce, ReadOnlySpan<byte> message)
    {
        byte[] prologue = new byte[SecureAnswerDatagram.PrologueBytes];
        SecureAnswerDatagram.WritePrologue(prologue, type, nonce);
        return [.. prologue, .. message];
    }

    internal static byte[] KeyExchangeBytes(DatagramType type, ulong session, uint generation, ReadOnlySpan<byte> message)
    {
        byte[] bytes = new byte[WireFormat.KeyExchangeBytes];
        return bytes[..new KeyExchangeDatagram(session, generation, message).Encode(type, bytes)];
    }

    internal static byte[] SealedBytes(ulong session, ulong number, ReadOnlySpan<byte> body, byte generation = 0)
    {
        byte[] prologue = new byte[SealedDatagram.PrologueBytes];
        WireWriter writer = new(prologue);
        writer.WriteHeader(DatagramType.Sealed);
        writer.WriteUInt64(session);
        writer.WriteUInt32((uint)number);
        writer.WriteByte((byte)(number >> 32));
        writer.WriteByte(generation);
        return [.. prologue, .. body];
    }

    /// <summary>What decoding and encoding again makes of the bytes; null when they are refused.</summary>
    internal static byte[]? Again(ReadOnlySpan<byte> bytes, UpdateDatagram scratch, out WireRefusal refusal)
    {
        if (!WireFormat.TryReadType(bytes, out DatagramType type, out refusal))
        {
            return null;
        }

        switch (type)
        {
            case DatagramType.ConnectRequest:
                return ConnectRequestDatagram.TryDecode(bytes, out ConnectRequestDatagram request, out refusal) ? Bytes(request.Encode) : null;
            case DatagramType.Challenge:
                return ChallengeDatagram.TryDecode(bytes, out ChallengeDatagram challenge, out refusal) ? Bytes(challenge.Encode) : null;
            case DatagramType.SnapshotRequest:
                return SnapshotRequestDatagram.TryDecode(bytes, out SnapshotRequestDatagram asked, out refusal) ? Bytes(asked.Encode) : null;
            case DatagramType.SnapshotChunk:
                return SnapshotChunkDatagram.TryDecode(bytes, out SnapshotChunkDatagram chunk, out refusal) ? ChunkBytes(chunk.SessionId, chunk.Offset, chunk.Data) : null;
            case DatagramType.Join:
                return JoinDatagram.TryDecode(bytes, out JoinDatagram join, out refusal) ? Bytes(join.Encode) : null;
            case DatagramType.Welcome:
                return WelcomeDatagram.TryDecode(bytes, out WelcomeDatagram welcome, out refusal) ? Bytes(welcome.Encode) : null;
            case DatagramType.Refusal:
                return RefusalDatagram.TryDecode(bytes, out RefusalDatagram answer, out refusal) ? Bytes(answer.Encode) : null;
            case DatagramType.Leave:
                return LeaveDatagram.TryDecode(bytes, out LeaveDatagram leave, out refusal) ? Bytes(leave.Encode) : null;
            case DatagramType.DesyncQuery:
                return DesyncQueryDatagram.TryDecode(bytes, out DesyncQueryDatagram query, out refusal) ? Bytes(query.Encode) : null;
            case DatagramType.Seat:
                return SeatDatagram.TryDecode(bytes, out SeatDatagram seat, out refusal) ? Bytes(seat.Encode) : null;
            case DatagramType.Move:
                return MoveDatagram.TryDecode(bytes, out MoveDatagram move, out refusal) ? Bytes(move.Encode) : null;
            case DatagramType.MoveChallenge:
                return MoveChallengeDatagram.TryDecode(bytes, out MoveChallengeDatagram address, out refusal) ? Bytes(address.Encode) : null;
            case DatagramType.Reset:
                return ResetDatagram.TryDecode(bytes, out ResetDatagram reset, out refusal) ? Bytes(reset.Encode) : null;
            case DatagramType.SecureJoin:
                return SecureJoinDatagram.TryDecode(bytes, out SecureJoinDatagram secure, out refusal) ? [.. secure.Prologue, .. secure.Message] : null;
            case DatagramType.SecureWelcome or DatagramType.SecureRefusal:
                return SecureAnswerDatagram.TryDecode(bytes, type, out SecureAnswerDatagram said, out refusal) ? SecureAnswerBytes(type, said.Nonce, said.Message) : null;
            case DatagramType.Sealed:
                return SealedDatagram.TryDecode(bytes, out SealedDatagram closed, out refusal) ? SealedBytes(closed.SessionId, closed.Number, closed.Body, closed.Generation) : null;
            case DatagramType.Roster:
                RosterDatagram roster = new();
                return roster.TryDecode(bytes, out refusal) ? Bytes(roster.Encode) : null;
            case DatagramType.RosterReceived:
                return RosterReceivedDatagram.TryDecode(bytes, out RosterReceivedDatagram received, out refusal) ? Bytes(received.Encode) : null;
            case DatagramType.KeyExchange or DatagramType.KeyExchangeReply:
                return KeyExchangeDatagram.TryDecode(bytes, type, out KeyExchangeDatagram keys, out refusal)
                    ? KeyExchangeBytes(type, keys.SessionId, keys.Generation, keys.Message) : null;
            case DatagramType.DesyncReport:
                return DesyncReportDatagram.TryDecode(bytes, out DesyncReportDatagram report, out refusal) ? Bytes(report.Encode) : null;
            default:
                return scratch.TryDecode(bytes, out refusal) ? Bytes(scratch.Encode) : null;
        }
    }

    /// <summary>Equal, but for the sign that a -0.0 in <paramref name="sent"/> has lost.</summary>
    internal static bool SameButForNegativeZero(ReadOnlySpan<byte> sent, ReadOnlySpan<byte> again)
    {
        bool same = sent.Length == again.Length;
        for (int i = 0; same && i < sent.Length; i++)
        {
            bool lostSign = i >= 7 && sent[i] == 0x80 && again[i] == 0 && again.Slice(i - 7, 8).IndexOfAnyExcept((byte)0) < 0;
            same = sent[i] == again[i] || lostSign;
        }

        return same;
    }
}
