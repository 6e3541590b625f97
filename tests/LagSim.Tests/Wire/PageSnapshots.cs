using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using FsCheck.Fluent;
using LagSim.Events;
using LagSim.Harness.Verification.Check;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Time;
using LagSim.Timelines;
using static LagSim.Tests.TestWorlds;
using static LagSim.Tests.Wire.LayoutPage;

namespace LagSim.Tests.Wire;

/// <summary>Drawn snapshots and copies: of each, the bytes that the library writes and those that the tables of docs/WIRE.md give.</summary>
internal static class PageSnapshots
{
    internal static IEnumerable<(byte[] Expected, Func<string[], byte[]> Written)> Snapshots() => Enumerable.Range(1, 8).Select(seed =>
    {
        RandomWorld world = new(seed);
        WorldSnapshot snapshot = world.OnTime().Snapshot(At(0.6));
        if (seed == 1)
        {
            // No body of a world is carried and integrated at a time, but a layout has room for both.
            BodySnapshot b = snapshot.Bodies[0];
            BodySnapshot both = new(
                b.Id, b.Spec, b.Opened, MotionLaw.RungeKutta4, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, [7, 8, 9], V(1, 2, 3), V(4, 5, 6), V(7, 8, 9));
            snapshot = new WorldSnapshot(snapshot.Start, snapshot.Time, snapshot.EventHash, [both]);
        }
        else if (seed == 3)
        {
            BodySnapshot b = snapshot.Bodies[0];
            BodySnapshot controlled = new(
                b.Id, b.Spec.With(new CollisionFilter(2, 3)).WithTag(77), b.Opened, MotionLaw.DormandPrince54, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, [], V(1, 2, 3), V(4, 5, 6), V(7, 8, 9),
                nextStep: SimDuration.FromSeconds(0.25), spin: V(10, 11, 12), spinRate: V(13, 14, 15), filter: new CollisionFilter(5, 9), players: PeerSet.Of(1, 4));
            snapshot = new WorldSnapshot(snapshot.Start, snapshot.Time, snapshot.EventHash, [controlled]);
        }
        else if (seed == 2)
        {
            BodySnapshot b = snapshot.Bodies[0];
            BodySnapshot held = new(
                b.Id, b.Spec, b.Opened, MotionLaw.Held, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, [7], V(1, 2, 3), hold: new Hold(3, V(4, 5, 6), At(7), 8, 9, At(10)),
                filter: new CollisionFilter(5, 9), players: PeerSet.Of(2));
            snapshot = new WorldSnapshot(snapshot.Start, snapshot.Time, snapshot.EventHash, [held]);
        }

        else if (seed == 4)
        {
            BodySnapshot b = snapshot.Bodies[0];
            PersistentContact[] contacts =
                [new(Second, PersistentContact.NoSurface, true, V(1, 2, 3), V(4, 5, 6)), new(First, 7, false, V(7, 8, 9), V(-1, -2, -0.0)), new(First, 8, true, V(3, 2, 1), default, solved: true)];
            BodySnapshot member = new(
                b.Id, b.Spec, b.Opened, MotionLaw.Constrained, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, spin: V(10, 11, 12),
                centre: At(0.125), stillSince: At(0.25), contacts: contacts, filter: new CollisionFilter(6, 10), inside: [3, 7],
                crossings: [new Crossing(new EventKey(At(0.5), 2, EventKind.Crossing, b.Id, b.Id, 0, 7), true)], players: PeerSet.Of(2));
            BodySnapshot sleeper = new(
                Second, b.Spec, b.Opened, MotionLaw.Resting, b.Epoch, b.End, b.Position, default, default, centre: At(0.375),
                contacts: contacts.AsSpan(0, 1));
            BodySnapshot carried = new(Third, b.Spec, b.Opened, MotionLaw.Resting, b.Epoch, b.End, b.Position, default, default, [3]);
            snapshot = new WorldSnapshot(snapshot.Start, snapshot.Time, snapshot.EventHash, [member, sleeper, carried], new RandomWorld(5, rules: true).OnTime().Snapshot(At(0.6)).RuleState);
        }

        return (SessionSnapshot.Encode(world.Scene, snapshot), (Func<string[], byte[]>)(page => Copy(page, world.Scene, snapshot)));
    });

    internal static byte[] Copy(string[] page, Scene scene, WorldSnapshot snapshot)
    {
        byte[] first = SceneFormat.Encode(scene);
        MemoryStream bytes = new();
        Write(bytes, Table(page, "## The copy"), Values(("scene length", first.Length), ("scene", first), ("snapshot", Snapshot(page, snapshot))));
        return bytes.ToArray();
    }

    internal static byte[] Snapshot(string[] page, WorldSnapshot snapshot)
    {
        MemoryStream bytes = new();
        Write(
            bytes,
            Table(page, "## Snapshot"),
            Values(("start", snapshot.Start), ("time", snapshot.Time), ("event hash", snapshot.EventHash), ("rule state length", snapshot.RuleState.Length), ("rule state", RuleState(page, snapshot.RuleState)),
                ("bodies", snapshot.Bodies.Count)),
            new() { ["bodies"] = ("", snapshot.Bodies.Select(body => Body(page, body))) });
        return bytes.ToArray();
    }

    private static byte[] RuleState(string[] page, ReadOnlySpan<byte> state)
    {
        if (state.IsEmpty)
        {
            return [];
        }

        int timers = BitConverter.ToInt32(state[8..]) * 16;
        int world = new DrawnRules(0).WorldBytes;
        MemoryStream bytes = new();
        Write(bytes, Table(page, "### State of rules"), Values(
            ("spawned", BitConverter.ToUInt64(state)), ("timers", BitConverter.ToInt32(state[8..])), ("body states", BitConverter.ToInt32(state[12..])),
            ("timer list", state[16..(16 + timers)].ToArray()), ("world state", state.Slice(16 + timers, world).ToArray()), ("body list", state[(16 + timers + world)..].ToArray())));
        return bytes.ToArray();
    }

    private static Dictionary<string, object> Body(string[] page, BodySnapshot b) => Values(
        ("body id", b.Id.Packed), ("body spec", b.Spec), ("opened at", b.Opened.Time), ("opened round", b.Opened.Round), ("opened kind", (byte)b.Opened.Kind),
        ("opened body", b.Opened.Body.Packed), ("opened other", b.Opened.Other.Packed), ("opened peer", b.Opened.Peer), ("opened sequence", b.Opened.Sequence),
        ("law", (byte)b.Law), ("epoch", b.Epoch), ("end", b.End), ("position", b.Position), ("velocity", b.Velocity), ("acceleration", b.Acceleration),
        ("supports", (byte)b.SupportCount), ("carried by", Enumerable.Range(0, b.SupportCount).Select(b.Support).ToArray()),
        ("dense output", b.Law is MotionLaw.RungeKutta4 or MotionLaw.ClosedForm or MotionLaw.DormandPrince54
            ? new[] { b.Cubic, b.Quartic, b.Quintic } : []),
        ("next step", b.Law == MotionLaw.DormandPrince54 ? new[] { b.NextStep.Ticks } : []),
        ("has", (b.Spin != Vector3D.Zero || b.SpinRate != Vector3D.Zero ? 1 : 0) + (b.Filter != b.Spec.Filter ? 2 : 0)
            + (b.Players != PeerSet.Everyone ? 4 : 0) + (b.Inside.Length + b.Crossings.Length > 0 ? 8 : 0)
            + (b.Hold.MaxForce != 0 || b.Hold.MaxPower != 0 ? 16 : 0) + (b.Hold.BusyUntil != default ? 32 : 0)),
        ("strength", b.Hold.MaxForce != 0 || b.Hold.MaxPower != 0 ? [.. BitConverter.GetBytes(b.Hold.MaxForce), .. BitConverter.GetBytes(b.Hold.MaxPower)] : Array.Empty<byte>()),
        ("busy", b.Hold.BusyUntil != default ? BitConverter.GetBytes(b.Hold.BusyUntil.Ticks) : []),
        ("players", b.Players != PeerSet.Everyone ? BitConverter.GetBytes(b.Players.Mask) : []),
        ("filter", b.Filter != b.Spec.Filter ? b.Filter : null!),
        ("sensors", Sensors(b)),
        ("spin", b.Spin != Vector3D.Zero || b.SpinRate != Vector3D.Zero ? new[] { b.Spin, b.SpinRate } : []),
        ("hold", b.Law == MotionLaw.Held ? (b.Hold, b.Cubic) : null!),
        ("member", IsMember(b) ? (b.Centre, b.StillSince, b.Contacts.Length) : null!),
        ("contacts", IsMember(b) ? b.Contacts.ToArray().SelectMany(contact => Contact(page, contact)).ToArray() : []));

    private static byte[] Sensors(BodySnapshot b) => b.Inside.Length + b.Crossings.Length == 0 ? [] :
    [
        .. LayoutPage.Bytes("u16", b.Inside.Length), .. b.Inside.ToArray().SelectMany(sensor => LayoutPage.Bytes("u16", sensor)), .. LayoutPage.Bytes("u16", b.Crossings.Length),
        .. b.Crossings.ToArray().SelectMany(c => (byte[])[.. LayoutPage.Bytes("ticks", c.Time), .. LayoutPage.Bytes("u32", c.Key.Round), .. LayoutPage.Bytes("u16", c.Sensor), (byte)(c.Entered ? 1 : 0)]),
    ];

    private static bool IsMember(BodySnapshot b) => b.Law == MotionLaw.Constrained || (b.Law == MotionLaw.Resting && b.SupportCount == 0);

    private static byte[] Contact(string[] page, PersistentContact contact)
    {
        MemoryStream bytes = new();
        uint surface = contact.Surface == PersistentContact.NoSurface ? 0xFFFFFFFF : (uint)contact.Surface;
        Write(bytes, Table(page, "### Persistent contact"), Values(
            ("partner", contact.Partner.Packed), ("surface", surface), ("holds", contact.Solved ? 3 : contact.Holds ? 1 : 0), ("push", contact.Push),
            ("turn", contact.Turn)));
        return bytes.ToArray();
    }
}
