using System;
using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>The start of a world: bodies, static geometry, gravity and other forces. Made by <see cref="SceneBuilder"/>.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
/// <example>
/// A ball above a floor, with friction:
/// <code>
/// Scene scene = new SceneBuilder("bounce")
///     .AddPlane("floor", normal: Vector3D.Up, point: Vector3D.Zero, friction: 0.4)
///     .AddBody("ball", new BodySpec(radius: 0.5, mass: 1, restitution: 0.7), position: new Vector3D(0, 4, 0))
///     .Build();
/// </code>
/// </example>
public sealed class Scene
{
    internal Scene(
        string name,
        Vector3D gravity,
        double restitutionThreshold,
        double contactTolerance,
        StaticPlane[] planes,
        StaticSphere[] spheres,
        SceneBody[] bodies,
        Force[] forces,
        double smallestRadius,
        PeerSet spawners,
        PeriodicBox box,
        Sensor[] sensors,
        SceneRules? rules,
        ulong seed)
    {
        Rules = rules;
        Seed = seed;
        Name = name;
        Gravity = gravity;
        RestitutionThreshold = restitutionThreshold;
        ContactTolerance = contactTolerance;
        PlaneArray = planes;
        SphereArray = spheres;
        BodyArray = bodies;
        ForceArray = forces;
        Accelerations = Supplied(forces);
        SmallestRadius = smallestRadius;
        Spawners = spawners;
        Box = box;
        SensorArray = sensors;
        (Hash, HashButSeed) = ComputeHashes();
    }

    /// <summary>The name of the scene.</summary>
    public string Name { get; }

    /// <summary>The uniform acceleration of free bodies in m/s^2; usually (0, -9.81, 0).</summary>
    public Vector3D Gravity { get; }

    /// <summary>
    /// The restitution threshold: the length in metres below which bounces on a plane are not followed one by one; default 1 nm.
    /// </summary>
    public double RestitutionThreshold { get; }

    /// <summary>
    /// How far, in metres, bodies in persistent contact may be from where an exact calculation has them: the one trade-off between speed
    /// and error in heaps. Default a millimetre, or a hundredth of <see cref="SmallestRadius"/> if that is less.
    /// </summary>
    public double ContactTolerance { get; }

    /// <summary>The planes, in the order in which they were added.</summary>
    public IReadOnlyList<StaticPlane> Planes => PlaneArray;

    /// <summary>The static spheres, in the order in which they were added.</summary>
    public IReadOnlyList<StaticSphere> StaticSpheres => SphereArray;

    /// <summary>The bodies; body n has the identity (0, 0, n).</summary>
    public IReadOnlyList<SceneBody> Bodies => BodyArray;

    /// <summary>The forces besides gravity, in the order in which they were added; see <see cref="ForceSet"/>.</summary>
    public IReadOnlyList<Force> Forces => ForceArray;

    /// <summary>
    /// The least radius of a body in metres, of those at the start and those that may be spawned; it bounds the permitted speed.
    /// </summary>
    public double SmallestRadius { get; }

    /// <summary>Which peers may spawn bodies, in a session.</summary>
    public PeerSet Spawners { get; }

    /// <summary>The periodic box that everything is in; none by default.</summary>
    public PeriodicBox Box { get; }

    /// <summary>The sensors, in the order in which they were added.</summary>
    public IReadOnlyList<Sensor> Sensors => SensorArray;

    /// <summary>The game's rules; null, the default, for none.</summary>
    public SceneRules? Rules { get; }

    /// <summary>What the random numbers of the rules begin with; default 0.</summary>
    public ulong Seed { get; }

    /// <summary>A hash of everything above but the name: equal on two peers exactly if they mean the same world (to 64 bits).</summary>
    public ulong Hash { get; }

    /// <summary>
    /// The same hash without <see cref="Seed"/>: equal for the scenes of two matches that differ in nothing but their random numbers. By it a
    /// host tells whether a client expects its scene.
    /// </summary>
    public ulong HashButSeed { get; }

    /// <summary>Those of the forces that are a program's own, which a peer must have to share the scene.</summary>
    public IReadOnlyList<IAcceleration> Accelerations { get; }

    internal StaticPlane[] PlaneArray { get; }

    internal StaticSphere[] SphereArray { get; }

    /// <summary>The planes and the static spheres together.</summary>
    internal StaticSurfaces Surfaces => new(PlaneArray, SphereArray);

    internal SceneBody[] BodyArray { get; }

    internal Force[] ForceArray { get; }

    internal Sensor[] SensorArray { get; }

    /// <summary>The identity of the body of that name, case-sensitive. Cost: the number of bodies; ask once and keep it.</summary>
    /// <exception cref="ArgumentException">No body of the scene has that name.</exception>
    /// <exception cref="ArgumentNullException">There is no name.</exception>
    public BodyId BodyNamed(string name)
    {
        ThrowIfNull(name);
        for (int i = 0; i < BodyArray.Length; i++)
        {
            if (string.Equals(BodyArray[i].Name, name, StringComparison.Ordinal))
            {
                return BodyId.OfScene(i);
            }
        }

        throw new ArgumentException($"Scene '{Name}' has no body named '{name}'.", nameof(name));
    }

    /// <summary>A body in words, for a message: <c>body 'ball' (0.0.0)</c>, or its identity alone for one that is not of the scene.</summary>
    public string Describe(BodyId body) =>
        body.Peer == 0 && body.Sequence == 0 && body.Index < BodyArray.Length ? $"body '{BodyArray[body.Index].Name}' ({body})" : $"body {body}";

    /// <summary>The set of the force of that name alone.</summary>
    /// <exception cref="ArgumentException">No force of the scene has that name.</exception>
    /// <exception cref="ArgumentNullException">There is no name.</exception>
    public ForceSet ForceNamed(string name)
    {
        ThrowIfNull(name);
        for (int i = 0; i < ForceArray.Length; i++)
        {
            if (string.Equals(ForceArray[i].Name, name, StringComparison.Ordinal))
            {
                return ForceSet.Of(i);
            }
        }

        throw new ArgumentException($"Scene '{Name}' has no force named '{name}'.", nameof(name));
    }

    /// <summary>The index in <see cref="Sensors"/> of the sensor of that name, case-sensitive.</summary>
    /// <exception cref="ArgumentException">No sensor of the scene has that name.</exception>
    /// <exception cref="ArgumentNullException">There is no name.</exception>
    public int SensorNamed(string name)
    {
        ThrowIfNull(name);
        for (int i = 0; i < SensorArray.Length; i++)
        {
            if (string.Equals(SensorArray[i].Name, name, StringComparison.Ordinal))
            {
                return i;
            }
        }

        throw new ArgumentException($"Scene '{Name}' has no sensor named '{name}'.", nameof(name));
    }

    /// <summary>The same world with its static geometry and forces only.</summary>
    internal Scene WithoutBodies() =>
        new(
            Name, Gravity, RestitutionThreshold, ContactTolerance, PlaneArray, SphereArray, Array.Empty<SceneBody>(), ForceArray,
            SmallestRadius, Spawners, Box, Array.Empty<Sensor>(), null, 0);

    /// <summary>The same scene with these rules and this seed.</summary>
    internal Scene With(SceneRules? rules, ulong seed) =>
        new(
            Name, Gravity, RestitutionThreshold, ContactTolerance, PlaneArray, SphereArray, BodyArray, ForceArray, SmallestRadius, Spawners,
            Box, SensorArray, rules, seed);

    private static void ThrowIfNull(string name)
    {
        if (name is null)
        {
            throw new ArgumentNullException(nameof(name));
        }
    }

    private static List<IAcceleration> Supplied(Force[] forces)
    {
        List<IAcceleration> supplied = new();
        foreach (Force force in forces)
        {
            if (force.Acceleration is IAcceleration acceleration)
            {
                supplied.Add(acceleration);
            }
        }

        return supplied;
    }

    private (ulong All, ulong ButSeed) ComputeHashes()
    {
        StableHash hash = default;
        hash.Add(Gravity);
        hash.Add(RestitutionThreshold);
        hash.Add(SmallestRadius);
        hash.Add((ulong)PlaneArray.Length);
        foreach (StaticPlane plane in PlaneArray)
        {
            hash.Add(plane.Normal);
            hash.Add(plane.Offset);
            hash.Add(plane.Restitution);
        }

        hash.Add((ulong)SphereArray.Length);
        foreach (StaticSphere sphere in SphereArray)
        {
            hash.Add(sphere.Centre);
            hash.Add(sphere.Radius);
            hash.Add(sphere.Restitution);
        }

        hash.Add((ulong)ForceArray.Length);
        foreach (Force force in ForceArray)
        {
            force.AddTo(ref hash);
        }

        hash.Add((ulong)BodyArray.Length);
        foreach (SceneBody body in BodyArray)
        {
            hash.Add(body.Spec);
            hash.Add(body.Position);
            hash.Add(body.Velocity);
        }

        AddRights(ref hash);
        AddFriction(ref hash);
        AddFilters(ref hash);
        if (Box.Exists)
        {
            hash.Add(Box.Size); // as above: a scene without has the hash it always had
        }

        if (ContactTolerance != SceneBuilder.DefaultContactTolerance(SmallestRadius))
        {
            hash.Add(1UL << 58);
            hash.Add(ContactTolerance);
        }

        if (SensorArray.Length > 0)
        {
            hash.Add((ulong)(uint)SensorArray.Length | (1UL << 57));
        }

        foreach (Sensor sensor in SensorArray)
        {
            ulong has = (sensor.Filter.IsDefault ? 0 : 1UL << 16) | (sensor.Carrier is null ? 0 : 1UL << 17);
            hash.Add((ulong)sensor.Shape | ((ulong)sensor.Coverage << 8) | has);
            hash.Add(sensor.Vector);
            hash.Add(sensor.Measure);
            if (!sensor.Filter.IsDefault)
            {
                hash.Add(sensor.Filter.Packed);
            }

            if (sensor.Carrier is BodyId carrier)
            {
                hash.Add(carrier.Packed);
            }
        }

        AddRules(ref hash);
        ulong butSeed = hash.Value;
        if (Seed != 0)
        {
            hash.Add(1UL << 56); // as below: a scene without has the hash it always had
            hash.Add(Seed);
        }

        return (hash.Value, butSeed);
    }

    // As below: a scene without has the hash it always had.
    private void AddRules(ref StableHash hash)
    {
        if (Rules is not null)
        {
            hash.Add(1UL << 55);
            hash.Add(Rules.Name);
            hash.Add((long)Rules.Version);
            hash.Add((long)Rules.WorldBytes);
            hash.Add((long)Rules.BodyBytes);
            if (Rules.SkipsFailedCommands)
            {
                hash.Add(1UL << 54);
            }
        }
    }

    // Only where the scene sets it, so that any other scene has the hash it always had.
    private void AddFriction(ref StableHash hash)
    {
        for (int i = 0; i < PlaneArray.Length; i++)
        {
            AddUnlessLeftToBodies(ref hash, PlaneArray[i].Friction, (ulong)(uint)i | (1UL << 61));
        }

        for (int i = 0; i < SphereArray.Length; i++)
        {
            AddUnlessLeftToBodies(ref hash, SphereArray[i].Friction, (ulong)(uint)i | (1UL << 60));
        }

        for (int i = 0; i < BodyArray.Length; i++)
        {
            if (BodyArray[i].Spin != Vector3D.Zero)
            {
                hash.Add((ulong)(uint)i | (1UL << 59));
                hash.Add(BodyArray[i].Spin);
            }
        }
    }

    // As above. Those of bodies are in their specs.
    private void AddFilters(ref StableHash hash)
    {
        StaticSurfaces surfaces = Surfaces;
        for (int i = 0; surfaces.HaveFilters && i < surfaces.Count; i++)
        {
            if (!surfaces.Filter(i).IsDefault)
            {
                hash.Add((ulong)(uint)i | (1UL << 57));
                hash.Add(surfaces.Filter(i).Packed);
            }
        }
    }

    private static void AddUnlessLeftToBodies(ref StableHash hash, double friction, ulong mark)
    {
        if (friction != Limits.MaxFriction)
        {
            hash.Add(mark);
            hash.Add(friction);
        }
    }

    // Only where some peer lacks a right, so that a scene in which all peers may do everything has the hash it always had.
    private void AddRights(ref StableHash hash)
    {
        if (Spawners != PeerSet.Everyone)
        {
            hash.Add(Spawners.HashBits | (1UL << 63));
        }

        for (int i = 0; i < BodyArray.Length; i++)
        {
            if (BodyArray[i].Players != PeerSet.Everyone)
            {
                hash.Add(BodyArray[i].Players.HashBits | ((ulong)(uint)i << 16) | (1UL << 62));
            }
        }
    }
}
