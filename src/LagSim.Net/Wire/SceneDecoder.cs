using System;
using System.Collections.Generic;
using LagSim.Scenes;

namespace LagSim.Net.Wire;

/// <summary>Decodes a scene from untrusted bytes, part by part, and describes in a sentence what is wrong with them.</summary>
/// <remarks>
/// Everything goes through a <see cref="SceneBuilder"/>, so that the wire lets in nothing that a program could not build itself.
/// </remarks>
internal ref struct SceneDecoder
{
    private readonly SceneCode known;
    private readonly int length;
    private readonly List<Vector3D> normals;
    private readonly List<Vector3D> sensorVectors;
    private readonly List<string> bodyNames;
    private WireReader reader;
    private string? error;

    // The part being read, for the sentence.
    private string part;
    private int number;

    internal SceneDecoder(ReadOnlySpan<byte> bytes, SceneCode known)
    {
        this.known = known;
        length = bytes.Length;
        normals = new List<Vector3D>();
        sensorVectors = new List<Vector3D>();
        bodyNames = new List<string>();
        reader = new WireReader(bytes, SceneFormat.MaxBytes);
        error = null;
        part = "head";
        number = 0;
    }

    private readonly bool IsSound => reader.Refusal == WireRefusal.None;

    internal Scene? Decode(out string? refusal)
    {
        Scene? scene = null;
        try
        {
            scene = Read();
        }
        catch (SceneException refused)
        {
            error = refused.Message;
        }

        refusal = scene is null ? error ?? Sentence() : null;
        return scene;
    }

    private Scene? Read()
    {
        byte version = reader.ReadByte();
        if (IsSound && version != WireFormat.Version)
        {
            Refuse($"The scene is written in version {version} of the wire format; this is version {WireFormat.Version}.");
        }

        SceneBuilder builder = new(WireText.Read(ref reader));
        builder.WithGravity(reader.ReadVector());
        builder.WithRestitutionThreshold(reader.ReadDouble());
        builder.WithContactTolerance(reader.ReadDouble());
        builder.WithSmallestRadius(reader.ReadDouble());
        builder.WithSpawners(EventFormat.ReadPeers(ref reader));
        ReadForces(builder);
        ReadPlanes(builder);
        ReadSpheres(builder);
        ReadBodies(builder);
        ReadSensors(builder);
        ReadRules(builder);
        ReadBox(builder);
        if (!reader.Finish(out _))
        {
            return null;
        }

        Scene scene = builder.Build();
        return IsTheOneForm(scene) ? scene : null;
    }

    private void ReadForces(SceneBuilder builder)
    {
        int count = Begin("force", ForceSet.MaxForces, SceneFormat.ForceBytes);
        while (IsSound && number < count)
        {
            number++;
            if (ReadForce() is Force force)
            {
                builder.AddForce(force);
            }
        }
    }

    private Force? ReadForce()
    {
        string name = WireText.Read(ref reader);
        ForceKind kind = (ForceKind)reader.ReadByte();
        int version = unchecked((int)reader.ReadUInt32());
        double strength = reader.ReadDouble();
        double damping = reader.ReadDouble();
        Vector3D vector = reader.ReadVector();
        int power = unchecked((sbyte)reader.ReadByte());
        if (!IsSound)
        {
            return null;
        }

        if (kind > ForceKind.Magnus)
        {
            Refuse($"Force {number} of the scene is of kind {(byte)kind}; kinds are 0 to {(byte)ForceKind.Magnus}.");
            return null;
        }

        Force? force = kind switch
        {
            ForceKind.LinearDrag => Force.LinearDrag(name, strength, vector),
            ForceKind.QuadraticDrag => Force.QuadraticDrag(name, strength, vector),
            ForceKind.Spring => Force.Spring(name, vector, strength, damping),
            ForceKind.Magnetic => Force.Magnetic(name, vector, strength),
            ForceKind.Magnus => Force.Magnus(name, strength),
            ForceKind.Central => Force.Central(name, vector, strength, power),
            _ => Known(name, version) is IAcceleration known ? Force.Supplied(known) : null,
        };
        bool isPlain = force is null
            || (force.Strength == strength && force.Damping == damping && force.Vector == vector && force.Power == power
                && (version == 0 || kind == ForceKind.Supplied));
        if (!isPlain)
        {
            Refuse($"Force '{name}' of the scene, {kind}, has values that this kind does not use; on the wire they are 0.");
        }

        return force;
    }

    private void ReadPlanes(SceneBuilder builder)
    {
        int count = Begin("plane", SceneFormat.MaxStaticParts, SceneFormat.StaticPartBytes);
        while (IsSound && number < count)
        {
            number++;
            string name = WireText.Read(ref reader);
            Vector3D normal = reader.ReadVector();
            double offset = reader.ReadDouble();
            double restitution = reader.ReadDouble();
            double friction = reader.ReadDouble();
            CollisionFilter filter = EventFormat.ReadFilter(ref reader);
            if (IsSound)
            {
                builder.AddPlane(name, normal, offset, restitution, friction, filter);
                normals.Add(normal);
            }
        }
    }

    private void ReadSpheres(SceneBuilder builder)
    {
        int count = Begin("static sphere", SceneFormat.MaxStaticParts, SceneFormat.StaticPartBytes);
        while (IsSound && number < count)
        {
            number++;
            string name = WireText.Read(ref reader);
            Vector3D centre = reader.ReadVector();
            double radius = reader.ReadDouble();
            double restitution = reader.ReadDouble();
            double friction = reader.ReadDouble();
            CollisionFilter filter = EventFormat.ReadFilter(ref reader);
            if (IsSound)
            {
                builder.AddStaticSphere(name, centre, radius, restitution, friction, filter);
            }
        }
    }

    private void ReadBodies(SceneBuilder builder)
    {
        int count = Begin("body", SceneFormat.MaxBodies, SceneFormat.BodyBytes);
        while (IsSound && number < count)
        {
            number++;
            string name = WireText.Read(ref reader);
            BodySpec spec = EventFormat.ReadSpec(ref reader);
            Vector3D position = reader.ReadVector();
            Vector3D velocity = reader.ReadVector();
            PeerSet players = EventFormat.ReadPeers(ref reader);
            Vector3D spin = reader.ReadVector();
            if (IsSound && spec.Flight == MotionLaw.Automatic)
            {
                Refuse($"Body {number} of the scene leaves its law of flight open; on the wire it is the one that was chosen.");
            }

            if (IsSound)
            {
                builder.AddBody(name, spec, position, velocity, players, spin);
                bodyNames.Add(name);
            }
        }
    }

    private void ReadSensors(SceneBuilder builder)
    {
        int count = Begin("sensor", SceneBuilder.MaxSensors, SceneFormat.SensorBytes);
        while (IsSound && number < count)
        {
            number++;
            string name = WireText.Read(ref reader);
            SensorShape shape = (SensorShape)reader.ReadByte();
            SensorCoverage coverage = (SensorCoverage)reader.ReadByte();
            Vector3D vector = reader.ReadVector();
            double measure = reader.ReadDouble();
            CollisionFilter filter = EventFormat.ReadFilter(ref reader);
            uint carrier = reader.ReadUInt32(); // its number, counted from 1
            if (IsSound && shape > SensorShape.Sphere)
            {
                Refuse($"Sensor {number} of the scene has shape {(byte)shape}; shapes are 0 to {(byte)SensorShape.Sphere}.");
            }

            uint most = shape == SensorShape.Plane ? 0 : (uint)bodyNames.Count;
            if (IsSound && carrier > most)
            {
                Refuse($"Sensor {number} of the scene is carried by body {carrier}; 0 to {most} are allowed, 0 for none.");
            }

            if (IsSound)
            {
                _ = shape == SensorShape.Plane
                    ? builder.AddSensorPlane(name, vector, measure, coverage, filter)
                    : builder.AddSensorSphere(name, vector, measure, coverage, filter, carrier == 0 ? null : bodyNames[(int)carrier - 1]);
                sensorVectors.Add(vector);
            }
        }
    }

    private void ReadRules(SceneBuilder builder)
    {
        if (!IsSound)
        {
            return;
        }

        part = "rules";
        number = 0;
        builder.WithSeed(reader.ReadUInt64());
        byte count = reader.ReadByte();
        if (count > 1)
        {
            Refuse($"The scene announces {count} rules; it has one object of them, or none.");
        }

        if (!IsSound || count == 0)
        {
            return;
        }

        string name = WireText.Read(ref reader);
        int version = unchecked((int)reader.ReadUInt32());
        uint worldBytes = reader.ReadUInt32();
        uint bodyBytes = reader.ReadUInt32();
        if (IsSound && KnownRules(name, version) is SceneRules rules)
        {
            if (SceneFormat.Difference(rules, worldBytes, bodyBytes) is string difference)
            {
                Refuse(difference);
            }

            builder.WithRules(rules);
        }
    }

    private void ReadBox(SceneBuilder builder)
    {
        if (!IsSound || reader.Remaining == 0)
        {
            return;
        }

        part = "periodic box";
        number = 0;
        Vector3D size = reader.ReadVector();
        if (IsSound && size == Vector3D.Zero)
        {
            Refuse("The scene's periodic box has no size; a scene without one ends before it.");
        }

        builder.WithPeriodicBox(size);
    }

    /// <summary>Begins the parts of one kind. More than are allowed, or than the remaining bytes can hold, are refused at once.</summary>
    private int Begin(string what, int most, int minBytes)
    {
        if (!IsSound)
        {
            return 0; // keep the part that was read when it went wrong
        }

        part = what;
        number = 0;
        int count = most <= byte.MaxValue ? reader.ReadByte() : reader.ReadUInt16();
        if (count > most)
        {
            Refuse($"The scene announces {count} parts of the kind '{what}'; at most {most} are allowed.");
        }
        else if (count > reader.Remaining / (1 + minBytes))
        {
            Refuse(
                $"The scene announces {count} parts of the kind '{what}', of {1 + minBytes} bytes or more, and has {reader.Remaining} bytes left.");
        }

        return count;
    }

    private SceneRules? KnownRules(string name, int version)
    {
        SceneRules? namesake = null;
        for (int i = 0; i < known.Rules?.Count; i++)
        {
            if (known.Rules[i] is SceneRules candidate && string.Equals(candidate.Name, name, StringComparison.Ordinal))
            {
                if (candidate.Version == version)
                {
                    return candidate;
                }

                namesake ??= candidate;
            }
        }

        string needed = FormattableString.Invariant($"The scene needs the rules '{name}' of version {version}");
        Refuse(namesake is null
            ? $"{needed}, which this peer was not given (ClientOptions.Rules, or for a recording the rules of Recording.Read)."
            : FormattableString.Invariant($"{needed}; here they are of version {namesake.Version}."));
        return null;
    }

    private IAcceleration? Known(string name, int version)
    {
        IAcceleration? namesake = null;
        for (int i = 0; i < known.Accelerations?.Count; i++)
        {
            if (known.Accelerations[i] is IAcceleration candidate && string.Equals(candidate.Name, name, StringComparison.Ordinal))
            {
                if (candidate.Version == version)
                {
                    return candidate;
                }

                namesake ??= candidate;
            }
        }

        string needed = FormattableString.Invariant($"The scene needs the acceleration '{name}' of version {version}");
        Refuse(namesake is null
            ? $"{needed}, which is not here."
            : FormattableString.Invariant($"{needed}; here it is of version {namesake.Version}."));
        return null;
    }

    /// <summary>Refuses what the builder corrected: every scene has exactly one encoding.</summary>
    private bool IsTheOneForm(Scene scene)
    {
        for (int i = 0; i < normals.Count; i++)
        {
            if (!scene.Planes[i].Normal.Equals(normals[i]))
            {
                Refuse($"The normal of plane '{scene.Planes[i].Name}' is {normals[i]}; on the wire it has unit length.");
            }
        }

        for (int i = 0; i < sensorVectors.Count; i++)
        {
            if (scene.Sensors[i].Shape == SensorShape.Plane && !scene.Sensors[i].Normal.Equals(sensorVectors[i]))
            {
                Refuse($"The normal of sensor '{scene.Sensors[i].Name}' is {sensorVectors[i]}; on the wire it has unit length.");
            }
        }

        return error is null;
    }

    private void Refuse(string sentence)
    {
        error ??= sentence;
        reader.Require(false);
    }

    private readonly string Sentence()
    {
        string what = number == 0
            ? $"the scene's {part}{(part is "head" or "periodic box" or "rules" ? "" : " count")}"
            : FormattableString.Invariant($"{part} {number} of the scene");
        return reader.Refusal switch
        {
            WireRefusal.TooLong => $"The scene takes {length} bytes; at most {SceneFormat.MaxBytes} are allowed.",
            WireRefusal.TooShort => $"The {length} bytes of the scene end within {what}.",
            WireRefusal.TrailingBytes => $"Of the scene's {length} bytes {reader.Remaining} follow its last part.",
            _ => $"In {what} a number is not finite, a step is zero, a set names a peer above 16, or a name is not UTF-8.",
        };
    }
}
