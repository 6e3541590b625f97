using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using LagSim.Net.Carriers;

namespace LagSim.Tests.Protection;

/// <summary>
/// Somebody on the path between a host and its clients, who reads, drops and makes up datagrams in anyone's name. It knows docs/WIRE.md
/// and no code: offsets and numbers below are those of the page.
/// </summary>
internal sealed class PathAttacker
{
    internal const int SessionAt = 4;
    internal const int PeerAt = 12;
    internal const int NumberAt = 13;
    internal const int WatermarkAt = 41;
    internal const int EventsReceivedAt = 49;
    internal const int FlagsAt = 53;
    internal const byte Update = 4;
    internal const byte Leave = 5;
    internal const byte Join = 7;
    internal const byte SecureJoin = 15;
    internal const byte SecureWelcome = 16;
    internal const byte Sealed = 19;

    private const byte Version = 14;

    private readonly Dictionary<int, PathPort> ports = [];

    /// <summary>All datagrams so far: the number in the network of the peer that sent it, and the bytes.</summary>
    internal List<(int From, byte[] Bytes)> Heard { get; } = [];

    /// <summary>What to do with a datagram on its way; true to drop it. By default nothing is dropped.</summary>
    internal Func<int, byte[], bool> Drops { get; set; } = (_, _) => false;

    /// <summary>Stands before a peer's port.</summary>
    internal IDatagramPort Wrap(int node, IDatagramPort port) => ports[node] = new PathPort(this, node, port);

    /// <summary>Has a peer receive a datagram as if another had sent it.</summary>
    internal void Send(int from, int to, byte[] bytes) => Send(PeerAddress.Virtual(from), to, bytes);

    internal void Send(PeerAddress from, int to, byte[] bytes) => ports[to].Give(from, bytes);

    /// <summary>The last datagram of a kind from a peer.</summary>
    internal byte[] Last(int from, byte kind) => [.. Heard.FindLast(h => h.From == from && h.Bytes[3] == kind).Bytes];

    internal bool HasHeard(int from, byte kind) => Heard.Exists(h => h.From == from && h.Bytes[3] == kind);

    /// <summary>Header of a datagram.</summary>
    internal static byte[] Head(byte kind, int length)
    {
        byte[] bytes = new byte[length];
        (bytes[0], bytes[1], bytes[2], bytes[3]) = (0x53, 0x4C, Version, kind);
        return bytes;
    }

    /// <summary>A Leave.</summary>
    internal static byte[] Gone(ulong session, byte peer, byte reason)
    {
        byte[] bytes = Head(Leave, 14);
        BinaryPrimitives.WriteUInt64LittleEndian(bytes.AsSpan(SessionAt), session);
        (bytes[PeerAt], bytes[13]) = (peer, reason);
        return bytes;
    }

    /// <summary>An Update without anything but its sender's number, of the session of a datagram that was heard, in clear text.</summary>
    internal static byte[] Empty(byte[] heard, byte peer, uint number)
    {
        byte[] bytes = Head(Update, 59);
        heard.AsSpan(SessionAt, 8).CopyTo(bytes.AsSpan(SessionAt));
        bytes[PeerAt] = peer;
        BinaryPrimitives.WriteInt64LittleEndian(bytes.AsSpan(33), long.MinValue); // no echo
        BinaryPrimitives.WriteInt64LittleEndian(bytes.AsSpan(WatermarkAt), long.MinValue);
        BinaryPrimitives.WriteUInt32LittleEndian(bytes.AsSpan(NumberAt), number);
        BinaryPrimitives.WriteUInt32LittleEndian(bytes.AsSpan(FlagsAt + 1), 1); // first index
        return bytes;
    }

    /// <summary>An Update with a teleport of the scene's first body, in the name of a client of which one was heard.</summary>
    internal static byte[] Teleport(byte[] heard, byte peer, uint number, uint sequence, long time, double height)
    {
        byte[] bytes = new byte[59 + 1 + 70];
        Empty(heard, peer, number).CopyTo(bytes, 0);
        BinaryPrimitives.WriteUInt32LittleEndian(bytes.AsSpan(54), sequence);
        bytes[58] = 1; // one entry, its verdict 0, pending
        (bytes[60], bytes[61]) = (9, peer);
        BinaryPrimitives.WriteUInt32LittleEndian(bytes.AsSpan(62), sequence);
        BinaryPrimitives.WriteInt64LittleEndian(bytes.AsSpan(66), time);
        BinaryPrimitives.WriteDoubleLittleEndian(bytes.AsSpan(82 + 8), height); // body 0, then x, y, z
        return bytes;
    }

    internal static uint U32(byte[] bytes, int at) => BinaryPrimitives.ReadUInt32LittleEndian(bytes.AsSpan(at));

    internal static ulong U64(byte[] bytes, int at) => BinaryPrimitives.ReadUInt64LittleEndian(bytes.AsSpan(at));

    internal static long I64(byte[] bytes, int at) => BinaryPrimitives.ReadInt64LittleEndian(bytes.AsSpan(at));

    private sealed class PathPort(PathAttacker attacker, int node, IDatagramPort port) : IDatagramPort
    {
        private readonly Queue<(PeerAddress From, byte[] Bytes)> given = [];
        private Action? arrived;

        public PeerAddress LocalAddress => port.LocalAddress;

        public event Action? Arrived
        {
            add
            {
                arrived += value;
                port.Arrived += value;
            }

            remove
            {
                arrived -= value;
                port.Arrived -= value;
            }
        }

        public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
        {
            byte[] bytes = datagram.ToArray();
            attacker.Heard.Add((node, bytes));
            if (!attacker.Drops(node, bytes))
            {
                port.Send(bytes, to);
            }
        }

        public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
        {
            if (!given.TryDequeue(out (PeerAddress From, byte[] Bytes) one))
            {
                return port.TryReceive(buffer, out length, out from);
            }

            one.Bytes.CopyTo(buffer);
            (length, from) = (one.Bytes.Length, one.From);
            return true;
        }

        public void Dispose() => port.Dispose();

        internal void Give(PeerAddress from, byte[] bytes)
        {
            given.Enqueue((from, bytes));
            arrived?.Invoke();
        }
    }
}
