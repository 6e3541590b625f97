using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.Linq;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Tests.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Wire;

public sealed class SceneFormatTests
{
    private const int Trials = 40_000;

    // Where things stand in the scene that One gives: name "s", one plane "p", one static sphere "q", one body "b".
    private const int GravityAt = 3;
    private const int RestitutionThresholdAt = 27;
    private const int ToleranceOfContactAt = 35;
    private const int SmallestAt = 43;
    private const int SpawnersAt = 51;
    private const int ForcesAt = 55;
    private const int PlanesAt = 56;
    private const int PlaneNameAt = 58;
    private const int NormalAt = 60;
    private const int SpheresAt = 116;
    private const int BodiesAt = 176;
    private const int BodyNameAt = 179;
    private const int RestitutionAt = 196;
    private const int FlightAt = 204;
    private const int StepAt = 205;
    private const int SpecForcesAt = 213;
    private const int ToleranceAt = 217;
    private const int PositionAt = 257;
    private const int VelocityAt = 281;
    private const int PlayersAt = 305;
    private const int SensorsAt = 333;
    private const int Length = 344;

    [Fact]
    public void Encode_AnyScene_DecodesToTheSameWorldInTheSameBytes() => Prop.ForAll(
        SceneGen.Any.ToArbitrary(), scene => IsSame(scene, Decoded(SceneFormat.Encode(scene)))).Check(WireGen.Config.WithMaxTest(2000));

    [Fact]
    public void Encode_WorldsWithASuppliedForce_DecodeToTheSameAndUseIt()
    {
        for (int seed = 1; seed <= 100; seed++)
        {
            Scene scene = new RandomWorld(seed).Scene;
            Scene again = Decoded(SceneFormat.Encode(scene), scene.Accelerations);
            Assert.True(IsSame(scene, again), $"seed {seed}");
            Assert.Same(scene.Accelerations[0], again.Accelerations[0]);
            Assert.Equal(Run(scene, 0.5).StateHash(At(0.5)), Run(again, 0.5).StateHash(At(0.5)));
        }
    }

    [Fact]
    public void Decode_OneBitOfOneNumberChanged_IsSeenAsAnotherWorld()
    {
        // The control of the tests above: they would see it.
        byte[] bytes = SceneFormat.Encode(One());
        int[] places =
        [
            GravityAt, RestitutionThresholdAt, ToleranceOfContactAt, SpawnersAt, SpawnersAt + 1, RestitutionAt, StepAt, PositionAt, VelocityAt, PlayersAt, NormalAt + 48, NormalAt + 52, SpheresAt + 52, PositionAt - 16, PositionAt - 12, PositionAt - 8,
            PlayersAt + 1,
        ];
        foreach (int at in places)
        {
            byte[] other = (byte[])bytes.Clone();
            other[at] ^= 1;
            Scene again = Decoded(other);
            Assert.False(IsSame(One(), again), $"byte {at}");
            Assert.Equal(other, SceneFormat.Encode(again));
        }
    }

    [Fact]
    public void Encode_NegativeZeros_AreWrittenAsZero()
    {
        Scene scene = new SceneBuilder("s").AddStaticSphere("q", V(-0.0, 5, 0), 1, -0.0).AddBody("b", Ball(e: -0.0), V(0)).Build();
        byte[] bytes = SceneFormat.Encode(scene);
        Assert.True(IsSame(scene, Decoded(bytes)));

        byte[] other = (byte[])SceneFormat.Encode(One()).Clone();
        other[VelocityAt + 23] = 0x80;
        Assert.Equal(SceneFormat.Encode(One()), SceneFormat.Encode(Decoded(other)));
    }

    [Fact]
    public void Encode_Rights_AreTheBitsOfThePeersThatHaveThem()
    {
        Assert.Equal([0xFF, 0xFF, 0x01, 0x00], SceneFormat.Encode(One())[PlayersAt..(PlayersAt + 4)]);
        Scene scene = new SceneBuilder("s").WithSpawners(PeerSet.Of(1, 9)).AddBody("b", Ball(), V(0), players: PeerSet.Nobody)
            .AddBody("c", Ball(), V(3), players: PeerSet.Of(0, 16)).Build();
        byte[] bytes = SceneFormat.Encode(scene);
        Scene again = Decoded(bytes);

        Assert.Equal([0x02, 0x02, 0x00, 0x00], bytes[SpawnersAt..ForcesAt]);
        Assert.Equal([0x01, 0x00, 0x01, 0x00], bytes[^39..^35]); // its spin, the count of sensors, the seed and whether there are rules follow
        Assert.Equal(PeerSet.Of(1, 9), again.Spawners);
        Assert.Equal([PeerSet.Nobody, PeerSet.Of(0, 16)], again.Bodies.Select(b => b.Players));
    }

    [Fact]
    public void TryDecode_EveryTruncationAndEveryTrailingByte_IsRefusedWithASentence()
    {
        byte[] whole = SceneFormat.Encode(One());
        Assert.Equal(Length, whole.Length);
        for (int length = 0; length < whole.Length; length++)
        {
            Refused(whole.AsSpan(0, length), "");
        }

        Refused(whole.AsSpan(0, 0), "The 0 bytes of the scene end within the scene's head.");
        Refused(whole.AsSpan(0, PlanesAt), "The 56 bytes of the scene end within the scene's plane count.");
        Refused(whole.AsSpan(0, Length - 1), "The 343 bytes of the scene end within the scene's rules.");
        Refused(whole.AsSpan(0, SensorsAt - 1), "The 332 bytes of the scene end within body 1 of the scene.");
        Refused(whole.AsSpan(0, SensorsAt - 2), "announces 1 parts of the kind 'body', of 154 bytes or more, and has 153 bytes left");
        Refused([.. whole, .. new byte[24]], "The scene's periodic box has no size");
        Refused([.. whole, .. new byte[25]], "The scene's periodic box has no size");
        for (int value = 0; value <= 255; value++)
        {
            Refused([.. whole, (byte)value], "The 345 bytes of the scene end within the scene's periodic box.");
        }
    }

    [Fact]
    public void TryDecode_MutatedScenes_NeverThrowsAndWhatIsAcceptedIsCanonical() => Mutation.DecodeMany(Valid(), Trials, 3, Canonical);

    [Fact]
    public void TryDecode_RandomBytes_NeverThrows()
    {
        Random random = new(4);
        byte[] buffer = new byte[2000];
        for (int i = 0; i < Trials; i++)
        {
            Span<byte> bytes = buffer.AsSpan(0, random.Next(1, buffer.Length));
            random.NextBytes(bytes);
            bytes[0] = i % 4 == 0 ? bytes[0] : WireFormat.Version;
            Canonical(bytes);
        }
    }

    [Fact]
    public void TryDecode_WhatAnnouncesMuch_AllocatesByWhatIsThere()
    {
        byte[] whole = SceneFormat.Encode(One());
        foreach ((int at, ushort count) in new[] { (PlanesAt, (ushort)1000), (SpheresAt, (ushort)1000), (BodiesAt, (ushort)10_000), (BodiesAt, (ushort)65535) })
        {
            byte[] bytes = (byte[])whole.Clone();
            BinaryPrimitives.WriteUInt16LittleEndian(bytes.AsSpan(at), count);
            Assert.InRange(Allocated(bytes), 1, 4000);
        }

        // The control: what is really there does take room, and no more than a few times its length.
        byte[] row = SceneFormat.Encode(Row(2000));
        Assert.InRange(Allocated(row), row.Length, 12L * row.Length);
        row[^1] = 0xFF;
        row[^2] = 0xFF;
        Assert.InRange(Allocated(row), row.Length, 12L * row.Length);
    }

    [Fact]
    public void TryDecode_OutOfRange_IsRefusedWithTheBuildersSentence()
    {
        Refused(With(RestitutionAt, 1.5), "The restitution of body 'b' is 1.5; it must lie between 0 and 1");
        Refused(With(RestitutionThresholdAt, 1), "The restitution threshold of scene 's' is 1;");
        Refused(With(ToleranceOfContactAt, 0.5), "The contact tolerance of scene 's' is 0.5;");
        Refused(With(ToleranceOfContactAt, 0), "The contact tolerance of scene 's' is 0;");
        Refused(With(GravityAt, 1e7), "The gravity of scene 's' is");
        Refused(With(PositionAt, 2e12), "The position of body 'b' is");
        Refused(With(VelocityAt, 1e300), "The velocity of body 'b' is");
        Refused(With(PositionAt + 8, -1), "Body 'b' starts");
        Refused(With(NormalAt + 8, 0), "The normal of plane 'p' is (0, 0, 0)");
        Refused(With(SmallestAt, 0), "The smallest radius of scene 's' is 0;");
        Refused(WithByte(BodyNameAt, (byte)'p'), "Two parts of scene 's' are named 'p'");
        Refused(WithByte(FlightAt, 3), "The motion law of body 'b' is Sliding;");
        Refused(WithByte(SpecForcesAt, 1), "names force 0, counted from 0, but the scene has none");
        Refused(With(ToleranceAt, 2), "The tolerance of body 'b' is 2;");
        Refused(WithByte(SpawnersAt + 2, 2), "In the scene's head a number is not"); // a peer there cannot be
        Refused(WithByte(PlayersAt + 3, 0x80), "In body 1 of the scene a number is not");
        Refused(WithInt64(StepAt, 5), "The integrator step of body 'b' is");
    }

    [Fact]
    public void TryDecode_WhatTheBuilderWouldPutRight_IsRefused()
    {
        Refused(WithInt64(StepAt, 0), "In body 1 of the scene a number is not finite, a step is zero");
        Refused(With(NormalAt + 8, 2), "The normal of plane 'p' is (0, 2, 0); on the wire it has unit length.");
        Refused(With(SmallestAt, 1), "The radius of body 'b' is 0.5 m; the smallest radius of the scene is 1 m, and must be at most that of every body.");
    }

    [Fact]
    public void TryDecode_LawOfFlightLeftOpen_IsRefused()
    {
        Scene scene = new SceneBuilder("s").AddForce(Force.QuadraticDrag("a", 0.1), out ForceSet air)
            .AddBody("b", new BodySpec(0.5, 1, 0.5, forces: air), V(1)).Build();
        byte[] bytes = SceneFormat.Encode(scene);
        int spec = bytes.Length - 11 - 24 - 4 - (2 * 24) - EventFormat.SpecBytes; // spin, players, velocity and place follow it, and 11 bytes
        Assert.Equal((byte)MotionLaw.DormandPrince54, bytes[spec + 24]); // after radius, mass and restitution
        bytes[spec + 24] = (byte)MotionLaw.Automatic;
        Refused(bytes, "Body 1 of the scene leaves its law of flight open");
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.NegativeInfinity)]
    public void TryDecode_NumberNotFinite_IsRefusedInEveryField(double value)
    {
        foreach (int at in new[] { GravityAt, RestitutionThresholdAt, ToleranceOfContactAt, SmallestAt })
        {
            Refused(With(at, value), "In the scene's head a number is not finite");
        }

        foreach (int at in new[] { NormalAt, NormalAt + 24, NormalAt + 32 })
        {
            Refused(With(at, value), "In plane 1 of the scene a number is not finite");
        }

        foreach (int at in new[] { RestitutionAt, PositionAt, VelocityAt + 16 })
        {
            Refused(With(at, value), "In body 1 of the scene a number is not finite");
        }
    }

    [Fact]
    public void TryDecode_NameNotUtf8_IsRefused()
    {
        Refused(WithByte(PlaneNameAt + 1, 0x80), "In plane 1 of the scene a number is not finite, a step is zero, a set names a peer above 16, or a name is not UTF-8.");
        Refused(WithByte(2, 0xFF), "In the scene's head");
        Refused(WithByte(PlaneNameAt + 1, 0xC3), "In plane 1"); // the first half of a character
    }

    [Fact]
    public void TryDecode_OtherVersion_IsRefusedWithBoth() =>
        Refused(WithByte(0, 200), $"The scene is written in version 200 of the wire format; this is version {WireFormat.Version}.");

    [Fact]
    public void TryDecode_TooMany_IsRefusedBeforeItIsRead()
    {
        Refused(WithByte(PlanesAt + 1, 0x10), "announces 4097 parts of the kind 'plane'; at most 1000 are allowed");
        Refused(WithByte(BodiesAt + 1, 0x80), "announces 32769 parts of the kind 'body'; at most 10000 are allowed");
        Refused(WithByte(ForcesAt, 255), "announces 255 parts of the kind 'force'; at most 32 are allowed");
        Refused(new byte[SceneFormat.MaxBytes + 1], $"The scene takes {SceneFormat.MaxBytes + 1} bytes; at most {SceneFormat.MaxBytes} are allowed.");
    }

    [Fact]
    public void TryDecode_AccelerationThatIsNotHere_IsRefusedWithNameAndVersion()
    {
        byte[] bytes = SceneFormat.Encode(new SceneBuilder("s").AddForce(Force.Supplied(new Wind("wind", -3))).Build());
        Assert.NotNull(Decoded(bytes, [new Wind("tide", -3), new Wind("wind", 2), new Wind("wind", -3)]));

        Refused(bytes, "The scene needs the acceleration 'wind' of version -3, which is not here.", null);
        Refused(bytes, "The scene needs the acceleration 'wind' of version -3, which is not here.", [new Wind("Wind", -3)]);
        Refused(bytes, "The scene needs the acceleration 'wind' of version -3; here it is of version 2.", [new Wind("wind", 2)]);
    }

    [Fact]
    public void Encode_WhatCannotTravel_IsRefusedWithASentence()
    {
        Assert.Throws<ArgumentNullException>(() => SceneFormat.Encode(null!));
        Unsendable(() => WireText.EncodedLength(new string('x', 256), "A name"), "takes 256 bytes in UTF-8; at most 255 are allowed");
        Unsendable(() => WireText.EncodedLength("\uD834", "A name"), "A name cannot travel: '\uD834' has half a surrogate pair in it");
        Unsendable(() => WireText.EncodedLength("\uDD1E\uD834", "A name"), "A name cannot travel");
        Unsendable(() => SceneFormat.Encode(Row(SceneFormat.MaxBodies + 1)), "it has 10001 bodies; at most 10000 are allowed");

        Scene longest = new SceneBuilder("s").AddBody(new string('\uFFFD', 64), Ball(), V(0)).AddForce(Force.Supplied(new Wind(new string('é', 64), 1))).Build();
        Assert.True(IsSame(longest, Decoded(SceneFormat.Encode(longest), longest.Accelerations)));
    }

    private static byte[][] Valid() =>
        [.. Gen.Sample(SceneGen.Any, 60, new Rnd(20261121, 1), 8).Select(SceneFormat.Encode), .. Enumerable.Range(1, 10).Select(seed => SceneFormat.Encode(new RandomWorld(seed).Scene))];

    private static Scene One() => new SceneBuilder("s").WithSmallestRadius(0.25)
        .AddPlane("p", Vector3D.Up, 0.0, 0.5).AddStaticSphere("q", V(5, 5), 1).AddBody("b", Ball(0.5, 2, 0.75), V(1, 2, 3), V(0.5)).Build();

    private static Scene Row(int bodies)
    {
        SceneBuilder builder = new("row");
        for (int i = 0; i < bodies; i++)
        {
            builder.AddBody($"{i}", Ball(), V(2 * i));
        }

        return builder.Build();
    }

    private static byte[] With(int at, double value) => WithInt64(at, BitConverter.DoubleToInt64Bits(value));

    private static byte[] WithInt64(int at, long value)
    {
        byte[] bytes = SceneFormat.Encode(One());
        BinaryPrimitives.WriteInt64LittleEndian(bytes.AsSpan(at), value);
        return bytes;
    }

    private static byte[] WithByte(int at, byte value)
    {
        byte[] bytes = SceneFormat.Encode(One());
        bytes[at] = value;
        return bytes;
    }

    private static Scene Decoded(ReadOnlySpan<byte> bytes, IReadOnlyList<IAcceleration>? known = null)
    {
        Assert.True(SceneFormat.TryDecode(bytes, new SceneCode(known, null), out Scene? scene, out string? error), error);
        Assert.Null(error);
        return scene;
    }

    private static void Refused(ReadOnlySpan<byte> bytes, string sentence, IReadOnlyList<IAcceleration>? known = null)
    {
        Assert.False(SceneFormat.TryDecode(bytes, new SceneCode(known, null), out Scene? scene, out string? error));
        Assert.Null(scene);
        Assert.Contains(sentence, error, StringComparison.Ordinal);
        Assert.EndsWith(".", error, StringComparison.Ordinal);
    }

    private static void Unsendable(Func<object> encode, string sentence) =>
        Assert.Contains(sentence, Assert.Throws<ArgumentException>(encode).Message, StringComparison.Ordinal);

    private static bool IsSame(Scene a, Scene b) =>
        a.Hash == b.Hash && Names(a).SequenceEqual(Names(b)) && SceneFormat.Encode(a).AsSpan().SequenceEqual(SceneFormat.Encode(b));

    private static IEnumerable<string> Names(Scene scene) =>
        [scene.Name, .. scene.Planes.Select(p => p.Name), .. scene.StaticSpheres.Select(s => s.Name), .. scene.Bodies.Select(b => b.Name)];

    private static bool Canonical(ReadOnlySpan<byte> bytes)
    {
        IReadOnlyList<IAcceleration> known = [new FunctionForce((_, x, _) => -x)];
        bool isAccepted = SceneFormat.TryDecode(bytes, new SceneCode(known, null), out Scene? scene, out string? error);
        Assert.Equal(isAccepted, error is null);
        if (isAccepted)
        {
            byte[] again = SceneFormat.Encode(scene!);
            Assert.True(AnyDatagram.SameButForNegativeZero(bytes, again), Convert.ToHexString(bytes));
            Assert.Equal(again, SceneFormat.Encode(Decoded(again, known)));
        }

        return isAccepted;
    }

    private static long Allocated(byte[] bytes)
    {
        SceneFormat.TryDecode(bytes, default, out _, out _);
        long before = GC.GetAllocatedBytesForCurrentThread();
        SceneFormat.TryDecode(bytes, default, out _, out _);
        return GC.GetAllocatedBytesForCurrentThread() - before;
    }

    private sealed class Wind(string name, int version) : IAcceleration
    {
        public string Name => name;

        public int Version => version;

        public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => -velocity;
    }
}
