using System;
using System.Diagnostics.CodeAnalysis;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Wire;

/// <summary>How a <see cref="WorldSnapshot"/> is encoded, on the wire and in files: exact to the bit.</summary>
/// <remarks>
/// Pure functions, safe on any thread. A decoded snapshot is well formed; whether it is a world of a scene is checked by
/// <see cref="Simulation(Scene, WorldSnapshot, SimulationOptions)"/>. The layout is in <c>docs/WIRE.md</c>.
/// </remarks>
internal static class SnapshotFormat
{
    private const int HeadBytes = 32; // start, time, event hash, length of the rules' state, count
    private const int MinBodyBytes = 133 + EventFormat.SpecBytes; // without supports, dense output, contacts and hold
    private const int DenseBytes = 72;
    private const int SpinBytes = 48; // spin and its rate
    private const byte TurnsFlag = 1;
    private const byte FilterFlag = 2;
    private const byte PlayersFlag = 4;
    private const byte SensorsFlag = 8;
    private const byte HoldsFlag = 1; // of a contact
    private const byte SolvedFlag = 3; // and holds
    private const int HoldBytes = 57; // cubic, peer, offset, keyframe
    private const int MemberBytes = 18; // centre, still since, number of contacts
    private const int SideBytes = 4; // two counts
    private const int CrossingBytes = 15; // time, round, sensor, whether it entered
    private const int ContactBytes = 61; // partner, surface, whether it holds and is solved, push, turn

    /// <summary>Encodes a snapshot.</summary>
    /// <exception cref="ArgumentException">
    /// A body has a number that is not finite, a negative support, a contact with a surface below
    /// <see cref="PersistentContact.NoSurface"/>, or more than 65,535 contacts, none of which a world has; or the encoding takes 2 GiB or
    /// more.
    /// </exception>
    public static byte[] Encode(WorldSnapshot snapshot)
    {
        long length = EncodedLength(snapshot ?? throw new ArgumentNullException(nameof(snapshot)));
        if (length > int.MaxValue)
        {
            throw new ArgumentException($"The snapshot takes {length} bytes; at most {int.MaxValue} can be written.", nameof(snapshot));
        }

        byte[] bytes = new byte[length];
        WireWriter writer = new(bytes);
        writer.WriteInt64(snapshot.Start.Ticks);
        writer.WriteInt64(snapshot.Time.Ticks);
        writer.WriteUInt64(snapshot.EventHash);
        writer.WriteUInt32((uint)snapshot.RuleState.Length);
        writer.WriteBytes(snapshot.RuleState);
        writer.WriteUInt32((uint)snapshot.Bodies.Count);
        foreach (BodySnapshot body in snapshot.Bodies)
        {
            Write(ref writer, body);
        }

        return bytes;
    }

    /// <summary>Reads a snapshot; never throws, and takes memory only for bodies whose bytes are there.</summary>
    /// <param name="bytes">The whole encoding.</param>
    /// <param name="snapshot">The snapshot, if the bytes are one.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> bytes, [NotNullWhen(true)] out WorldSnapshot? snapshot, out WireRefusal refusal)
    {
        WireReader reader = new(bytes, int.MaxValue);
        SimTime start = SimTime.FromTicks(reader.ReadInt64());
        SimTime time = SimTime.FromTicks(reader.ReadInt64());
        ulong hash = reader.ReadUInt64();
        uint length = reader.ReadUInt32();
        reader.Require(length <= reader.Remaining, WireRefusal.TooShort);
        byte[] ruleState = reader.Refusal == WireRefusal.None ? reader.ReadBytes((int)length).ToArray() : Array.Empty<byte>();
        uint count = reader.ReadUInt32();
        reader.Require(count <= bytes.Length / MinBodyBytes, WireRefusal.TooShort);
        BodySnapshot[] bodies = reader.Refusal == WireRefusal.None ? new BodySnapshot[count] : Array.Empty<BodySnapshot>();
        for (int i = 0; i < bodies.Length && reader.Refusal == WireRefusal.None; i++)
        {
            bodies[i] = Read(ref reader);
        }

        bool accepted = reader.Finish(out refusal);
        snapshot = accepted ? new WorldSnapshot(start, time, hash, bodies, ruleState) : null;
        return accepted;
    }

    /// <summary>Whether a snapshot's times can be encoded, and are of a world that has begun.</summary>
    internal static bool IsInRange(WorldSnapshot snapshot) =>
        WireFormat.IsInRange(snapshot.Start) && WireFormat.IsInRange(snapshot.Time) && snapshot.Time > snapshot.Start;

    /// <summary>The encoded length of a snapshot, in bytes.</summary>
    internal static long EncodedLength(WorldSnapshot snapshot)
    {
        long length = HeadBytes + snapshot.RuleState.Length;
        foreach (BodySnapshot body in snapshot.Bodies)
        {
            int more = body.Law switch
            {
                MotionLaw.RungeKutta4 or MotionLaw.ClosedForm => DenseBytes,
                MotionLaw.DormandPrince54 => DenseBytes + sizeof(long),
                MotionLaw.Held => HoldBytes + HandFormat.Length(body.Hold),
                _ => 0,
            };
            length += MinBodyBytes + (body.SupportCount * sizeof(uint)) + more + (Turns(body) ? SpinBytes : 0) + (HasOtherFilter(body) ? EventFormat.FilterBytes : 0)
                + (body.Players != PeerSet.Everyone ? EventFormat.PlayersBytes : 0)
                + (IsMember(body.Law, body.SupportCount) ? MemberBytes + (body.Contacts.Length * ContactBytes) : 0)
                + (IsOfSensors(body) ? SideBytes + (body.Inside.Length * sizeof(ushort)) + (body.Crossings.Length * CrossingBytes) : 0);
        }

        return length;
    }

    private static void Write(ref WireWriter writer, in BodySnapshot body)
    {
        if (body.Crossings.Length > ushort.MaxValue || body.Inside.Length > SceneBuilder.MaxSensors)
        {
            throw new ArgumentException(
                $"Body {body.Id} cannot travel: it is inside of {body.Inside.Length} sensors and has {body.Crossings.Length} crossings;"
                + $" {SceneBuilder.MaxSensors} and 65535 have room.");
        }

        if (body.Contacts.Length > ushort.MaxValue)
        {
            throw new ArgumentException($"Body {body.Id} cannot travel: it has {body.Contacts.Length} contacts, and 65535 have room.");
        }

        writer.WriteUInt64(body.Id.Packed);
        EventFormat.WriteSpec(ref writer, body.Spec);
        writer.WriteInt64(body.Opened.Time.Ticks);
        writer.WriteUInt32(body.Opened.Round);
        writer.WriteByte((byte)body.Opened.Kind);
        writer.WriteUInt64(body.Opened.Body.Packed);
        writer.WriteUInt64(body.Opened.Other.Packed);
        writer.WriteByte(body.Opened.Peer);
        writer.WriteUInt32(body.Opened.Sequence);
        writer.WriteByte((byte)body.Law);
        writer.WriteInt64(body.Epoch.Ticks);
        writer.WriteInt64(body.End.Ticks);
        WriteExactly(ref writer, body.Position);
        WriteExactly(ref writer, body.Velocity);
        WriteExactly(ref writer, body.Acceleration);
        if (body.Law == MotionLaw.Held)
        {
            WriteExactly(ref writer, body.Cubic);
            writer.WriteByte(body.Hold.Peer);
            WriteExactly(ref writer, body.Hold.Offset);
            writer.WriteInt64(body.Hold.KeyframeTime.Ticks);
        }

        writer.WriteByte((byte)body.SupportCount);
        for (int n = 0; n < body.SupportCount; n++)
        {
            int plane = body.Support(n);
            writer.WriteUInt32(plane >= 0 ? (uint)plane : throw new ArgumentException($"Body {body.Id} cannot travel: plane {plane} carries it."));
        }

        if (IsDense(body.Law))
        {
            WriteExactly(ref writer, body.Cubic);
            WriteExactly(ref writer, body.Quartic);
            WriteExactly(ref writer, body.Quintic);
        }

        if (body.Law == MotionLaw.DormandPrince54)
        {
            writer.WriteInt64(body.NextStep.Ticks);
        }

        writer.WriteByte((byte)((Turns(body) ? TurnsFlag : 0) | (HasOtherFilter(body) ? FilterFlag : 0) | (body.Players != PeerSet.Everyone ? PlayersFlag : 0)
            | (IsOfSensors(body) ? SensorsFlag : 0) | (body.Law == MotionLaw.Held ? HandFormat.Has(body.Hold) : 0)));
        if (Turns(body))
        {
            WriteExactly(ref writer, body.Spin);
            WriteExactly(ref writer, body.SpinRate);
        }

        if (HasOtherFilter(body))
        {
            EventFormat.WriteFilter(ref writer, body.Filter);
        }

        if (body.Law == MotionLaw.Held)
        {
            HandFormat.Write(ref writer, body.Hold);
        }

        if (body.Players != PeerSet.Everyone)
        {
            writer.WriteUInt32(body.Players.Mask);
        }

        if (IsMember(body.Law, body.SupportCount))
        {
            WriteContacts(ref writer, body);
        }

        if (IsOfSensors(body))
        {
            WriteSensors(ref writer, body);
        }
    }

    private static void WriteSensors(ref WireWriter writer, in BodySnapshot body)
    {
        writer.WriteUInt16((ushort)body.Inside.Length);
        foreach (int sensor in body.Inside.ToArray()) // an array, since a read-only span does not link everywhere
        {
            WriteSensor(ref writer, body, sensor);
        }

        writer.WriteUInt16((ushort)body.Crossings.Length);
        foreach (Crossing crossing in body.Crossings.ToArray())
        {
            if (crossing.Body != body.Id || crossing.Key.Other != body.Id || crossing.Key.Peer != 0)
            {
                throw new ArgumentException($"Body {body.Id} cannot travel: among its crossings is {crossing.Key}.");
            }

            writer.WriteInt64(crossing.Time.Ticks);
            writer.WriteUInt32(crossing.Key.Round);
            WriteSensor(ref writer, body, crossing.Sensor);
            writer.WriteByte(crossing.Entered ? (byte)1 : (byte)0);
        }
    }

    private static void WriteSensor(ref WireWriter writer, in BodySnapshot body, int sensor)
    {
        writer.WriteUInt16(sensor is >= 0 and < SceneBuilder.MaxSensors ? (ushort)sensor
            : throw new ArgumentException($"Body {body.Id} cannot travel: it is told of sensor {sensor}."));
    }

    private static int[] ReadInside(ref WireReader reader)
    {
        int count = reader.ReadUInt16();
        reader.Require(count * sizeof(ushort) <= reader.Remaining, WireRefusal.TooShort);
        int[] inside = reader.Refusal == WireRefusal.None ? new int[count] : Array.Empty<int>();
        for (int i = 0; i < inside.Length; i++)
        {
            inside[i] = ReadSensor(ref reader);
        }

        return inside;
    }

    private static Crossing[] ReadCrossings(ref WireReader reader, BodyId body)
    {
        int count = reader.ReadUInt16();
        reader.Require(count * CrossingBytes <= reader.Remaining, WireRefusal.TooShort);
        Crossing[] crossings = reader.Refusal == WireRefusal.None ? new Crossing[count] : Array.Empty<Crossing>();
        for (int i = 0; i < crossings.Length; i++)
        {
            SimTime time = SimTime.FromTicks(reader.ReadInt64());
            uint round = reader.ReadUInt32();
            int sensor = ReadSensor(ref reader);
            byte entered = reader.ReadByte();
            reader.Require(entered <= 1);
            crossings[i] = new Crossing(new EventKey(time, round, EventKind.Crossing, body, body, 0, (uint)sensor), entered == 1);
        }

        return crossings;
    }

    private static int ReadSensor(ref WireReader reader)
    {
        int sensor = reader.ReadUInt16();
        reader.Require(sensor < SceneBuilder.MaxSensors);
        return sensor;
    }

    private static void WriteContacts(ref WireWriter writer, in BodySnapshot body)
    {
        writer.WriteInt64(body.Centre.Ticks);
        writer.WriteInt64(body.StillSince.Ticks);
        writer.WriteUInt16((ushort)body.Contacts.Length);
        foreach (PersistentContact contact in body.Contacts.ToArray()) // an array, since a read-only span does not link everywhere
        {
            writer.WriteUInt64(contact.Partner.Packed);
            writer.WriteUInt32(contact.Surface >= PersistentContact.NoSurface ? unchecked((uint)contact.Surface)
                : throw new ArgumentException($"Body {body.Id} cannot travel: it has a contact with surface {contact.Surface}."));
            writer.WriteByte(!contact.Solved ? contact.Holds ? HoldsFlag : (byte)0
                : contact.Holds && contact.Surface != PersistentContact.NoSurface ? SolvedFlag
                : throw new ArgumentException($"Body {body.Id} cannot travel: it has a solved contact that is none with a surface that holds."));
            WriteExactly(ref writer, contact.Push);
            WriteExactly(ref writer, contact.Turn);
        }
    }

    private static PersistentContact[] ReadContacts(ref WireReader reader, out SimTime centre, out SimTime stillSince)
    {
        centre = SimTime.FromTicks(reader.ReadInt64());
        stillSince = SimTime.FromTicks(reader.ReadInt64());
        int count = reader.ReadUInt16();
        reader.Require(count * ContactBytes <= reader.Remaining, WireRefusal.TooShort);
        PersistentContact[] contacts = reader.Refusal == WireRefusal.None ? new PersistentContact[count] : Array.Empty<PersistentContact>();
        for (int i = 0; i < contacts.Length; i++)
        {
            BodyId partner = BodyId.FromPacked(reader.ReadUInt64());
            int surface = unchecked((int)reader.ReadUInt32());
            byte holds = reader.ReadByte();
            bool solved = holds == SolvedFlag;
            reader.Require(surface >= PersistentContact.NoSurface && (holds <= HoldsFlag || (solved && surface != PersistentContact.NoSurface)));
            contacts[i] = new PersistentContact(partner, surface, holds != 0, ReadExactly(ref reader), ReadExactly(ref reader), solved);
        }

        return contacts;
    }

    /// <summary>Whether a body with that law belongs to an island: it is stepped, or rests and no plane alone supports it.</summary>
    private static bool IsMember(MotionLaw law, int supports) => law == MotionLaw.Constrained || (law == MotionLaw.Resting && supports == 0);

    private static bool Turns(in BodySnapshot body) => body.Spin != Vector3D.Zero || body.SpinRate != Vector3D.Zero;

    /// <summary>Whether its filter was changed.</summary>
    private static bool HasOtherFilter(in BodySnapshot body) => body.Filter != body.Spec.Filter;

    private static bool IsOfSensors(in BodySnapshot body) => body.Inside.Length > 0 || body.Crossings.Length > 0;

    private static BodySnapshot Read(ref WireReader reader)
    {
        BodyId id = BodyId.FromPacked(reader.ReadUInt64());
        BodySpec spec = EventFormat.ReadSpec(ref reader);
        SimTime openedAt = SimTime.FromTicks(reader.ReadInt64());
        uint round = reader.ReadUInt32();
        EventKind kind = (EventKind)reader.ReadByte();
        BodyId body = BodyId.FromPacked(reader.ReadUInt64());
        BodyId other = BodyId.FromPacked(reader.ReadUInt64());
        EventKey opened = new(openedAt, round, kind, body, other, reader.ReadByte(), reader.ReadUInt32());
        MotionLaw law = (MotionLaw)reader.ReadByte();
        SimTime epoch = SimTime.FromTicks(reader.ReadInt64());
        SimTime end = SimTime.FromTicks(reader.ReadInt64());
        Vector3D position = ReadExactly(ref reader);
        Vector3D velocity = ReadExactly(ref reader);
        Vector3D acceleration = ReadExactly(ref reader);
        bool held = law == MotionLaw.Held;
        Vector3D cubic = held ? ReadExactly(ref reader) : default;
        byte holder = held ? reader.ReadByte() : (byte)0;
        Vector3D offset = held ? ReadExactly(ref reader) : default;
        Hold hold = held ? new Hold(holder, offset, SimTime.FromTicks(reader.ReadInt64())) : default;
        int supports = reader.ReadByte();
        reader.Require(supports <= BodySnapshot.MaxSupports);
        supports = Math.Min(supports, BodySnapshot.MaxSupports);
        Span<int> planes = stackalloc int[BodySnapshot.MaxSupports];
        for (int n = 0; n < supports; n++)
        {
            uint plane = reader.ReadUInt32();
            reader.Require(plane <= int.MaxValue);
            planes[n] = (int)plane;
        }

        bool dense = IsDense(law);
        cubic = dense ? ReadExactly(ref reader) : cubic;
        Vector3D quartic = dense ? ReadExactly(ref reader) : default;
        Vector3D quintic = dense ? ReadExactly(ref reader) : default;
        SimDuration nextStep = law == MotionLaw.DormandPrince54 ? SimDuration.FromTicks(reader.ReadInt64()) : SimDuration.Zero;
        byte has = reader.ReadByte();
        bool turns = (has & TurnsFlag) != 0;
        bool hasOtherFilter = (has & FilterFlag) != 0;
        reader.Require(has <= (TurnsFlag | FilterFlag | PlayersFlag | SensorsFlag) || (held && has <= HandFormat.MaxHas));
        Vector3D spin = turns ? ReadExactly(ref reader) : default;
        Vector3D spinRate = turns ? ReadExactly(ref reader) : default;
        CollisionFilter filter = hasOtherFilter ? EventFormat.ReadFilter(ref reader) : spec.Filter;
        reader.Require(hasOtherFilter == (filter != spec.Filter));
        hold = held ? HandFormat.Read(ref reader, hold, has) : hold;
        PeerSet players = (has & PlayersFlag) != 0 ? EventFormat.ReadPeers(ref reader) : default;
        reader.Require((has & PlayersFlag) != 0 == (players != PeerSet.Everyone));
        reader.Require(!turns || spin != Vector3D.Zero || spinRate != Vector3D.Zero); // exactly one encoding
        SimTime centre = default;
        SimTime stillSince = default;
        PersistentContact[] contacts = IsMember(law, supports) ? ReadContacts(ref reader, out centre, out stillSince) : Array.Empty<PersistentContact>();
        bool isOfSensors = (has & SensorsFlag) != 0;
        int[] inside = isOfSensors ? ReadInside(ref reader) : Array.Empty<int>();
        Crossing[] crossings = isOfSensors ? ReadCrossings(ref reader, id) : Array.Empty<Crossing>();
        reader.Require(!isOfSensors || inside.Length + crossings.Length > 0); // exactly one encoding
        return new BodySnapshot(
            id, spec, opened, law, epoch, end, position, velocity, acceleration, planes.Slice(0, supports), cubic, quartic, quintic, hold, nextStep,
            spin, spinRate, centre, stillSince, contacts, filter, inside, crossings, players);
    }

    /// <summary>Whether a path with that flight law has more than a parabola's coefficients.</summary>
    private static bool IsDense(MotionLaw law) => law is MotionLaw.RungeKutta4 or MotionLaw.ClosedForm or MotionLaw.DormandPrince54;

    // Keeps the sign of zeros too, since the simulation continues from the very bits.
    private static void WriteExactly(ref WireWriter writer, in Vector3D value)
    {
        if (!value.IsFinite)
        {
            throw new ArgumentException($"{value} cannot travel: only finite numbers can.");
        }

        writer.WriteInt64(BitConverter.DoubleToInt64Bits(value.X));
        writer.WriteInt64(BitConverter.DoubleToInt64Bits(value.Y));
        writer.WriteInt64(BitConverter.DoubleToInt64Bits(value.Z));
    }

    private static Vector3D ReadExactly(ref WireReader reader)
    {
        Vector3D value = new(
            BitConverter.Int64BitsToDouble(reader.ReadInt64()),
            BitConverter.Int64BitsToDouble(reader.ReadInt64()),
            BitConverter.Int64BitsToDouble(reader.ReadInt64()));
        reader.Require(value.IsFinite);
        return value;
    }
}
