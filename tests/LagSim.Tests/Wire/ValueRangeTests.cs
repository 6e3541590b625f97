using System;
using System.Buffers.Binary;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Wire;

public class ValueRangeTests
{
    // Where things stand in an update with one spawn and no state hash.
    private const int EchoNumberAt = 25;
    private const int FlagsAt = 53;
    private const int FirstIndexAt = 54;
    private const int CountAt = 58;
    private const int VerdictAt = 59;
    private const int KindAt = 60;
    private const int SequenceAt = 62;
    private const int TimeAt = 66;
    private const int RadiusAt = 74;
    private const int MassAt = 82;
    private const int RestitutionAt = 90;
    private const int FlightAt = 98;
    private const int StepAt = 99;
    private const int ForcesAt = 107;
    private const int ToleranceAt = 111;
    private const int FrictionAt = 119;
    private const int RollingAt = 127;
    private const int PositionAt = 135;

    private static readonly BodySpec Ball = new(0.5, 1, 0.8);

    [Fact]
    public void SnapshotRequest_ForChunksShorterThanAnyPathNeeds_IsRefused()
    {
        byte[] bytes = new byte[WireFormat.SnapshotRequestBytes];
        new SnapshotRequestDatagram(1, SnapshotRequestDatagram.MaxShorter, 1, 0, 1).Encode(bytes);
        Assert.True(SnapshotRequestDatagram.TryDecode(bytes, out SnapshotRequestDatagram shortest, out _));
        Assert.Equal(509, shortest.ChunkBytes);
        bytes[12]++;
        Assert.False(SnapshotRequestDatagram.TryDecode(bytes, out _, out WireRefusal refusal));
        Assert.Equal(WireRefusal.BadValue, refusal);
        Assert.Throws<InvalidOperationException>(() => new SnapshotRequestDatagram(1, SnapshotRequestDatagram.MaxShorter + 1, 1, 0, 1).Encode(bytes));
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    [InlineData(double.NegativeInfinity)]
    public void TryDecode_NumberNotFinite_IsRefusedInEveryField(double value)
    {
        for (int field = 0; field < 9; field++)
        {
            AssertBad(PositionAt + (8 * field), BitConverter.DoubleToInt64Bits(value));
        }

        AssertBad(RadiusAt, BitConverter.DoubleToInt64Bits(value));
        AssertBad(MassAt, BitConverter.DoubleToInt64Bits(value));
        AssertBad(RestitutionAt, BitConverter.DoubleToInt64Bits(value));
        AssertBad(ToleranceAt, BitConverter.DoubleToInt64Bits(value));
        AssertBad(FrictionAt, BitConverter.DoubleToInt64Bits(value));
        AssertBad(RollingAt, BitConverter.DoubleToInt64Bits(value));
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.NegativeInfinity)]
    public void ReadDouble_NotFinite_IsRefusedByTheReaderItself(double value)
    {
        byte[] bytes = new byte[8];
        BinaryPrimitives.WriteInt64LittleEndian(bytes, BitConverter.DoubleToInt64Bits(value));
        WireReader reader = new(bytes);

        reader.ReadDouble();

        Assert.Equal(WireRefusal.BadValue, reader.Refusal);
        Assert.Throws<ArgumentException>(() => new WireWriter(new byte[8]).WriteDouble(value));
    }

    [Theory]
    [InlineData(RadiusAt, 0.0)]
    [InlineData(RadiusAt, 0.9e-9)]
    [InlineData(RadiusAt, 1.1e9)]
    [InlineData(MassAt, 0.9e-30)]
    [InlineData(MassAt, 1.1e30)]
    [InlineData(RestitutionAt, -1e-300)]
    [InlineData(RestitutionAt, 1.0000000000000002)]
    public void TryDecode_BodyOutOfRange_IsRefused(int at, double value) => AssertBad(at, BitConverter.DoubleToInt64Bits(value));

    [Theory]
    [InlineData(0L)]
    [InlineData(-1L)]
    [InlineData(1_099_511L)]
    [InlineData((1L << 40) + 1)]
    public void TryDecode_StepOutOfRange_IsRefused(long ticks) => AssertBad(StepAt, ticks);

    [Theory]
    [InlineData(FlagsAt, 8)]
    [InlineData(FlagsAt, 0x80)]
    [InlineData(VerdictAt, 7)]
    [InlineData(KindAt, (byte)EventKind.None)]
    [InlineData(KindAt, (byte)EventKind.Start)]
    [InlineData(KindAt, (byte)EventKind.Command + 1)]
    [InlineData(KindAt, (byte)EventKind.Impact)]
    [InlineData(KindAt, 255)]
    [InlineData(FlightAt, (byte)MotionLaw.Absent)]
    [InlineData(FlightAt, (byte)MotionLaw.Resting)]
    [InlineData(ForcesAt, 1)]
    [InlineData(CountAt, UpdateDatagram.MaxEntries + 1)]
    public void TryDecode_ByteOutOfRange_IsRefused(int at, byte value)
    {
        byte[] bytes = WithOneSpawn();
        bytes[at] = value;
        AssertRefused(bytes);
    }

    [Theory]
    [InlineData(long.MinValue)]
    [InlineData(long.MaxValue)]
    [InlineData(WireFormat.MaxTimeTicks + 1)]
    [InlineData(-WireFormat.MaxTimeTicks - 1)]
    public void TryDecode_EventTimeOutOfRange_IsRefused(long ticks) => AssertBad(TimeAt, ticks);

    [Fact]
    public void TryDecode_HalfAnEcho_IsRefused() => AssertBad(EchoNumberAt, 5);

    [Fact]
    public void TryDecode_SequenceZero_IsRefused()
    {
        byte[] bytes = WithOneSpawn();
        bytes.AsSpan(SequenceAt, 4).Clear();
        AssertRefused(bytes);
    }

    [Fact]
    public void TryDecode_IndicesPastTheLast_IsRefused()
    {
        UpdateDatagram update = new();
        update.TryAdd(Verdict.Accepted, ExternalEvent.Remove(default, 1, 1, default));
        update.TryAdd(Verdict.Accepted, ExternalEvent.Remove(default, 1, 2, default));
        byte[] bytes = AnyDatagram.Bytes(update.Encode);
        BinaryPrimitives.WriteUInt32LittleEndian(bytes.AsSpan(FirstIndexAt), uint.MaxValue);
        AssertRefused(bytes);

        update.FirstIndex = uint.MaxValue;
        Assert.Throws<InvalidOperationException>(() => AnyDatagram.Bytes(update.Encode));
    }

    [Fact]
    public void TryDecode_NegativeZero_BecomesZero()
    {
        byte[] bytes = WithOneSpawn();
        BinaryPrimitives.WriteInt64LittleEndian(bytes.AsSpan(PositionAt), BitConverter.DoubleToInt64Bits(-0.0));
        UpdateDatagram update = new();

        Assert.True(update.TryDecode(bytes, out _));
        Assert.Equal(0L, BitConverter.DoubleToInt64Bits(update.Entries[0].Event.Position.X));
    }

    [Fact]
    public void TryReadType_ForeignBytes_SaysWhatIsWrong()
    {
        AssertHeader(WireRefusal.TooShort, 0x53, 0x4C, 3);
        AssertHeader(WireRefusal.NotLagSim, 0x4C, 0x53, 3, 1);
        AssertHeader(WireRefusal.VersionDiffers, 0x53, 0x4C, 1, 1);
        AssertHeader(WireRefusal.VersionDiffers, 0x53, 0x4C, WireFormat.Version - 1, 1);
        AssertHeader(WireRefusal.UnknownType, 0x53, 0x4C, WireFormat.Version, 0);
        AssertHeader(WireRefusal.UnknownType, 0x53, 0x4C, WireFormat.Version, 24);
        AssertHeader(WireRefusal.None, 0x53, 0x4C, WireFormat.Version, 23);
    }

    [Fact]
    public void TryDecode_AnotherType_IsRefusedAsSuch()
    {
        Assert.False(JoinDatagram.TryDecode(WithOneSpawn(), out _, out WireRefusal refusal));
        Assert.Equal(WireRefusal.OtherType, refusal);
    }

    [Fact]
    public void TryDecode_FixedDatagramsOutOfRange_AreRefused()
    {
        byte[] welcome = AnyDatagram.Bytes(new WelcomeDatagram(1, 2, SimDuration.OneTick, SimDuration.OneTick, 5, 6, 7).Encode);
        foreach ((int at, byte value) in new (int, byte)[] { (20, 0), (20, 2), (27, 0x80), (28, 0), (35, 0x40), (36, 0), (39, 0x7F), (39, 0xFF) })
        {
            byte was = welcome[at];
            welcome[at] = value;
            AssertRefused(welcome);
            welcome[at] = was;
        }

        byte[] request = AnyDatagram.Bytes(new ConnectRequestDatagram(1).Encode);
        request[^1] = 1;
        AssertRefused(request);
        byte[] seat = AnyDatagram.Bytes(new SeatDatagram(1, 2, 3, default).Encode);
        seat[12] = 0;
        AssertRefused(seat);
        byte[] join = AnyDatagram.Bytes(new JoinDatagram(1, default, default, 2, 3).Encode);
        join[^3] = 1; // a proof of no player
        AssertRefused(join);
        foreach (byte role in new byte[] { 0, 4, 255 })
        {
            AssertRefused(AnyDatagram.Bytes(new JoinDatagram(1, default, default, 2, 3, role: role).Encode));
        }

        foreach (string name in new[] { "a\tb", "\u0007", new string('m', RosterEntry.MaxNameBytes + 1) })
        {
            AssertRefused(AnyDatagram.Bytes(new JoinDatagram(1, default, default, 2, 3, name: name).Encode));
            RosterDatagram roster = new() { SessionId = 1, UpTo = 1, Newest = 1 };
            roster.TryAdd(new RosterEntry(1, 1, 1, SimTime.MinValue, name));
            AssertRefused(AnyDatagram.Bytes(roster.Encode));
        }

        foreach ((uint after, uint upTo, uint newest) in new[] { (0u, 0u, 1u), (2u, 1u, 3u), (0u, 2u, 1u) })
        {
            RosterDatagram roster = new() { SessionId = 1, After = after, UpTo = upTo, Newest = newest };
            roster.TryAdd(new RosterEntry(1));
            AssertRefused(AnyDatagram.Bytes(roster.Encode));
        }

        AssertRefused(AnyDatagram.Bytes(new RosterDatagram { SessionId = 1, UpTo = 1, Newest = 1 }.Encode)); // of nobody
        byte[] half = AnyDatagram.Bytes(new SeatDatagram(1, 2, 3, default, SimTime.Zero, 1, 1).Encode);
        half[^1] = 0; // promises for no time
        AssertRefused(half);
        (half[^1], half[^3]) = (1, 0); // an earliest stamp, and no promise
        AssertRefused(half);
        foreach (byte reason in new byte[] { 0, 18, 255 })
        {
            byte[] answer = AnyDatagram.Bytes(new RefusalDatagram(1, RefusalReason.Full).Encode);
            answer[^1] = reason;
            AssertRefused(answer);
        }

        foreach (byte reason in new byte[] { 0, 11, 255 })
        {
            byte[] leave = AnyDatagram.Bytes(new LeaveDatagram(1, 2, LeaveReason.Left).Encode);
            leave[^1] = reason;
            AssertRefused(leave);
        }
    }

    [Fact]
    public void Encode_FieldOutOfRange_Throws()
    {
        Assert.Throws<InvalidOperationException>(() => AnyDatagram.Bytes(default(WelcomeDatagram).Encode));
        Assert.Throws<InvalidOperationException>(() => AnyDatagram.Bytes(default(RefusalDatagram).Encode));
        Assert.Throws<InvalidOperationException>(() => AnyDatagram.Bytes(default(SeatDatagram).Encode));
        Assert.Throws<InvalidOperationException>(() => AnyDatagram.Bytes(new UpdateDatagram { EchoBits = 1 }.Encode));
        Assert.Throws<InvalidOperationException>(() => AnyDatagram.Bytes(default(LeaveDatagram).Encode));
        Assert.Throws<ArgumentException>(() => AnyDatagram.Bytes(new UpdateDatagram { Sent = SimTime.MaxValue }.Encode));
        Assert.Throws<ArgumentException>(() => AnyDatagram.Bytes(new UpdateDatagram { EchoNumber = 1 }.Encode));
        Assert.Throws<ArgumentException>(() => new UpdateDatagram().Encode(new byte[WireFormat.EmptyUpdateBytes - 1]));
    }

    [Fact]
    public void TryAdd_NotWellFormed_Throws()
    {
        UpdateDatagram update = new();
        Assert.Throws<ArgumentException>(() => update.TryAdd(Verdict.Pending, default));
        Assert.Throws<ArgumentException>(() => update.TryAdd(Verdict.Pending, ExternalEvent.Remove(default, 1, 0, default)));
        Assert.Throws<ArgumentException>(() => update.TryAdd(Verdict.Pending, ExternalEvent.Remove(SimTime.MaxValue, 1, 1, default)));
        Assert.Throws<ArgumentException>(
            () => update.TryAdd(Verdict.Pending, ExternalEvent.Impulse(default, 1, 1, default, new Vector3D(0, double.NaN, 0))));
        Assert.Throws<ArgumentException>(() => update.TryAdd(Verdict.Pending, ExternalEvent.Spawn(default, 1, 1, default, default)));
        Assert.Throws<ArgumentException>(() => update.TryAddOwn(Verdict.Accepted, 0));
        Assert.Throws<ArgumentException>(() => update.TryAddOwn((Verdict)7, 1));
        Assert.Throws<ArgumentException>(() => update.TryAdd((Verdict)7, ExternalEvent.Remove(default, 1, 1, default)));
        Assert.Equal(0, update.Entries.Length);
    }

    [Fact]
    public void TryAdd_UntilFull_FitsWithAStateHashAdded()
    {
        UpdateDatagram removals = new(), spawns = new();
        removals.TryAddHash(SimTime.Zero, 1);
        spawns.TryAddHash(SimTime.Zero, 1);
        uint sequence = 1;
        while (removals.TryAdd(Verdict.Pending, ExternalEvent.Remove(default, 1, sequence, default)))
        {
            sequence++;
        }

        while (spawns.TryAdd(Verdict.Pending, ExternalEvent.Spawn(default, 1, sequence, Ball, default)))
        {
            sequence++;
        }

        Assert.Equal(47, removals.Entries.Length);
        Assert.Equal(7, spawns.Entries.Length);
        Assert.Equal(removals.EncodedLength, AnyDatagram.Bytes(removals.Encode).Length);
        Assert.Equal(spawns.EncodedLength, AnyDatagram.Bytes(spawns.Encode).Length);
        Assert.InRange(removals.EncodedLength, 1, WireFormat.MaxPlainBytes);
    }

    private static byte[] WithOneSpawn()
    {
        UpdateDatagram update = new();
        update.TryAdd(Verdict.Pending, ExternalEvent.Spawn(SimTime.Zero, 1, 1, Ball, default));
        return AnyDatagram.Bytes(update.Encode);
    }

    private static void AssertBad(int at, long bits)
    {
        byte[] bytes = WithOneSpawn();
        BinaryPrimitives.WriteInt64LittleEndian(bytes.AsSpan(at), bits);
        AssertRefused(bytes);
    }

    private static void AssertRefused(byte[] bytes)
    {
        Assert.Null(AnyDatagram.Again(bytes, new UpdateDatagram(), out WireRefusal refusal));
        Assert.Equal(WireRefusal.BadValue, refusal);
    }

    private static void AssertHeader(WireRefusal expected, params byte[] bytes)
    {
        WireFormat.TryReadType(bytes, out _, out WireRefusal refusal);
        Assert.Equal(expected, refusal);
    }
}
