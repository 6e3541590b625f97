using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Protection;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Verification.Fuzz;

/// <summary>
/// A source of hostile datagrams: noise, noise behind a valid header, valid datagrams changed, cut, joined or replayed, and valid forms
/// with random values.
/// </summary>
/// <remarks>Deterministic by its seed. Not thread-safe.</remarks>
public sealed class HostileDatagrams
{
    private const int Kept = 512;

    private readonly SeededRandom random;
    private readonly List<(byte[] Datagram, int From, int To)> seen = [];
    private readonly byte[] buffer = new byte[WireFormat.MaxBytes];

    /// <summary>Creates a source.</summary>
    internal HostileDatagrams(SeededRandom random)
    {
        ArgumentNullException.ThrowIfNull(random);
        this.random = random;
    }

    /// <summary>For an unchanged replay, the sender and the receiver of the original; null for any other.</summary>
    public (int From, int To)? Replayed { get; private set; }

    /// <summary>Adds a valid datagram to derive others from.</summary>
    public void Learn(ReadOnlySpan<byte> datagram, int from, int to)
    {
        if (seen.Count < Kept)
        {
            seen.Add((datagram.ToArray(), from, to));
        }
        else
        {
            seen[Below(Kept)] = (datagram.ToArray(), from, to);
        }
    }

    /// <summary>Returns the next datagram.</summary>
    public byte[] Next()
    {
        int kind = seen.Count == 0 ? Below(3) : Below(10);
        Replayed = null;
        return kind switch
        {
            0 => Noise(),
            1 => NoiseBehindAHeader(),
            2 => MadeUp(),
            3 => Cut(),
            4 => Joined(),
            9 => Again(),
            _ => Changed(),
        };
    }

    private int Below(int count) => (int)(random.NextUInt64() % (ulong)count);

    private byte[] Any() => (byte[])seen[Below(seen.Count)].Datagram.Clone();

    private byte[] Again()
    {
        (byte[] datagram, int from, int to) = seen[Below(seen.Count)];
        Replayed = (from, to);
        return datagram;
    }

    private byte[] Noise()
    {
        byte[] bytes = new byte[1 + Below(Below(4) == 0 ? WireFormat.MaxBytes : 100)];
        for (int i = 0; i < bytes.Length; i++)
        {
            bytes[i] = (byte)random.NextUInt64();
        }

        return bytes;
    }

    private byte[] NoiseBehindAHeader()
    {
        byte[] bytes = Noise();
        byte version = Below(8) == 0 ? (byte)Below(256) : WireFormat.Version;
        byte[] head = [WireFormat.Magic & 0xFF, WireFormat.Magic >> 8, version, (byte)Below((int)DatagramType.KeyExchangeReply + 2)];
        head.AsSpan(0, Math.Min(head.Length, bytes.Length)).CopyTo(bytes);
        return bytes;
    }

    private byte[] Cut()
    {
        byte[] bytes = Any();
        int length = 1 + Below(Math.Min(WireFormat.MaxBytes, bytes.Length + 8));
        Array.Resize(ref bytes, length);
        return bytes;
    }

    private byte[] Joined()
    {
        byte[] first = Any(), second = Any();
        int at = Below(Math.Min(first.Length, second.Length));
        second.AsSpan(0, at).CopyTo(first);
        return first;
    }

    private byte[] Changed()
    {
        byte[] bytes = Any();
        for (int changes = 1 + Below(4); changes > 0; changes--)
        {
            int at = Below(3) == 0 ? Below(bytes.Length) : Math.Min(WireFormat.HeaderBytes + Below(80), bytes.Length - 1);
            bytes[at] = Below(3) switch
            {
                0 => (byte)random.NextUInt64(),
                1 => (byte)(bytes[at] ^ (1 << Below(8))),
                _ => (byte)(Below(2) == 0 ? 0xFF : 0x7F + Below(2)),
            };
        }

        return bytes;
    }

    /// <summary>Returns a valid form with random values, sometimes with the session number of a real datagram.</summary>
    private byte[] MadeUp()
    {
        int length = Below(17) switch
        {
            0 => new ConnectRequestDatagram(random.NextUInt64()).Encode(buffer),
            1 => new ChallengeDatagram(random.NextUInt64(), Token()).Encode(buffer),
            2 => Join().Encode(buffer),
            3 => new SnapshotRequestDatagram(Session(), (byte)Below(SnapshotRequestDatagram.MaxShorter + 1), (uint)Below(100), (uint)Below(100_000), random.NextUInt64()).Encode(buffer),
            4 => new LeaveDatagram(random.NextUInt64(), (byte)Below(10), (LeaveReason)(1 + Below((int)LeaveReason.KeysTooOld)), "The world ended.").Encode(buffer),
            5 => new WelcomeDatagram(
                random.NextUInt64(), Session(), SimDuration.FromSeconds(1), SimDuration.FromSeconds(1 + Below(3)), 1 + Below(SessionSnapshot.MaxBytes), random.NextUInt64(), (uint)Below(9)).Encode(buffer),
            6 => new DesyncQueryDatagram(
                Session(), (byte)Below(10), (uint)Below(100), SimTime.FromSeconds(Below(20)), SimTime.FromSeconds(20 + Below(20)), (uint)Below(70)).Encode(buffer),
            7 => DesyncReport().Encode(buffer),
            8 => Seat().Encode(buffer),
            9 => new MoveDatagram(Session(), (byte)Below(10), Token()).Encode(buffer),
            10 => new MoveChallengeDatagram(Session(), Token()).Encode(buffer),
            11 => new ResetDatagram(Session(), (LeaveReason)(1 + Below((int)LeaveReason.KeysTooOld)), Token()).Encode(buffer),
            12 => Sealed(),
            13 => Roster().Encode(buffer),
            14 => new RosterReceivedDatagram(Session(), (byte)Below(10), (uint)Below(20)).Encode(buffer),
            15 => KeyExchange(),
            _ => Update().Encode(buffer),
        };
        return buffer.AsSpan(0, length).ToArray();
    }

    /// <summary>An offer or an answer of fresh keys, in clear text, with a key of nobody's.</summary>
    private int KeyExchange()
    {
        Span<byte> message = stackalloc byte[IDatagramCipher.ExchangeBytes];
        for (int n = 0; n < message.Length; n++)
        {
            message[n] = (byte)random.NextUInt64();
        }

        DatagramType type = Below(2) == 0 ? DatagramType.KeyExchange : DatagramType.KeyExchangeReply;
        return new KeyExchangeDatagram(Session(), (uint)Below(3), message).Encode(type, buffer);
    }

    /// <summary>A sealed datagram's form, with a number near those of real ones, and nothing that was sealed.</summary>
    private int Sealed()
    {
        WireWriter writer = new(buffer);
        writer.WriteHeader(DatagramType.Sealed);
        writer.WriteUInt64(Session());
        writer.WriteUInt32((uint)Below(2_000));
        writer.WriteByte((byte)(Below(10) / 9));
        writer.WriteByte((byte)(Below(10) / 8));
        for (int n = 17 + Below(100); n > 0; n--)
        {
            writer.WriteByte((byte)random.NextUInt64());
        }

        return writer.Position;
    }

    private JoinDatagram Join()
    {
        byte player = (byte)Below(10);
        return new JoinDatagram(
            random.NextUInt64(), Token(), Token(), random.NextUInt64(), (uint)(Simulation.FoldVersion + Below(2)), player, player == 0 ? default : Token(),
            (byte)(1 + Below(3)), Below(2) == 0 ? "" : "made up");
    }

    private SeatDatagram Seat() => Below(2) == 0
        ? new SeatDatagram(Session(), (byte)(1 + Below(60)), (uint)Below(9), Token())
        : new SeatDatagram(Session(), (byte)(1 + Below(60)), (uint)Below(9), Token(), SimTime.FromSeconds(Below(40)),
            (ushort)(1 + Below(99)), (byte)(1 + Below(SeatDatagram.Always)));

    private RosterDatagram Roster()
    {
        uint after = (uint)Below(3);
        RosterDatagram roster = new() { SessionId = Session(), After = after, UpTo = after + 1 + (uint)Below(9), Newest = after + 10 };
        for (int n = 1 + Below(40); n > 0; n--)
        {
            roster.TryAdd(new RosterEntry(
                (byte)Below(60), (byte)Below(4), (uint)Below(9),
                Below(2) == 0 ? SimTime.MinValue : SimTime.FromSeconds(Below(40)), "made up"));
        }

        return roster;
    }

    private DesyncReportDatagram DesyncReport() => Below(4) == 0
        ? new DesyncReportDatagram(Session(), Below(2) == 0)
        : new DesyncReportDatagram(Session(), 2000, (uint)Below(2000), 1 + (uint)Below(100), ExternalEvent.Remove(
            SimTime.FromSeconds(Below(40)), (byte)Below(10), 1 + (uint)Below(100), BodyId.OfScene(Below(10))));

    private Token128 Token()
    {
        Span<byte> bytes = stackalloc byte[Token128.Bytes];
        for (int i = 0; i < bytes.Length; i++)
        {
            bytes[i] = (byte)random.NextUInt64();
        }

        return new Token128(bytes);
    }

    private ulong Session()
    {
        if (seen.Count > 0 && Below(2) == 0)
        {
            byte[] one = seen[Below(seen.Count)].Datagram;
            if (one.Length >= WireFormat.EmptyUpdateBytes && (DatagramType)one[3] is DatagramType.Update or DatagramType.Sealed)
            {
                return BitConverter.ToUInt64(one, WireFormat.HeaderBytes);
            }
        }

        return random.NextUInt64();
    }

    private UpdateDatagram Update()
    {
        UpdateDatagram update = new()
        {
            SessionId = Session(),
            Peer = (byte)Below(10),
            Number = (uint)random.NextUInt64(),
            Sent = Time(),
            EchoNumber = 1 + (uint)Below(200),
            EchoBits = (uint)random.NextUInt64(),
            EchoReceived = Time(),
            EventsReceived = (uint)Below(2) * (uint)random.NextUInt64(),
            FirstIndex = (uint)Below(100),
            Ready = Below(2) == 0,
            Start = Below(2) == 0 ? SimTime.MinValue : Time(),
            Watermark = Below(2) == 0 ? SimTime.MinValue : Time(),
        };
        for (uint n = (uint)Below(30); n > 0; n--)
        {
            BodyId body = Below(2) == 0 ? BodyId.OfScene(Below(8)) : BodyId.FromPacked(random.NextUInt64());
            _ = Below(7) switch
            {
                4 => update.TryAdd((Verdict)Below(6), ExternalEvent.Grab(Time(), (byte)Below(10), n, body, Vector())),
                5 => update.TryAdd((Verdict)Below(6), ExternalEvent.HoldKeyframe(Time(), (byte)Below(10), n, body, Vector(), Vector())),
                6 => update.TryAdd((Verdict)Below(6), ExternalEvent.Release(Time(), (byte)Below(10), n, body, Vector())),
                0 => update.TryAddOwn((Verdict)Below(6), n),
                1 => update.TryAdd((Verdict)Below(6), ExternalEvent.Remove(Time(), (byte)Below(10), n, body)),
                2 => update.TryAdd((Verdict)Below(6), ExternalEvent.Impulse(Time(), (byte)Below(10), n, body, Vector())),
                _ => update.TryAdd((Verdict)Below(6), ExternalEvent.Teleport(Time(), (byte)Below(10), n, body, Vector(), Vector())),
            };
        }

        return update;
    }

    private SimTime Time() => SimTime.FromTicks(((long)random.NextUInt64() >> 2) >> Below(40));

    private Vector3D Vector() => new(random.NextGaussian(), random.NextGaussian() * (Below(20) == 0 ? 1e300 : 1), random.NextGaussian());
}
