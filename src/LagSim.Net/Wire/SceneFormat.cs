using System;
using System.Diagnostics.CodeAnalysis;
using LagSim.Scenes;

namespace LagSim.Net.Wire;

/// <summary>
/// How a whole scene is encoded: everything except the code of custom accelerations and of rules, which go by name and author's version.
/// </summary>
/// <remarks>
/// <para>The layout is in <c>docs/RECORDINGS.md</c>. A scene has one encoding: encoding again what was decoded gives the same bytes, except
/// for a -0.0, which is accepted, read as 0.0, and never written.</para>
/// <para>Pure functions, safe on any thread.</para>
/// </remarks>
internal static class SceneFormat
{
    /// <summary>
    /// The most bodies that can be encoded. Finding overlaps takes, in the worst arrangement, the square of their number; at this limit
    /// about a second.
    /// </summary>
    public const int MaxBodies = 10_000;

    /// <summary>The most planes that can be encoded, and the most static spheres. Every body is checked against each.</summary>
    public const int MaxStaticParts = 1_000;

    /// <summary>The longest scene, in bytes.</summary>
    public const int MaxBytes = 1 + MaxTextBytes + HeadBytes
        + (ForceSet.MaxForces * (MaxTextBytes + ForceBytes))
        + (2 * MaxStaticParts * (MaxTextBytes + StaticPartBytes))
        + (MaxBodies * (MaxTextBytes + BodyBytes)) + (SceneBuilder.MaxSensors * (MaxTextBytes + SensorBytes)) + RulesBytes + EventFormat.VectorBytes;

    internal const int ForceBytes = 22 + EventFormat.VectorBytes; // kind, author's version, strength, damping, vector, power
    internal const int StaticPartBytes = EventFormat.VectorBytes + 24 + EventFormat.FilterBytes; // both kinds: a vector, three numbers, a filter
    internal const int BodyBytes = EventFormat.SpecBytes + (3 * EventFormat.VectorBytes) + 4;
    internal const int SensorBytes = EventFormat.VectorBytes + EventFormat.FilterBytes + 14; // shape, coverage, a vector, a number, a filter and the carrier

    private const uint SkipsFailedCommands = 1u << 31; // beside the size of the rules' state, which is far smaller
    private const int RulesBytes = 9 + MaxTextBytes + 12; // seed, whether there are any; name, author's version, two sizes
    private const int MaxTextBytes = 1 + WireText.MaxBytes;
    // Gravity, restitution threshold, contact tolerance, smallest radius, spawners, five counts.
    private const int HeadBytes = EventFormat.VectorBytes + 24 + 4 + 1 + (4 * 2);

    /// <summary>Encodes a scene. Cost: O(n) in its parts.</summary>
    /// <exception cref="ArgumentException">
    ///  It cannot travel: it has more than <see cref="MaxBodies"/> bodies, more than <see cref="MaxStaticParts"/> planes or static spheres.
    /// The sentence says which.
    /// </exception>
    public static byte[] Encode(Scene scene)
    {
        byte[] bytes = new byte[EncodedLength(scene ?? throw new ArgumentNullException(nameof(scene)))];
        WireWriter writer = new(bytes);
        writer.WriteByte(WireFormat.Version);
        WireText.Write(ref writer, scene.Name);
        writer.WriteVector(scene.Gravity);
        writer.WriteDouble(scene.RestitutionThreshold);
        writer.WriteDouble(scene.ContactTolerance);
        writer.WriteDouble(scene.SmallestRadius);
        writer.WriteUInt32(scene.Spawners.Mask);
        writer.WriteByte((byte)scene.Forces.Count);
        foreach (Force force in scene.Forces)
        {
            Write(ref writer, force);
        }

        writer.WriteUInt16((ushort)scene.Planes.Count);
        foreach (StaticPlane plane in scene.Planes)
        {
            WireText.Write(ref writer, plane.Name);
            writer.WriteVector(plane.Normal);
            writer.WriteDouble(plane.Offset);
            writer.WriteDouble(plane.Restitution);
            writer.WriteDouble(plane.Friction);
            EventFormat.WriteFilter(ref writer, plane.Filter);
        }

        writer.WriteUInt16((ushort)scene.StaticSpheres.Count);
        foreach (StaticSphere sphere in scene.StaticSpheres)
        {
            WireText.Write(ref writer, sphere.Name);
            writer.WriteVector(sphere.Centre);
            writer.WriteDouble(sphere.Radius);
            writer.WriteDouble(sphere.Restitution);
            writer.WriteDouble(sphere.Friction);
            EventFormat.WriteFilter(ref writer, sphere.Filter);
        }

        writer.WriteUInt16((ushort)scene.Bodies.Count);
        foreach (SceneBody body in scene.Bodies)
        {
            WireText.Write(ref writer, body.Name);
            EventFormat.WriteSpec(ref writer, body.Spec);
            writer.WriteVector(body.Position);
            writer.WriteVector(body.Velocity);
            writer.WriteUInt32(body.Players.Mask);
            writer.WriteVector(body.Spin);
        }

        writer.WriteUInt16((ushort)scene.Sensors.Count);
        foreach (Sensor sensor in scene.Sensors)
        {
            WireText.Write(ref writer, sensor.Name);
            writer.WriteByte((byte)sensor.Shape);
            writer.WriteByte((byte)sensor.Coverage);
            writer.WriteVector(sensor.Shape == SensorShape.Plane ? sensor.Normal : sensor.Centre);
            writer.WriteDouble(sensor.Shape == SensorShape.Plane ? sensor.Offset : sensor.Radius);
            EventFormat.WriteFilter(ref writer, sensor.Filter);
            writer.WriteUInt32(sensor.Carrier is BodyId carrier ? (uint)carrier.Index + 1 : 0);
        }

        writer.WriteUInt64(scene.Seed);
        writer.WriteByte(scene.Rules is null ? (byte)0 : (byte)1);
        if (scene.Rules is SceneRules rules)
        {
            WireText.Write(ref writer, rules.Name);
            writer.WriteUInt32(unchecked((uint)rules.Version));
            writer.WriteUInt32(WorldBytes(rules));
            writer.WriteUInt32((uint)rules.BodyBytes);
        }

        if (scene.Box.Exists)
        {
            writer.WriteVector(scene.Box.Size);
        }

        return bytes;
    }

    /// <summary>Reads a scene; never throws, whatever the bytes are, and allocates no more than a few times their number.</summary>
    /// <param name="bytes">The whole scene and nothing else.</param>
    /// <param name="known">The accelerations and rules available to the scene. A scene that needs others is refused.</param>
    /// <param name="scene">The scene, of the same <see cref="Scene.Hash"/> as the one that was encoded; null when refused.</param>
    /// <param name="error">When refused, a sentence that says why, the builder's own if the builder refuses; otherwise null.</param>
    /// <remarks>Cost: that of <see cref="SceneBuilder.Build"/>, see <see cref="MaxBodies"/>.</remarks>
    public static bool TryDecode(
        ReadOnlySpan<byte> bytes,
        SceneCode known,
        [NotNullWhen(true)] out Scene? scene,
        [NotNullWhen(false)] out string? error)
    {
        SceneDecoder decoder = new(bytes, known);
        scene = decoder.Decode(out error);
        return scene is not null;
    }

    /// <summary>The size of the state of rules, and with it whether a command that they fail in counts as none.</summary>
    internal static uint WorldBytes(SceneRules rules) => (uint)rules.WorldBytes | (rules.SkipsFailedCommands ? SkipsFailedCommands : 0);

    /// <summary>In what rules differ from those of a scene that was encoded; null if in nothing.</summary>
    internal static string? Difference(SceneRules rules, uint worldBytes, uint bodyBytes)
    {
        bool skips = (worldBytes & SkipsFailedCommands) != 0;
        worldBytes &= ~SkipsFailedCommands;
        if (rules.WorldBytes != worldBytes || rules.BodyBytes != bodyBytes)
        {
            return $"The scene's rules '{rules.Name}' have states of {worldBytes} bytes and {bodyBytes} for a body; here they have {rules.WorldBytes} and"
                + $" {rules.BodyBytes}.";
        }

        return rules.SkipsFailedCommands == skips ? null
            : $"By the scene's rules '{rules.Name}' a command that fails {Failed(skips)}; here it {Failed(rules.SkipsFailedCommands)}.";

        static string Failed(bool isSkipped) => isSkipped ? "counts as none" : "ends the world";
    }

    private static void Write(ref WireWriter writer, Force force)
    {
        WireText.Write(ref writer, force.Name);
        writer.WriteByte((byte)force.Kind);
        writer.WriteUInt32(unchecked((uint)(force.Acceleration?.Version ?? 0)));
        writer.WriteDouble(force.Strength);
        writer.WriteDouble(force.Damping);
        writer.WriteVector(force.Vector);
        writer.WriteByte(unchecked((byte)force.Power));
    }

    private static int EncodedLength(Scene scene)
    {
        Require(scene, scene.Planes.Count, MaxStaticParts, "planes");
        Require(scene, scene.StaticSpheres.Count, MaxStaticParts, "static spheres");
        Require(scene, scene.Bodies.Count, MaxBodies, "bodies");
        int length = 1 + WireText.EncodedLength(scene.Name, "A scene's name") + HeadBytes;
        foreach (Force force in scene.Forces)
        {
            length += WireText.EncodedLength(force.Name, "A force's name") + ForceBytes;
        }

        foreach (StaticPlane plane in scene.Planes)
        {
            length += WireText.EncodedLength(plane.Name, "A plane's name") + StaticPartBytes;
        }

        foreach (StaticSphere sphere in scene.StaticSpheres)
        {
            length += WireText.EncodedLength(sphere.Name, "A static sphere's name") + StaticPartBytes;
        }

        foreach (SceneBody body in scene.Bodies)
        {
            length += WireText.EncodedLength(body.Name, "A body's name") + BodyBytes;
        }

        foreach (Sensor sensor in scene.Sensors)
        {
            length += WireText.EncodedLength(sensor.Name, "A sensor's name") + SensorBytes;
        }

        length += 9 + (scene.Rules is SceneRules rules ? WireText.EncodedLength(rules.Name, "The name of rules") + 12 : 0);
        return length + (scene.Box.Exists ? EventFormat.VectorBytes : 0);
    }

    private static void Require(Scene scene, int count, int most, string what)
    {
        if (count > most)
        {
            throw new ArgumentException($"Scene '{scene.Name}' cannot travel: it has {count} {what}; at most {most} are allowed.", nameof(scene));
        }
    }
}
