using System;
using System.Text;
using LagSim.Events;
using LagSim.Net.Protection;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>How an external event is encoded, and which events can be.</summary>
/// <remarks>Pure functions, safe on any thread, without allocation but for what rules are told.</remarks>
internal static class EventFormat
{
    /// <summary>The length of the longest event, a spawn, in bytes.</summary>
    public const int MaxBytes = PlainSpawnBytes + PlayersBytes + FilterBytes + TagBytes;

    /// <summary>The length of the shortest event, a command without bytes.</summary>
    public const int MinBytes = HeadBytes + CommandHeadBytes;

    /// <summary>The shortest step of an integrating law that can be encoded: 1 microsecond, to the nearest tick.</summary>
    public static readonly SimDuration MinStep = SimDuration.FromSeconds(1e-6);

    /// <summary>The longest step of an integrating law that can be encoded: 1 s.</summary>
    public static readonly SimDuration MaxStep = SimDuration.FromSeconds(1);

    private const int HeadBytes = 14; // kind, peer, sequence, time
    private const int BodyBytes = 8;
    private const int CommandHeadBytes = 3; // number, length
    private const int PlayerHeadBytes = 12; // what happened, number, role, identity, length of the name
    private const int BodyEventBytes = HeadBytes + BodyBytes;
    internal const int VectorBytes = 24;
    internal const int FilterBytes = 8;
    internal const int PlayersBytes = 4;
    internal const int SpecBytes = SpecHeadBytes + FilterBytes + TagBytes;
    private const int SpecHeadBytes = 61;
    private const int TagBytes = sizeof(ulong);
    private const int PlainSpawnBytes = HeadBytes + SpecHeadBytes + (3 * VectorBytes) + 1; // everyone's, without a filter and a tag
    private const int OccupiedShift = 6; // the two highest bits of the kind: what becomes of what is put where another body is
    private const int KindBits = (1 << OccupiedShift) - 1;
    private const int StrengthBytes = 2 * sizeof(double);
    private const int HasStrength = 1; // in the two highest bits of a grab's kind, which places nothing

    // What a spawn has, so that a plain one stays short.
    private const int PlayersFlag = 1;
    private const int FilterFlag = 2;
    private const int TagFlag = 4;

    /// <summary>The length of an event in bytes; 0 for a kind that cannot be encoded.</summary>
    public static int EncodedLength(in ExternalEvent what)
    {
        if (what.Command is GameCommand command)
        {
            return MinBytes + command.Length;
        }

        if (what.PlayerEvent is PlayerEvent player)
        {
            return HeadBytes + PlayerHeadBytes + Encoding.UTF8.GetByteCount(player.Name);
        }

        int has = what.Kind == EventKind.Spawn ? Has(what) : 0;
        return ShortestLength(what.Kind) + ((has & PlayersFlag) != 0 ? PlayersBytes : 0) + ((has & FilterFlag) != 0 ? FilterBytes : 0)
            + ((has & TagFlag) != 0 ? TagBytes : 0) + (SaysStrength(what) ? StrengthBytes : 0);
    }

    private static int ShortestLength(EventKind kind) => kind switch
    {
        EventKind.Spawn => PlainSpawnBytes,
        EventKind.Remove => BodyEventBytes,
        EventKind.SetFilter => BodyEventBytes + FilterBytes,
        EventKind.Teleport or EventKind.HoldKeyframe => BodyEventBytes + (2 * VectorBytes),
        EventKind.SetVelocity or EventKind.Impulse or EventKind.Grab or EventKind.Release => BodyEventBytes + VectorBytes,
        _ => 0,
    };

    /// <summary>
    /// Whether an event can be encoded: a kind that can, a sequence of at least 1, a time within <see cref="WireFormat.MaxTimeTicks"/>,
    /// finite numbers, and for a spawn a <see cref="BodySpec"/> within its documented ranges. Every decoded event is well formed.
    /// </summary>
    public static bool IsWellFormed(in ExternalEvent what) =>
        (ShortestLength(what.Kind) > 0 || what.Command is not null || (what.PlayerEvent is PlayerEvent player && PlayerName.WhyNone(player.Name) is null))
        && what.Sequence >= 1
        && WireFormat.IsInRange(what.Time)
        && what.Position.IsFinite
        && what.Velocity.IsFinite
        && what.Spin.IsFinite
        && what.WhenOccupied <= WhenOccupied.Beside
        && what.MaxForce is >= 0 and <= double.MaxValue
        && what.MaxPower is >= 0 and <= double.MaxValue
        && (what.Kind != EventKind.Spawn || IsSpecWellFormed(what.Spec));

    /// <summary>Writes an event; every -0.0 becomes 0.0.</summary>
    /// <exception cref="ArgumentException">The event is not <see cref="IsWellFormed"/>, or there is no room.</exception>
    public static void Write(ref WireWriter writer, in ExternalEvent what)
    {
        if (!IsWellFormed(what))
        {
            throw new ArgumentException($"'{what}' cannot travel: its kind, sequence, time or a number in it is out of range.", nameof(what));
        }

        writer.WriteByte((byte)((int)what.Kind | ((SaysStrength(what) ? HasStrength : (int)what.WhenOccupied) << OccupiedShift)));
        writer.WriteByte(what.Peer);
        writer.WriteUInt32(what.Sequence);
        writer.WriteTime(what.Time);
        if (what.Command is GameCommand command)
        {
            Write(ref writer, command);
            return;
        }

        if (what.PlayerEvent is PlayerEvent player)
        {
            Write(ref writer, player);
            return;
        }

        if (what.Kind == EventKind.Spawn)
        {
            WriteSpecHead(ref writer, what.Spec);
        }
        else
        {
            writer.WriteUInt64(what.Body.Packed);
        }

        if (HasPosition(what.Kind))
        {
            writer.WriteVector(what.Position);
        }

        if (HasVelocity(what.Kind))
        {
            writer.WriteVector(what.Velocity);
        }

        if (what.Kind == EventKind.Spawn)
        {
            writer.WriteVector(what.Spin);
            WriteWhatItHas(ref writer, what);
        }

        if (what.Kind == EventKind.SetFilter)
        {
            WriteFilter(ref writer, what.Filter);
        }

        if (SaysStrength(what))
        {
            writer.WriteDouble(what.MaxForce);
            writer.WriteDouble(what.MaxPower);
        }
    }

    /// <summary>Whether a grab says how strong the hand is.</summary>
    private static bool SaysStrength(in ExternalEvent what) => what.MaxForce != 0 || what.MaxPower != 0;

    /// <summary>Reads an event; the reader refuses one that is not well formed. Never throws.</summary>
    /// <returns>The event; <c>default</c> when the reader has refused.</returns>
    public static ExternalEvent Read(ref WireReader reader)
    {
        int first = reader.ReadByte();
        EventKind kind = (EventKind)(first & KindBits);
        bool saysStrength = kind == EventKind.Grab && first >> OccupiedShift == HasStrength;
        WhenOccupied whenOccupied = saysStrength ? WhenOccupied.Overlap : (WhenOccupied)(first >> OccupiedShift);
        reader.Require((ShortestLength(kind) > 0 || kind is EventKind.Command or EventKind.Player)
            && (whenOccupied == WhenOccupied.Overlap || kind is EventKind.Spawn or EventKind.Teleport));
        byte peer = reader.ReadByte();
        uint sequence = reader.ReadUInt32();
        SimTime time = reader.ReadTime();
        if (kind == EventKind.Command)
        {
            return ReadCommand(ref reader, time, peer, sequence);
        }

        if (kind == EventKind.Player)
        {
            reader.Require(peer == 0); // only the host says so
            return ReadPlayer(ref reader, time, sequence);
        }

        BodySpec spec = kind == EventKind.Spawn ? ReadSpecHead(ref reader) : default;
        BodyId body = kind == EventKind.Spawn ? default : BodyId.FromPacked(reader.ReadUInt64());
        Vector3D position = HasPosition(kind) ? reader.ReadVector() : default;
        Vector3D velocity = HasVelocity(kind) ? reader.ReadVector() : default;
        Vector3D spin = kind == EventKind.Spawn ? reader.ReadVector() : default;
        PeerSet players = default;
        if (kind == EventKind.Spawn)
        {
            ReadWhatItHas(ref reader, ref spec, out players);
        }

        CollisionFilter filter = kind == EventKind.SetFilter ? ReadFilter(ref reader) : default;
        double maxForce = saysStrength ? reader.ReadDouble() : 0;
        double maxPower = saysStrength ? reader.ReadDouble() : 0;
        reader.Require(!saysStrength || maxForce != 0 || maxPower != 0); // exactly one encoding
        PlayerAction action = kind switch
        {
            EventKind.Spawn => PlayerAction.Spawn(spec, position, velocity, spin, players, whenOccupied),
            EventKind.Teleport => PlayerAction.Teleport(body, position, velocity, whenOccupied),
            EventKind.SetFilter => PlayerAction.SetFilter(body, filter),
            EventKind.Grab => PlayerAction.Grab(body, position, maxForce, maxPower),
            _ => Action(kind, body, position, velocity),
        };
        ExternalEvent what = action.Kind == EventKind.None ? default : action.Stamp(time, peer, sequence);
        reader.Require(IsWellFormed(what));
        return reader.Refusal == WireRefusal.None ? what : default;
    }

    /// <summary>Reads a set of peers; bits of peers that cannot be named are refused.</summary>
    internal static PeerSet ReadPeers(ref WireReader reader)
    {
        uint mask = reader.ReadUInt32();
        reader.Require(mask <= PeerSet.Everyone.Mask);
        return PeerSet.FromMask(mask);
    }

    private static void Write(ref WireWriter writer, GameCommand command)
    {
        writer.WriteUInt16((ushort)command.Number);
        writer.WriteByte((byte)command.Length);
        writer.WriteBytes(command.Data);
    }

    private static ExternalEvent ReadCommand(ref WireReader reader, SimTime time, byte peer, uint sequence)
    {
        int number = reader.ReadUInt16();
        int length = reader.ReadByte();
        reader.Require(length <= GameCommand.MaxBytes && sequence >= 1 && WireFormat.IsInRange(time));
        ReadOnlySpan<byte> data = reader.ReadBytes(Math.Min(length, GameCommand.MaxBytes));
        return reader.Refusal == WireRefusal.None ? PlayerAction.Command(new GameCommand(number, data)).Stamp(time, peer, sequence) : default;
    }

    private static void Write(ref WireWriter writer, PlayerEvent player)
    {
        writer.WriteByte((byte)player.Kind);
        writer.WriteByte(player.Number);
        writer.WriteByte((byte)player.Role);
        writer.WriteUInt64(player.Identity);
        WireText.Write(ref writer, player.Name);
    }

    private static ExternalEvent ReadPlayer(ref WireReader reader, SimTime time, uint sequence)
    {
        PlayerEventKind kind = (PlayerEventKind)reader.ReadByte();
        byte number = reader.ReadByte();
        PeerRole role = (PeerRole)reader.ReadByte();
        ulong identity = reader.ReadUInt64();
        string name = RosterEntry.ReadName(ref reader);
        reader.Require(kind is >= PlayerEventKind.Joined and <= PlayerEventKind.Left && number <= PlayerEvent.MaxNumber
            && role is >= PeerRole.Player and <= PeerRole.Bot && identity != 0 && sequence >= 1 && WireFormat.IsInRange(time));
        return reader.Refusal == WireRefusal.None ? new PlayerEvent(kind, number, identity, name, role).Stamp(time, sequence) : default;
    }

    private static PlayerAction Action(
        EventKind kind, BodyId body, in Vector3D position, in Vector3D velocity) => kind switch
        {
            EventKind.Remove => PlayerAction.Remove(body),
            EventKind.SetVelocity => PlayerAction.SetVelocity(body, velocity),
            EventKind.Impulse => PlayerAction.Impulse(body, velocity),
            EventKind.HoldKeyframe => PlayerAction.HoldKeyframe(body, position, velocity),
            EventKind.Release => PlayerAction.Release(body, velocity),
            _ => default,
        };

    private static bool HasPosition(EventKind kind) => kind is EventKind.Spawn or EventKind.Teleport or EventKind.Grab or EventKind.HoldKeyframe;

    private static bool HasVelocity(EventKind kind) => kind is not (EventKind.Remove or EventKind.Grab or EventKind.SetFilter);

    // Every range is written so that NaN fails it.
    private static bool IsSpecWellFormed(in BodySpec spec) =>
        spec.Radius is >= 1e-9 and <= 1e9
        && spec.Mass is >= 1e-30 and <= 1e30
        && spec.Restitution is >= 0 and <= 1
        && spec.Flight is MotionLaw.Ballistic or MotionLaw.RungeKutta4 or MotionLaw.ClosedForm or MotionLaw.DormandPrince54 or MotionLaw.Automatic
        && spec.Step >= MinStep
        && spec.Step <= MaxStep
        && spec.Tolerance is >= 0 and <= 1
        && spec.Friction is >= 0 and <= 100
        && spec.RollingResistance is >= 0 and <= 1
        && (spec.Forces.IsEmpty || spec.Flight != MotionLaw.Ballistic);

    private static int Has(in ExternalEvent spawn) => (spawn.Players != PeerSet.Everyone ? PlayersFlag : 0)
        | (!spawn.Spec.Filter.IsDefault ? FilterFlag : 0) | (spawn.Spec.Tag != 0 ? TagFlag : 0);

    private static void WriteWhatItHas(ref WireWriter writer, in ExternalEvent spawn)
    {
        int has = Has(spawn);
        writer.WriteByte((byte)has);
        if ((has & PlayersFlag) != 0)
        {
            writer.WriteUInt32(spawn.Players.Mask);
        }

        if ((has & FilterFlag) != 0)
        {
            WriteFilter(ref writer, spawn.Spec.Filter);
        }

        if ((has & TagFlag) != 0)
        {
            writer.WriteUInt64(spawn.Spec.Tag);
        }
    }

    private static void ReadWhatItHas(ref WireReader reader, ref BodySpec spec, out PeerSet players)
    {
        int has = reader.ReadByte();
        reader.Require(has < 2 * TagFlag);
        players = (has & PlayersFlag) != 0 ? ReadPeers(ref reader) : default;
        CollisionFilter filter = (has & FilterFlag) != 0 ? ReadFilter(ref reader) : default;
        ulong tag = (has & TagFlag) != 0 ? reader.ReadUInt64() : 0;
        spec = spec.With(filter).WithTag(tag);

        // Exactly one encoding: what has the default is left out.
        reader.Require((has & PlayersFlag) != 0 == (players != PeerSet.Everyone) && (has & FilterFlag) != 0 == !filter.IsDefault
            && (has & TagFlag) != 0 == (tag != 0));
    }

    internal static void WriteSpec(ref WireWriter writer, in BodySpec spec)
    {
        WriteSpecHead(ref writer, spec);
        WriteFilter(ref writer, spec.Filter);
        writer.WriteUInt64(spec.Tag);
    }

    private static void WriteSpecHead(ref WireWriter writer, in BodySpec spec)
    {
        writer.WriteDouble(spec.Radius);
        writer.WriteDouble(spec.Mass);
        writer.WriteDouble(spec.Restitution);
        writer.WriteByte((byte)spec.Flight);
        writer.WriteInt64(spec.Step.Ticks);
        writer.WriteUInt32(spec.Forces.Mask);
        writer.WriteDouble(spec.Tolerance);
        writer.WriteDouble(spec.Friction);
        writer.WriteDouble(spec.RollingResistance);
    }

    internal static BodySpec ReadSpec(ref WireReader reader) =>
        ReadSpecHead(ref reader).With(ReadFilter(ref reader)).WithTag(reader.ReadUInt64());

    private static BodySpec ReadSpecHead(ref WireReader reader)
    {
        double radius = reader.ReadDouble();
        double mass = reader.ReadDouble();
        double restitution = reader.ReadDouble();
        MotionLaw flight = (MotionLaw)reader.ReadByte();
        long step = reader.ReadInt64();
        reader.Require(step != 0); // the constructor would take it for "the default": one meaning, one encoding
        ForceSet forces = ForceSet.FromMask(reader.ReadUInt32());
        reader.Require(flight != MotionLaw.Automatic || !forces.IsEmpty); // that is Ballistic
        return new BodySpec(
            radius, mass, restitution, flight, SimDuration.FromTicks(step), forces, reader.ReadDouble(), reader.ReadDouble(), reader.ReadDouble());
    }

    internal static void WriteFilter(ref WireWriter writer, CollisionFilter filter)
    {
        writer.WriteUInt32(filter.Category);
        writer.WriteUInt32(filter.Mask);
    }

    internal static CollisionFilter ReadFilter(ref WireReader reader) => new(reader.ReadUInt32(), reader.ReadUInt32());
}
