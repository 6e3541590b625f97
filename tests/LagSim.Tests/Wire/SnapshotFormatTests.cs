using System;
using System.Linq;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;
using static LagSim.Tests.Wire.SnapshotBits;

namespace LagSim.Tests.Wire;

/// <summary>A snapshot comes back to the last bit, and bytes that anyone may have sent are a snapshot or a refusal.</summary>
public sealed class SnapshotFormatTests
{
    private const int Trials = 40_000;

    private static readonly Gen<SimTime> Ticks = WireGen.Bits64.Select(bits => SimTime.FromTicks((long)bits));

    private static readonly Gen<BodySnapshot> Body =
        from id in WireGen.Bits64
        from spec in WireGen.Spec
        from at in Ticks
        from round in WireGen.Bits32
        from kind in WireGen.Byte
        from bodies in Gen.ArrayOf(WireGen.Bits64, 2)
        from peer in WireGen.Byte
        from sequence in WireGen.Bits32
        from law in Gen.Elements(
            MotionLaw.Ballistic, MotionLaw.RungeKutta4, MotionLaw.ClosedForm, MotionLaw.DormandPrince54, MotionLaw.Sliding,
            MotionLaw.Rolling, MotionLaw.Resting, MotionLaw.Held, MotionLaw.Constrained)
        from times in Gen.ArrayOf(Ticks, 6)
        from vectors in Gen.ArrayOf(WireGen.ExactVector, 7)
        from spins in Gen.OneOf(
            Gen.Constant<Vector3D[]>([default, default]),
            Gen.ArrayOf(WireGen.ExactVector, 2).Where(v => v[0] != default || v[1] != default))
        from filter in WireGen.Filter
        from players in Gen.Elements(PeerSet.Everyone, PeerSet.Of(3, 7), PeerSet.Nobody)
        from contacts in Gen.Choose(0, 4).SelectMany(count => Gen.ArrayOf(WireGen.Contact, count))
        from strength in Gen.Elements((0.0, 0.0), (100.0, 0.0), (0.0, 3e-5), (double.MaxValue, double.Epsilon))
        from busy in Gen.OneOf(Gen.Constant(default(SimTime)), Ticks)
        from supports in Gen.Choose(0, 3).SelectMany(count => Gen.ArrayOf(Gen.OneOf(Gen.Constant(int.MaxValue), Gen.Choose(0, 1000)), count))
        select new BodySnapshot(
            BodyId.FromPacked(id), spec, new EventKey(at, round, (EventKind)kind, BodyId.FromPacked(bodies[0]), BodyId.FromPacked(bodies[1]), peer, sequence),
            law, times[0], times[1], vectors[0], vectors[1], vectors[2], supports,
            IsDense(law) || law == MotionLaw.Held ? vectors[3] : default, IsDense(law) ? vectors[4] : default,
            IsDense(law) ? vectors[5] : default,
            law == MotionLaw.Held ? new Hold(peer, vectors[6], times[2], strength.Item1, strength.Item2, busy) : default,
            law == MotionLaw.DormandPrince54 ? SimDuration.FromTicks(times[3].Ticks) : default, spins[0], spins[1],
            IsMember(law, supports) ? times[4] : default, IsMember(law, supports) ? times[5] : default,
            IsMember(law, supports) ? contacts : [], filter, players: players);

    private static readonly Gen<WorldSnapshot> Any =
        from start in Ticks
        from time in Ticks
        from hash in WireGen.Bits64
        from count in Gen.Choose(0, 6)
        from bodies in Gen.ArrayOf(Body, count)
        select new WorldSnapshot(start, time, hash, bodies);

    [Fact]
    public void Encode_AnySnapshot_DecodesToTheSameToTheBit() => Prop.ForAll(
        Any.ToArbitrary(), snapshot => Same(snapshot, Decoded(SnapshotFormat.Encode(snapshot)))).Check(WireGen.Config.WithMaxTest(2000));

    [Fact]
    public void Encode_RandomWorlds_DecodeToWorldsThatGoOnAlikeToTheBit()
    {
        int negativeZeros = 0, dense = 0, carried = 0, held = 0, inContact = 0;
        for (int seed = 1; seed <= 150; seed++)
        {
            RandomWorld world = new(seed, hands: true);
            Simulation expected = world.OnTime();
            WorldSnapshot snapshot = expected.Snapshot(At(0.1 + (seed * 0.007)));
            WorldSnapshot again = Decoded(SnapshotFormat.Encode(snapshot));
            WorldSnapshot negative = new(snapshot.Start, snapshot.Time, snapshot.EventHash, snapshot.Bodies.Select(WithNegativeZeros).ToArray());
            Assert.True(Same(snapshot, again), $"seed {seed}");
            Assert.True(Same(negative, Decoded(SnapshotFormat.Encode(negative))), $"seed {seed}, with every zero negative");
            Simulation actual = new(world.Scene, again, KeepAll);
            foreach (ExternalEvent external in world.Events.Where(e => e.Time >= snapshot.Time))
            {
                actual.Submit(external);
            }

            actual.AdvanceTo(At(RandomWorld.End));
            Assert.Equal(expected.StateHash(At(RandomWorld.End)), actual.StateHash(At(RandomWorld.End)));
            Assert.Equal(expected.EventHash(At(RandomWorld.End)), actual.EventHash(At(RandomWorld.End)));
            negativeZeros += negative.Bodies.SelectMany(Numbers).Count(value => value == 0 && double.IsNegative(value));
            dense += snapshot.Bodies.Count(b => b.Law == MotionLaw.RungeKutta4);
            carried += snapshot.Bodies.Count(b => b.SupportCount > 0);
            held += snapshot.Bodies.Count(b => b.Law == MotionLaw.Held);
            inContact += snapshot.Bodies.Count(b => b.Contacts.Length > 0);
        }

        Assert.True(
            negativeZeros > 10 && dense > 50 && carried > 10 && held > 20 && inContact > 10, // else nothing was shown
            $"{negativeZeros} {dense} {carried} {held} {inContact}");
    }

    [Fact]
    public void Decode_OneBitOfAnyByteChanged_IsRefusedOrSeenAsAnother()
    {
        // The control of the tests above: no byte of a snapshot is without a meaning.
        foreach (byte[] bytes in Valid(20))
        {
            WorldSnapshot was = Decoded(bytes);
            for (int at = 0; at < bytes.Length; at++)
            {
                byte[] other = (byte[])bytes.Clone();
                other[at] ^= 1;
                Assert.True(!SnapshotFormat.TryDecode(other, out WorldSnapshot? again, out _) || !Same(was, again), $"byte {at} of {Convert.ToHexString(bytes)}");
            }
        }
    }

    [Fact]
    public void TryDecode_EveryTruncationAndEveryTrailingByte_IsRefused()
    {
        foreach (byte[] bytes in Valid(20))
        {
            for (int length = 0; length < bytes.Length; length++)
            {
                Refused(WireRefusal.TooShort, bytes.AsSpan(0, length));
            }

            Refused(WireRefusal.TrailingBytes, [.. bytes, 0]);
        }
    }

    [Fact]
    public void TryDecode_MutatedSnapshots_NeverThrowsAndWhatIsAcceptedHasOneForm() => Mutation.DecodeMany(Valid(60), Trials, 7, OneForm);

    [Fact]
    public void TryDecode_RandomBytes_NeverThrows()
    {
        Random random = new(8);
        byte[] buffer = new byte[2000];
        for (int i = 0; i < Trials; i++)
        {
            Span<byte> bytes = buffer.AsSpan(0, random.Next(buffer.Length));
            random.NextBytes(bytes);
            if (i % 4 > 0 && bytes.Length > 32)
            {
                bytes[24..28].Clear(); // no state of rules
                bytes[28] = (byte)(bytes.Length / 210); // a count that could be, or it tests nothing else
                bytes[29..32].Clear();
            }

            OneForm(bytes);
        }
    }

    [Fact]
    public void MakeWorld_OfMutatedSnapshots_GivesAWorldOrASentence()
    {
        // What the decoder lets through, the door of the simulation judges; neither ends in anything but a sentence.
        Random random = new(9);
        RandomWorld[] worlds = [.. Enumerable.Range(1, 20).Select(seed => new RandomWorld(seed, hands: true))];
        byte[][] valid = [.. worlds.Select(world => SnapshotFormat.Encode(world.OnTime().Snapshot(At(0.6))))];
        int made = 0, refused = 0;
        for (int i = 0; i < 3000; i++)
        {
            int which = random.Next(valid.Length);
            byte[] bytes = (byte[])valid[which].Clone();
            bytes[random.Next(bytes.Length)] ^= (byte)(1 << random.Next(8));
            if (!SnapshotFormat.TryDecode(bytes, out WorldSnapshot? snapshot, out _))
            {
                continue;
            }

            try
            {
                _ = new Simulation(worlds[which].Scene, snapshot, new SimulationOptions(maxSegments: 10_000));
                made++;
            }
            catch (Exception failure) when (failure is SceneException or SimulationException)
            {
                refused++;
            }
        }

        Assert.True(made > 100 && refused > 100, $"{made} made, {refused} refused");
    }

    [Fact]
    public void TryDecode_WhatAnnouncesMuch_AllocatesByWhatIsThere()
    {
        byte[] one = SnapshotFormat.Encode(new WorldSnapshot(At(0), At(1), 7, [Decoded(Valid(1)[0]).Bodies[0]]));
        foreach (uint count in new[] { 2u, 1000u, 400_000u, uint.MaxValue })
        {
            BitConverter.GetBytes(count).CopyTo(one, 24);
            Refused(WireRefusal.TooShort, one);
            Assert.InRange(Allocated(one), 0, 2000);
        }

        // The control: what is really there does take room, and no more than a few times its length.
        byte[] many = SnapshotFormat.Encode(new WorldSnapshot(At(0), At(1), 7, Enumerable.Repeat(Plain(), 5000).ToArray()));
        Assert.InRange(Allocated(many), many.Length, 6L * many.Length);
        many[32 + 8] = many[32 + 9] = many[32 + 15] = 0xFF; // no radius: refused, and as cheap
        many[32 + 14] = 0xFF;
        Refused(WireRefusal.BadValue, many);
        Assert.InRange(Allocated(many), 0, 6L * many.Length);
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    public void TryDecode_NumberNotFinite_IsRefusedInEveryField(double value)
    {
        byte[] good = SnapshotFormat.Encode(new WorldSnapshot(At(0), At(1), 7, [Plain(MotionLaw.RungeKutta4)]));
        int[] nine = [.. Enumerable.Range(0, 9).Select(n => 32 + (8 * n))];
        int[] numbers = [32 + 8, 32 + 16, 32 + 24, .. nine.Select(n => n + 136), .. nine.Select(n => n + 209)];
        foreach (int at in numbers)
        {
            byte[] bytes = (byte[])good.Clone();
            BitConverter.GetBytes(value).CopyTo(bytes, at);
            Refused(WireRefusal.BadValue, bytes);
            BitConverter.GetBytes(0.5).CopyTo(bytes, at); // the control: it is a number that stands there
            Decoded(bytes);
        }
    }

    [Fact]
    public void TryDecode_FieldOutOfRange_IsRefused()
    {
        byte[] good = SnapshotFormat.Encode(new WorldSnapshot(At(0), At(1), 7, [Plain()]));
        byte[] step = (byte[])good.Clone();
        step.AsSpan(32 + 8 + 25, 8).Clear();
        Refused(WireRefusal.BadValue, step);
        byte[] supports = (byte[])good.Clone();
        supports[32 + 208] = BodySnapshot.MaxSupports + 1;
        Refused(WireRefusal.BadValue, [.. supports, .. new byte[16]]);
        supports[32 + 208] = 1;
        Refused(WireRefusal.BadValue, [.. supports[..^1], 0, 0, 0, 0x80, 0]);
        Decoded([.. supports[..^1], 0xFF, 0xFF, 0xFF, 0x7F, 0]);
        byte[] turns = (byte[])good.Clone();
        turns[^1] = 16;
        Refused(WireRefusal.BadValue, turns);
        turns[^1] = 4;
        Refused(WireRefusal.BadValue, [.. turns, 0xFF, 0xFF, 1, 0]); // everyone has no players
        Refused(WireRefusal.BadValue, [.. turns, 0xFF, 0xFF, 3, 0]); // nor is there a peer 17
        Assert.Equal(PeerSet.Of(1), Decoded([.. turns, 2, 0, 0, 0]).Bodies[0].Players);
        turns[^1] = 2;
        Refused(WireRefusal.BadValue, [.. turns, 1, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF]); // nor has the filter of its spec
        Assert.Equal(new CollisionFilter(2), Decoded([.. turns, 2, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF]).Bodies[0].Filter);
        turns[^1] = 8;
        Refused(WireRefusal.BadValue, [.. turns, .. new byte[4]]); // of no sensor has another form
        Decoded([.. turns, 1, 0, 0xFF, 3, 0, 0]);
        Refused(WireRefusal.BadValue, [.. turns, 1, 0, 0, 4, 0, 0]);
        byte[] crossing = [.. turns, 0, 0, 1, 0, .. new byte[12], 0xFF, 3, 1];
        Decoded(crossing);
        Refused(WireRefusal.TooShort, crossing[..^1]);
        crossing[^1] = 2;
        Refused(WireRefusal.BadValue, crossing);
        turns[^1] = 1;
        Refused(WireRefusal.BadValue, [.. turns, .. new byte[48]]); // turning not at all has another form
        Decoded([.. turns, 1, .. new byte[47]]);
    }

    [Fact]
    public void Encode_WhatCannotTravel_IsRefused()
    {
        Assert.Throws<ArgumentNullException>(() => SnapshotFormat.Encode(null!));
        BodySnapshot b = Plain();
        Refuse(new BodySnapshot(b.Id, b.Spec, b.Opened, b.Law, b.Epoch, b.End, V(double.NaN), b.Velocity, b.Acceleration), "finite");
        Refuse(new BodySnapshot(b.Id, Ball(double.NaN), b.Opened, b.Law, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration), "finite");
        Refuse(new BodySnapshot(b.Id, b.Spec, b.Opened, b.Law, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, [-1]), "plane -1");

        static void Refuse(BodySnapshot body, string word) => Assert.Contains(
            word, Assert.Throws<ArgumentException>(() => SnapshotFormat.Encode(new WorldSnapshot(At(0), At(1), 0, [body]))).Message, StringComparison.Ordinal);
    }

    private static BodySnapshot Plain(MotionLaw law = MotionLaw.Ballistic) => new(
        First, Ball(), new EventKey(At(0.5), 0, EventKind.Impact, First, First, 0, 0), law, At(0.5), SimTime.MaxValue, V(1, 2, 3), V(4), V(0, -9.81));

    private static BodySnapshot WithNegativeZeros(BodySnapshot b)
    {
        return new BodySnapshot(
            b.Id, b.Spec, b.Opened, b.Law, b.Epoch, b.End, Negative(b.Position), Negative(b.Velocity), Negative(b.Acceleration),
            Enumerable.Range(0, b.SupportCount).Select(b.Support).ToArray(), b.Cubic, b.Quartic, b.Quintic, b.Law == MotionLaw.Held ? new Hold(b.Hold.Peer, Negative(b.Hold.Offset), b.Hold.KeyframeTime, b.Hold.MaxForce, b.Hold.MaxPower, b.Hold.BusyUntil) : default, b.NextStep, b.Spin, b.SpinRate,
            b.Centre, b.StillSince,
            [.. b.Contacts.ToArray().Select(c => new PersistentContact(c.Partner, c.Surface, c.Holds, Negative(c.Push), Negative(c.Turn)))], b.Filter, players: b.Players);

        static Vector3D Negative(Vector3D v) => new(v.X == 0 ? -0.0 : v.X, v.Y == 0 ? -0.0 : v.Y, v.Z == 0 ? -0.0 : v.Z);
    }

    private static bool IsDense(MotionLaw law) => law is MotionLaw.RungeKutta4 or MotionLaw.ClosedForm or MotionLaw.DormandPrince54;

    private static bool IsMember(MotionLaw law, int[] supports) =>
        law == MotionLaw.Constrained || (law == MotionLaw.Resting && supports.Length == 0);

    private static byte[][] Valid(int count) =>
    [
        .. Gen.Sample(Any, count, new Rnd(20261121, 1), 30).Where(s => s.Bodies.Count > 0).Select(SnapshotFormat.Encode),
        .. Enumerable.Range(1, count / 4).Select(seed => new RandomWorld(seed, hands: true).OnTime().Snapshot(At(0.6))).Select(SnapshotFormat.Encode),
    ];

    private static bool OneForm(ReadOnlySpan<byte> bytes)
    {
        bool isAccepted = SnapshotFormat.TryDecode(bytes, out WorldSnapshot? snapshot, out WireRefusal refusal);
        Assert.Equal(isAccepted, refusal == WireRefusal.None);
        Assert.Equal(isAccepted, snapshot is not null);
        if (isAccepted)
        {
            byte[] again = SnapshotFormat.Encode(snapshot!);
            Assert.True(AnyDatagram.SameButForNegativeZero(bytes, again), Convert.ToHexString(bytes)); // of a spec only
            Assert.True(Same(snapshot!, Decoded(again)));
        }

        return isAccepted;
    }
}
