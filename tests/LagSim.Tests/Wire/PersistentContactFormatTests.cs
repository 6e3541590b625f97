using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;
using static LagSim.Tests.Wire.SnapshotBits;

namespace LagSim.Tests.Wire;

/// <summary>
/// The persistent contacts of a snapshot's members on the wire: ranges, the one form, the room they take; and a heap that goes on from them.
/// </summary>
public sealed class PersistentContactFormatTests
{
    // Where things stand in a snapshot of one member that does not turn.
    private const int LawAt = 32 + 119;
    private const int SupportsAt = 32 + 208;
    private const int CentreAt = 32 + 210;
    private const int CountAt = CentreAt + 16;
    private const int FirstAt = CountAt + 2;
    private const int SurfaceAt = FirstAt + 8;
    private const int HoldsAt = FirstAt + 12;
    private const int PushAt = FirstAt + 13;
    private const int ContactBytes = 61;

    private static readonly PersistentContact[] Three =
    [
        new(Second, PersistentContact.NoSurface, holds: true, V(1, -0.0, double.Epsilon), V(-0.0)),
        new(First, 0, holds: false, V(double.MaxValue, 2, 3), V(4, 5, 6)),
        new(BodyId.FromPacked(ulong.MaxValue), int.MaxValue, holds: true, solved: true),
    ];

    [Theory]
    [InlineData(MotionLaw.Constrained)]
    [InlineData(MotionLaw.Resting)]
    public void Contacts_OfAMember_StandAfterItAndComeBackToTheBit(MotionLaw law)
    {
        WorldSnapshot snapshot = World(law, Three);
        byte[] bytes = SnapshotFormat.Encode(snapshot);
        Assert.Equal(FirstAt + (3 * ContactBytes), bytes.Length);
        Assert.True(Same(snapshot, Decoded(bytes)));
        for (int at = CentreAt; at < bytes.Length; at++)
        {
            // The control: a bit of any byte of them is seen, or is not one that can be.
            byte[] other = (byte[])bytes.Clone();
            other[at] ^= 1;
            Assert.True(!SnapshotFormat.TryDecode(other, out WorldSnapshot? again, out _) || !Same(snapshot, again), $"byte {at}");
        }
    }

    [Theory]
    [InlineData(MotionLaw.Ballistic)]
    [InlineData(MotionLaw.Sliding)]
    [InlineData(MotionLaw.Rolling)]
    [InlineData(MotionLaw.Absent)]
    public void Contacts_OfWhoIsNoMember_HaveNoPlace(MotionLaw law)
    {
        byte[] bytes = SnapshotFormat.Encode(World(MotionLaw.Constrained, Three));
        bytes[LawAt] = (byte)law;
        Refused(WireRefusal.TrailingBytes, bytes);
        Decoded(bytes.AsSpan(0, CentreAt)); // the control: without them it is a body of that law
    }

    [Fact]
    public void Contacts_OfWhatRests_HaveAPlaceOnlyIfNoPlaneCarriesIt()
    {
        byte[] free = SnapshotFormat.Encode(World(MotionLaw.Resting, Three));
        byte[] carried = [.. free[..SupportsAt], 1, 0, 0, 0, 0, .. free[(SupportsAt + 1)..]];
        Decoded(free);
        Refused(WireRefusal.TrailingBytes, carried);
        Decoded(carried.AsSpan(0, CentreAt + 4));
        Refused(WireRefusal.TooShort, free.AsSpan(0, CentreAt));
    }

    [Theory]
    [InlineData(0xFFFFFFFEu, false)]
    [InlineData(0x80000000u, false)]
    [InlineData(0xFFFFFFFFu, true)]
    [InlineData(0x7FFFFFFFu, true)]
    [InlineData(0u, true)]
    public void TryDecode_Surface_IsBelow2To31OrNone(uint surface, bool isAccepted)
    {
        byte[] bytes = SnapshotFormat.Encode(World(MotionLaw.Constrained, Three));
        BinaryPrimitives.WriteUInt32LittleEndian(bytes.AsSpan(SurfaceAt), surface);
        AssertRefusal(isAccepted ? WireRefusal.None : WireRefusal.BadValue, bytes);
    }

    [Theory]
    [InlineData(0, true)]
    [InlineData(1, true)]
    [InlineData(2, false)]
    [InlineData(3, false)]
    [InlineData(255, false)]
    [InlineData(1, true, 2)]
    [InlineData(2, false, 2)]
    [InlineData(3, true, 2)]
    [InlineData(4, false, 2)]
    public void TryDecode_Holds_IsZeroOrOneOrThreeForASurface(byte holds, bool isAccepted, int contact = 0)
    {
        byte[] bytes = SnapshotFormat.Encode(World(MotionLaw.Constrained, Three));
        bytes[HoldsAt + (contact * ContactBytes)] = holds;
        AssertRefusal(isAccepted ? WireRefusal.None : WireRefusal.BadValue, bytes);
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    [InlineData(double.NegativeInfinity)]
    public void TryDecode_ImpulseNotFinite_IsRefusedInEveryComponent(double value)
    {
        for (int n = 0; n < 6; n++)
        {
            byte[] bytes = SnapshotFormat.Encode(World(MotionLaw.Constrained, Three));
            BitConverter.GetBytes(value).CopyTo(bytes, PushAt + (8 * n));
            Refused(WireRefusal.BadValue, bytes);
            BitConverter.GetBytes(0.5).CopyTo(bytes, PushAt + (8 * n)); // the control: it is a number that stands there
            Decoded(bytes);
        }
    }

    [Fact]
    public void TryDecode_CutShortOrAnotherCount_IsRefused()
    {
        byte[] bytes = SnapshotFormat.Encode(World(MotionLaw.Constrained, Three));
        for (int length = 0; length < bytes.Length; length++)
        {
            Refused(WireRefusal.TooShort, bytes.AsSpan(0, length));
        }

        Refused(WireRefusal.TrailingBytes, [.. bytes, 0]);
        bytes[CountAt] = 2;
        Refused(WireRefusal.TrailingBytes, bytes);
        bytes[CountAt] = 4;
        Refused(WireRefusal.TooShort, bytes);
        bytes[CountAt] = 3;
        Decoded(bytes);
    }

    [Fact]
    public void TryDecode_ManyContactsAnnounced_TakesRoomForThoseThatAreThere()
    {
        byte[] bytes = SnapshotFormat.Encode(World(MotionLaw.Constrained, Three));
        bytes[CountAt] = bytes[CountAt + 1] = 0xFF;
        Refused(WireRefusal.TooShort, bytes);
        Assert.InRange(Allocated(bytes), 0, 2000);

        // The control: those that are there do take room, and no more than a few times their length; refused at the last they are as cheap.
        byte[] many = SnapshotFormat.Encode(World(MotionLaw.Constrained, [.. Enumerable.Repeat(Three[0], ushort.MaxValue)]));
        Assert.Equal(FirstAt + (ushort.MaxValue * ContactBytes), many.Length);
        Assert.Equal(ushort.MaxValue, Decoded(many).Bodies[0].Contacts.Length);
        Assert.InRange(Allocated(many), many.Length, 6L * many.Length);
        many[^1] = 0x7F;
        many[^2] = 0xF0;
        Refused(WireRefusal.BadValue, many);
        Assert.InRange(Allocated(many), 0, 6L * many.Length);
    }

    [Fact]
    public void Encode_WhatCannotTravel_IsRefused()
    {
        Refuse("65536 contacts", [.. Enumerable.Repeat(Three[0], ushort.MaxValue + 1)]);
        Refuse("surface -2", [new PersistentContact(First, -2, holds: true)]);
        Refuse("solved", [new PersistentContact(Second, PersistentContact.NoSurface, holds: true, solved: true)]);
        Refuse("solved", [new PersistentContact(First, 0, holds: false, solved: true)]);
        Refuse("finite", [new PersistentContact(Second, PersistentContact.NoSurface, holds: true, V(double.NaN))]);
        Refuse("finite", [new PersistentContact(Second, PersistentContact.NoSurface, holds: true, default, V(0, 0, double.PositiveInfinity))]);

        static void Refuse(string word, PersistentContact[] contacts)
        {
            WorldSnapshot snapshot = World(MotionLaw.Constrained, contacts);
            string message = Assert.Throws<ArgumentException>(() => SnapshotFormat.Encode(snapshot)).Message;
            Assert.Contains(word, message, StringComparison.Ordinal);
        }
    }

    [Theory]
    [InlineData(0.75)]
    [InlineData(1.5)]
    [InlineData(4.0)]
    public void Heap_GoingOnFromItsBytes_IsTheSameToTheBit(double seconds)
    {
        Scene heap = Heap();
        Simulation expected = Run(heap, 6);
        WorldSnapshot snapshot = expected.Snapshot(At(seconds));
        Assert.Contains(snapshot.Bodies, b => b.Contacts.Length > 1);
        WorldSnapshot again = Decoded(SnapshotFormat.Encode(snapshot));
        Assert.True(Same(snapshot, again));
        Assert.Equal(Ends(expected), Ends(GoneOn(heap, again)));
    }

    [Fact]
    public void Heap_GoingOnFromOtherBytes_IsAnother()
    {
        // The control: every part of a contact that holds counts in what follows.
        Scene heap = Heap();
        Simulation expected = Run(heap, 6);
        WorldSnapshot snapshot = expected.Snapshot(At(0.75));
        int which = Array.FindIndex([.. snapshot.Bodies], b => b.Contacts.ToArray().Any(c => c.Holds && c.Push.Length > 0));
        Assert.NotEqual(Ends(expected), Ends(GoneOn(heap, With(c => new(c.Partner, c.Surface, c.Holds, c.Push * 0.5, c.Turn)))));
        Assert.NotEqual(Ends(expected), Ends(GoneOn(heap, With(c => new(c.Partner, c.Surface, false, c.Push, c.Turn)))));

        WorldSnapshot With(Func<PersistentContact, PersistentContact> change)
        {
            BodySnapshot[] bodies = [.. snapshot.Bodies];
            BodySnapshot b = bodies[which];
            bodies[which] = new BodySnapshot(
                b.Id, b.Spec, b.Opened, b.Law, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, spin: b.Spin, spinRate: b.SpinRate,
                centre: b.Centre, stillSince: b.StillSince, contacts: [.. b.Contacts.ToArray().Select(change)]);
            return new WorldSnapshot(snapshot.Start, snapshot.Time, snapshot.EventHash, bodies);
        }
    }

    private static WorldSnapshot World(MotionLaw law, PersistentContact[] contacts) => new(At(0), At(1), 7,
    [
        new(First, Ball(), new EventKey(At(0.5), 0, EventKind.StepEnd, First, First, 0, 0), law, At(0.5), At(0.5), V(1, 2, 3), V(4), V(0),
            centre: At(0.25), stillSince: At(0.125), contacts: contacts),
    ]);

    private static void AssertRefusal(WireRefusal expected, byte[] bytes)
    {
        Assert.Equal(expected == WireRefusal.None, SnapshotFormat.TryDecode(bytes, out _, out WireRefusal refusal));
        Assert.Equal(expected, refusal);
    }

    private static List<(ulong State, ulong Events)> Ends(Simulation world) =>
        [.. new[] { 4.25, 5, 6 }.Select(t => (world.StateHash(At(t)), world.EventHash(At(t))))];

    private static Simulation GoneOn(Scene scene, WorldSnapshot snapshot)
    {
        Simulation world = new(scene, snapshot, KeepAll);
        world.AdvanceTo(At(6));
        return world;
    }

    /// <summary>Eight balls with friction and rolling resistance that fall into a box, where two have room beside each other.</summary>
    private static Scene Heap()
    {
        SceneBuilder builder = new SceneBuilder("heap").AddPlane("floor", Vector3D.Up, 0.0, 0.2, 0.5)
            .AddPlane("west", V(1), -0.52, 0.2, 0.5).AddPlane("east", V(-1), -0.52, 0.2, 0.5)
            .AddPlane("north", V(0, 0, 1), -0.3, 0.2, 0.5).AddPlane("south", V(0, 0, -1), -0.3, 0.2, 0.5);
        for (int i = 0; i < 8; i++)
        {
            BodySpec spec = new(0.2 + (0.005 * i), 1 + i, 0.2, friction: 0.5, rollingResistance: 0.02);
            builder.AddBody($"ball {i}", spec, V(i % 2 == 0 ? -0.25 : 0.27, 0.4 + (0.6 * (i / 2)), 0.03 * (i % 3)));
        }

        return builder.Build();
    }
}
