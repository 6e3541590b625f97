using System;
using System.Linq;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Wire;

/// <summary>Generators of everything that can travel, over its whole range, edges included.</summary>
internal static class WireGen
{
    internal static readonly Config Config = Config.QuickThrowOnFailure.WithMaxTest(500).WithReplay(20261121, 1);

    internal static readonly Gen<byte> Byte = Gen.Choose(0, 255).Select(value => (byte)value);

    internal static readonly Gen<ulong> Bits64 =
        from high in Gen.Choose(int.MinValue, int.MaxValue)
        from low in Gen.Choose(int.MinValue, int.MaxValue)
        select ((ulong)(uint)high << 32) | (uint)low;

    internal static readonly Gen<uint> Bits32 =
        Gen.OneOf(Gen.Elements(0u, 1u, uint.MaxValue), Bits64.Select(bits => (uint)bits));

    internal static readonly Gen<SimTime> Time = Gen.OneOf(
        Gen.Elements(0L, 1L, -1L, WireFormat.MaxTimeTicks, -WireFormat.MaxTimeTicks).Select(SimTime.FromTicks),
        Bits64.Select(bits => SimTime.FromTicks((long)bits >> 2 == long.MinValue >> 2 ? 0 : (long)bits >> 2)));

    internal static readonly Gen<SimTime> OptionalTime = Gen.OneOf(Gen.Constant(SimTime.MinValue), Time);

    /// <summary>Finite and not -0.0, which does not survive travel.</summary>
    internal static readonly Gen<double> Number = Gen.OneOf(
        Gen.Elements(0.0, 1.0, -9.81, double.MaxValue, double.MinValue, double.Epsilon),
        Bits64.Select(bits => BitConverter.UInt64BitsToDouble(bits)).Where(double.IsFinite).Select(value => value + 0.0));

    internal static readonly Gen<Vector3D> Vector = from x in Number from y in Number from z in Number select new Vector3D(x, y, z);

    /// <summary>Every finite number, -0.0 and the smallest there are among them: of what travels to the bit.</summary>
    internal static readonly Gen<double> Exact = Gen.OneOf(
        Gen.Elements(0.0, -0.0, double.Epsilon, -double.Epsilon, double.MaxValue),
        Bits64.Select(BitConverter.UInt64BitsToDouble).Where(double.IsFinite));

    internal static readonly Gen<Vector3D> ExactVector = from x in Exact from y in Exact from z in Exact select new Vector3D(x, y, z);

    /// <summary>A persistent contact with anybody or any surface.</summary>
    internal static readonly Gen<PersistentContact> Contact =
        from partner in Bits64
        from surface in Gen.OneOf(Gen.Elements(PersistentContact.NoSurface, 0, int.MaxValue), Gen.Choose(0, 1000))
        from holds in Gen.Elements(true, false)
        from push in ExactVector
        from turn in ExactVector
        from solved in Gen.Elements(false, true)
        select new PersistentContact(BodyId.FromPacked(partner), surface, holds, push, turn, solved && holds && surface != PersistentContact.NoSurface);

    internal static readonly Gen<CollisionFilter> Filter = Gen.OneOf(
        Gen.Constant(default(CollisionFilter)), from category in Bits32 from mask in Bits32 select new CollisionFilter(category, mask));

    internal static readonly Gen<BodySpec> Spec =
        from radius in Gen.OneOf(Gen.Elements(1e-9, 0.5, 1e9), Gen.Choose(1, 1000000).Select(n => n * 1e-3))
        from mass in Gen.OneOf(Gen.Elements(1e-30, 1.0, 1e30), Gen.Choose(1, 1000000).Select(n => n * 1e-3))
        from restitution in Gen.Choose(0, 1000).Select(n => n / 1000.0)
        from flight in Gen.Elements(MotionLaw.Ballistic, MotionLaw.RungeKutta4, MotionLaw.ClosedForm, MotionLaw.DormandPrince54, MotionLaw.Automatic)
        from step in Gen.OneOf(
            Gen.Elements(EventFormat.MinStep, EventFormat.MaxStep), Gen.Choose(2, 999999).Select(n => SimDuration.FromSeconds(n * 1e-6)))
        from forces in Bits32.Select(ForceSet.FromMask)
        from tolerance in Gen.OneOf(Gen.Elements(0, 1e-12, BodySpec.DefaultTolerance, 1), Gen.Choose(0, 1000000).Select(n => n * 1e-6))
        from friction in Gen.Elements(0, 0.3, 100)
        from rolling in Gen.Elements(0, 0.01, 1)
        from filter in Filter
        from tag in Bits64
        select new BodySpec(radius, mass, restitution, flight, step, flight == MotionLaw.Ballistic ? ForceSet.None : forces, tolerance, friction, rolling, filter, tag);

    private static readonly Gen<GameCommand> Command =
        from number in Gen.Choose(0, ushort.MaxValue)
        from length in Gen.OneOf(Gen.Choose(0, 8), Gen.Choose(0, GameCommand.MaxBytes))
        from data in Gen.ArrayOf(Byte, length)
        select new GameCommand(number, data);

    internal static readonly Gen<string> Name = Gen.Elements(
        "", "a", "Ann", "Zoë", "日本の人", new string('m', Net.Wire.RosterEntry.MaxNameBytes), new string('ä', Net.Wire.RosterEntry.MaxNameBytes / 2), "🎱🎱");

    private static readonly Gen<PlayerEvent> Player =
        from kind in Gen.Elements(PlayerEventKind.Joined, PlayerEventKind.Away, PlayerEventKind.Returned, PlayerEventKind.Left)
        from number in Byte.Select(number => Math.Min(number, PlayerEvent.MaxNumber))
        from identity in Bits64.Select(identity => Math.Max(1, identity))
        from name in Name
        from role in Gen.Elements(PeerRole.Player, PeerRole.Spectator, PeerRole.Bot)
        select new PlayerEvent(kind, number, identity, name, role);

    internal static readonly Gen<ExternalEvent> Event =
        from kind in Gen.Elements(EventKind.Spawn, EventKind.Remove, EventKind.Teleport, EventKind.SetVelocity, EventKind.Impulse, EventKind.Grab, EventKind.HoldKeyframe, EventKind.Release, EventKind.SetFilter, EventKind.Command, EventKind.Player)
        from time in Time
        from peer in Byte
        from sequence in Bits32.Select(value => Math.Max(1, value))
        from body in Bits64.Select(BodyId.FromPacked)
        from spec in Spec
        from position in Vector
        from velocity in Vector
        from spin in Gen.OneOf(Gen.Constant(Vector3D.Zero), Vector)
        from filter in Filter
        from command in Command
        from player in Player
        from players in Gen.OneOf(Gen.Constant(PeerSet.Everyone), Gen.Choose(0, (int)PeerSet.Everyone.Mask).Select(mask => PeerSet.FromMask((uint)mask)))
        from strength in Gen.Elements((0.0, 0.0), (100.0, 0.0), (0.0, 3e-5), (double.MaxValue, double.Epsilon))
        from occupied in Gen.Elements(WhenOccupied.Overlap, WhenOccupied.Skip, WhenOccupied.Beside)
        select kind switch
        {
            EventKind.Spawn => ExternalEvent.Spawn(time, peer, sequence, spec, position, velocity, spin, players, occupied),
            EventKind.Remove => ExternalEvent.Remove(time, peer, sequence, body),
            EventKind.Teleport => ExternalEvent.Teleport(time, peer, sequence, body, position, velocity, occupied),
            EventKind.SetVelocity => ExternalEvent.SetVelocity(time, peer, sequence, body, velocity),
            EventKind.Grab => ExternalEvent.Grab(time, peer, sequence, body, position, strength.Item1, strength.Item2),
            EventKind.HoldKeyframe => ExternalEvent.HoldKeyframe(time, peer, sequence, body, position, velocity),
            EventKind.Release => ExternalEvent.Release(time, peer, sequence, body, velocity),
            EventKind.Command => ExternalEvent.Tell(time, peer, sequence, command),
            EventKind.Player => player.Stamp(time, sequence),
            EventKind.SetFilter => ExternalEvent.SetFilter(time, peer, sequence, body, filter),
            _ => ExternalEvent.Impulse(time, peer, sequence, body, velocity),
        };

    internal static readonly Gen<Token128> Token = Gen.ArrayOf(Byte, Token128.Bytes).Select(bytes => new Token128(bytes));

    internal static readonly Gen<ConnectRequestDatagram> ConnectRequest = from nonce in Bits64 from wanted in Token select new ConnectRequestDatagram(nonce, wanted);

    internal static readonly Gen<ChallengeDatagram> Challenge = from nonce in Bits64 from cookie in Token select new ChallengeDatagram(nonce, cookie);

    internal static readonly Gen<SnapshotRequestDatagram> SnapshotRequest =
        from session in Bits64
        from shorter in Gen.Choose(0, SnapshotRequestDatagram.MaxShorter)
        from number in Bits32
        from first in Bits32
        from wanted in Bits64
        select new SnapshotRequestDatagram(session, (byte)shorter, number, first, wanted);

    internal static readonly Gen<DesyncQueryDatagram> DesyncQuery =
        from session in Bits64
        from peer in Byte
        from number in Bits32
        from after in Time
        from upTo in Time
        from first in Bits32
        where after != upTo
        select new DesyncQueryDatagram(session, peer, number, SimTime.Min(after, upTo), SimTime.Max(after, upTo), first);

    internal static readonly Gen<DesyncReportDatagram> DesyncReport = Gen.OneOf(
        from session in Bits64 from whole in Byte select new DesyncReportDatagram(session, whole % 2 == 1),
        from session in Bits64
        from total in Bits32
        from index in Bits32
        from place in Bits32
        from what in Event
        select new DesyncReportDatagram(session, Math.Max(1, total), index % Math.Max(1, total), Math.Max(1, place), what));

    /// <summary>A piece as bytes: it cannot leave the stack itself.</summary>
    internal static readonly Gen<byte[]> Chunk =
        from session in Bits64
        from index in Bits32
        from length in Gen.OneOf(Gen.Elements(1, SnapshotChunkDatagram.MaxData), Gen.Choose(1, SnapshotChunkDatagram.MaxData))
        from fill in Byte
        select AnyDatagram.ChunkBytes(session, index, Enumerable.Repeat(fill, length).ToArray());

    internal static readonly Gen<JoinDatagram> Join =
        from nonce in Bits64
        from cookie in Token
        from proof in Token
        from scene in Bits64
        from fold in Bits32
        from player in Byte
        from playerProof in Token
        from role in Gen.Choose(1, 3)
        from name in Name
        select new JoinDatagram(nonce, cookie, proof, scene, fold, player, player == 0 ? default : playerProof, (byte)role, name);

    internal static readonly Gen<SeatDatagram> Seat =
        from session in Bits64
        from peer in Gen.Choose(1, 255)
        from sequence in Bits32
        from pass in Token
        from earliest in OptionalTime
        from promise in Gen.Choose(1, ushort.MaxValue)
        from seconds in Gen.Choose(1, byte.MaxValue)
        select earliest == SimTime.MinValue
            ? new SeatDatagram(session, (byte)peer, sequence, pass)
            : new SeatDatagram(session, (byte)peer, sequence, pass, earliest, (ushort)promise, (byte)seconds);

    internal static readonly Gen<RosterEntry> RosterEntry =
        from number in Byte
        from role in Gen.Choose(0, Net.Wire.RosterEntry.MaxRole)
        from visit in Bits32
        from silent in OptionalTime
        from name in Name
        select role == 0 ? new RosterEntry(number) : new RosterEntry(number, (byte)role, visit, silent, name);

    internal static readonly Gen<RosterDatagram> Roster =
        from session in Bits64
        from after in Gen.Choose(0, 1000)
        from more in Gen.Choose(1, 1000)
        from rest in Gen.Choose(0, 1000)
        from count in Gen.Choose(1, 20)
        from entries in Gen.ArrayOf(RosterEntry, count)
        select Fill(
            new RosterDatagram { SessionId = session, After = (uint)after, UpTo = (uint)(after + more), Newest = (uint)(after + more + rest) }, entries);

    internal static readonly Gen<RosterReceivedDatagram> RosterReceived =
        from session in Bits64 from peer in Byte from revision in Bits32 select new RosterReceivedDatagram(session, peer, revision);

    internal static readonly Gen<MoveDatagram> Move =
        from session in Bits64 from peer in Byte from cookie in Token select new MoveDatagram(session, peer, cookie);

    internal static readonly Gen<WelcomeDatagram> Welcome =
        from nonce in Bits64
        from session in Bits64
        from history in Gen.OneOf(Gen.Elements(1L, WireFormat.MaxTimeTicks), Bits64.Select(bits => (long)(bits >> 2)).Where(t => t > 0))
        from more in Gen.OneOf(Gen.Elements(0L, WireFormat.MaxTimeTicks - history), Bits64.Select(bits => (long)(bits % (ulong)(WireFormat.MaxTimeTicks - history + 1))))
        from length in Gen.OneOf(Gen.Elements(1, SessionSnapshot.MaxBytes), Gen.Choose(1, SessionSnapshot.MaxBytes))
        from hash in Bits64
        from index in Bits32
        select new WelcomeDatagram(nonce, session, SimDuration.FromTicks(history), SimDuration.FromTicks(history + more), length, hash, index);

    internal static readonly Gen<RefusalDatagram> Refusal =
        from nonce in Bits64 from reason in Gen.Choose(1, 8) select new RefusalDatagram(nonce, (RefusalReason)reason);

    internal static readonly Gen<LeaveDatagram> Leave =
        from session in Bits64
        from peer in Byte
        from reason in Gen.Choose(1, 10)
        from sentence in Gen.Elements("", "The world ended at 3 s.", "\U0001F3D2 \u00E4\n\uD800", new string('\u20AC', 400))
        select new LeaveDatagram(session, peer, (LeaveReason)reason, sentence);

    internal static readonly Gen<UpdateDatagram> Update =
        from session in Bits64
        from peer in Byte
        from number in Bits32
        from sent in Time
        from echo in Bits32
        from echoBits in Bits32
        from echoReceived in Time
        from start in OptionalTime
        from watermark in OptionalTime
        from received in Bits32
        from flags in Gen.Choose(0, 3)
        from hashes in Gen.Choose(0, UpdateDatagram.MaxHashes)
        from hashTime in Time
        from hash in Bits64
        from first in Bits32.Select(value => Math.Min(value, uint.MaxValue - UpdateDatagram.MaxEntries))
        from count in Gen.Choose(0, 60)
        from events in Gen.ArrayOf(Event, count)
        from verdict in Gen.Choose(0, 6)
        from own in Gen.Choose(0, 100)
        select Fill(
            new UpdateDatagram
            {
                SessionId = session,
                Peer = peer,
                Number = number,
                Sent = sent,
                EchoNumber = echo,
                EchoBits = echo == 0 ? 0 : echoBits,
                EchoReceived = echo == 0 ? SimTime.MinValue : echoReceived,
                Start = start,
                Watermark = watermark,
                EventsReceived = received,
                Ready = (flags & 2) != 0,
                FirstIndex = first,
            },
            hashTime,
            hash,
            hashes,
            events,
            (Verdict)verdict,
            own);

    private static RosterDatagram Fill(RosterDatagram roster, RosterEntry[] entries)
    {
        foreach (RosterEntry entry in entries)
        {
            roster.TryAdd(entry);
        }

        return roster;
    }

    private static UpdateDatagram Fill(UpdateDatagram update, SimTime hashTime, ulong hash, int hashes, ExternalEvent[] events, Verdict verdict, int own)
    {
        for (uint n = 0; n < hashes; n++)
        {
            update.TryAddHash(hashTime, hash + n);
        }

        foreach (ExternalEvent what in events)
        {
            if (!(what.Sequence % 101 < own ? update.TryAddOwn(verdict, what.Sequence) : update.TryAdd(verdict, what)))
            {
                break;
            }
        }

        return update;
    }
}
