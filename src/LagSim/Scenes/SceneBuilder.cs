using System;
using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>Collects what a <see cref="Scene"/> consists of and checks it on <see cref="Build"/>.</summary>
/// <remarks>Not thread-safe. Nothing is checked before <see cref="Build"/>, nothing is silently clamped.</remarks>
public sealed class SceneBuilder
{
    /// <summary>Gravity where a scene sets none: 9.81 m/s^2 downwards.</summary>
    public static readonly Vector3D DefaultGravity = new(0, -9.81, 0);

    /// <summary>The restitution threshold where a scene sets none: 1 nm.</summary>
    public const double DefaultRestitutionThreshold = 1e-9;

    /// <summary>The largest contact tolerance where a scene sets none: 1 mm.</summary>
    public const double MaxDefaultContactTolerance = 1e-3;

    /// <summary>The least contact tolerance in metres.</summary>
    public const double MinContactTolerance = 1e-9;

    /// <summary>The largest contact tolerance in metres.</summary>
    public const double MaxContactTolerance = 0.1;

    /// <summary>The most threads that may be asked for.</summary>
    public const int MaxThreads = 64;

    /// <summary>The most bodies a scene may have.</summary>
    public const int MaxBodies = BodyId.MaxIndex + 1;

    /// <summary>The most sensors a scene may have. Each is looked at whenever a body's next event is predicted.</summary>
    public const int MaxSensors = 1024;

    private readonly string name;
    private readonly List<StaticPlane> planes = new();
    private readonly List<StaticSphere> spheres = new();
    private readonly List<SceneBody> bodies = new();
    private readonly List<Force> forces = new();
    private readonly List<Sensor> sensors = new();
    private readonly List<string?> carriers = new(); // of each sensor the name of the body that carries it
    private Vector3D gravity = DefaultGravity;
    private PeerSet spawners;
    private PeriodicBox box;
    private double restitutionThreshold = DefaultRestitutionThreshold;
    private double? contactTolerance;
    private double? smallestSpawn;
    private int? threads;
    private SceneRules? rules;
    private ulong seed;

    /// <summary>Starts a scene of that name with default gravity and nothing in it. The name is for people, no part of
    /// <see cref="Scene.Hash"/>.</summary>
    /// <param name="name">1 to 64 characters, no control characters and no half of a surrogate pair.</param>
    /// <exception cref="ArgumentNullException">There is no name.</exception>
    public SceneBuilder(string name) => this.name = name ?? throw new ArgumentNullException(nameof(name));

    /// <summary>Sets the uniform acceleration of free bodies, in m/s^2, each component within 1e6; default <see cref="DefaultGravity"/>,
    /// <see cref="Vector3D.Zero"/> for none. y points up.</summary>
    public SceneBuilder WithGravity(Vector3D acceleration)
    {
        gravity = acceleration;
        return this;
    }

    /// <summary>
    /// Sets the length in metres, 1e-15 to 1e-3, below which bounces on a plane are not followed one by one; default 1e-9.
    /// </summary>
    /// <remarks>
    /// Unless a body touches a single plane and nothing else, a bounce that rises less than a thousand times this is the last. Bodies
    /// within that distance of each other count as in persistent contact.
    /// </remarks>
    public SceneBuilder WithRestitutionThreshold(double metres)
    {
        restitutionThreshold = metres;
        return this;
    }

    /// <summary>Sets how far, in metres, bodies in persistent contact may be from where an exact calculation has them, 1e-9 to 0.1. Default
    /// 1e-3, or a hundredth of the smallest radius if that is less: too small to see, and a game's heap is far faster than real
    /// time.</summary>
    /// <remarks>It is the one trade-off between speed and error where bodies crowd, rest and roll on each other. It decides how long a
    /// contact step is, when a rebound is the last, how well the steps are solved and when a heap sleeps. Bodies in flight, and those that
    /// rest, slide or roll alone on a plane, are exact whatever the tolerance.</remarks>
    public SceneBuilder WithContactTolerance(double metres)
    {
        contactTolerance = metres;
        return this;
    }

    /// <summary>The contact tolerance, in metres, of a scene that sets none.</summary>
    internal static double DefaultContactTolerance(double smallestRadius) =>
        Math.Max(MinContactTolerance, Math.Min(MaxDefaultContactTolerance, smallestRadius / 100));

    /// <summary>Promises that no body smaller than this, in metres, 1e-9 to 1e9, is in the scene or is spawned; what is smaller is refused,
    /// by <see cref="Build"/> or when it is to be spawned. Default: the smallest body of the scene; a scene without bodies takes none until this
    /// says how small they may be. It bounds the speed that may be given:
    /// a tenth of it in a tick, 1.1e11 m/s times that radius in metres.</summary>
    public SceneBuilder WithSmallestRadius(double metres)
    {
        smallestSpawn = metres;
        return this;
    }

    /// <summary>Sets the largest number of threads on which <see cref="Build"/> checks a large scene, 1 to <see cref="MaxThreads"/>;
    /// default as many as there are processors.</summary>
    /// <remarks>It has no influence on the scene, to the bit, nor on which error is reported. Fewer than 16,384 bodies are checked on the
    /// caller's thread alone, and so is everything where there is one processor.</remarks>
    public SceneBuilder WithThreads(int most)
    {
        threads = most;
        return this;
    }

    /// <summary>Adds a plane through a point. It is infinite and never moves; bodies live on one side of it.</summary>
    /// <param name="planeName">1 to 64 characters, no control characters among them, and no other part's.</param>
    /// <param name="normal">Points to the side where bodies are; of any length between 1e-150 and 1e150.</param>
    /// <param name="point">Any point of the plane, in metres.</param>
    /// <param name="restitution">0 (stays) to 1 (elastic, the default). Of two things that meet, the lesser counts, so 1 leaves it to the
    /// body.</param>
    /// <param name="friction">0 to 100. Of two things that meet, the lesser counts, so the default, 100, leaves it to the body.</param>
    /// <param name="filter">Which bodies collide with it; default all.</param>
    /// <exception cref="SceneException">The point is not finite, or the normal has no length.</exception>
    public SceneBuilder AddPlane(
        string planeName, Vector3D normal, Vector3D point, double restitution = 1, double friction = Limits.MaxFriction, CollisionFilter filter = default)
    {
        if (!point.IsFinite)
        {
            throw new SceneException($"The point of plane '{planeName}' is {point}; every component must be finite.");
        }

        return AddPlane(planeName, normal, Vector3D.Dot(UnitNormal.Of("plane", planeName, normal), point), restitution, friction, filter);
    }

    /// <summary>Adds the plane of the points p with n . p = <paramref name="offset"/>, n the normal at unit length, towards the
    /// bodies.</summary>
    /// <param name="planeName">1 to 64 characters, no control characters among them, and no other part's.</param>
    /// <param name="normal">Points to the side where bodies are; of any length between 1e-150 and 1e150.</param>
    /// <param name="offset">The signed distance of the plane from the origin along the normal, in metres, within 1e12.</param>
    /// <param name="restitution">0 (stays) to 1 (elastic, the default). Of two things that meet, the lesser counts, so 1 leaves it to the
    /// body.</param>
    /// <param name="friction">0 to 100. Of two things that meet, the lesser counts, so the default, 100, leaves it to the body.</param>
    /// <param name="filter">Which bodies collide with it; default all.</param>
    /// <exception cref="SceneException">The normal is not finite, or has no length.</exception>
    public SceneBuilder AddPlane(
        string planeName, Vector3D normal, double offset, double restitution = 1, double friction = Limits.MaxFriction, CollisionFilter filter = default)
    {
        planes.Add(new StaticPlane(planeName, UnitNormal.Of("plane", planeName, normal), offset + 0.0, restitution, friction, filter));
        return this;
    }

    /// <summary>Adds a sphere that never moves; bodies live outside of it.</summary>
    /// <param name="sphereName">1 to 64 characters, no control characters among them, and no other part's.</param>
    /// <param name="centre">In metres, each component within 1e12.</param>
    /// <param name="radius">In metres, 1e-9 to 1e9.</param>
    /// <param name="restitution">0 (stays) to 1 (elastic, the default). Of two things that meet, the lesser counts, so 1 leaves it to the
    /// body.</param>
    /// <param name="friction">0 to 100. Of two things that meet, the lesser counts, so the default, 100, leaves it to the body.</param>
    /// <param name="filter">Which bodies collide with it; default all.</param>
    public SceneBuilder AddStaticSphere(
        string sphereName, Vector3D centre, double radius, double restitution = 1, double friction = Limits.MaxFriction, CollisionFilter filter = default)
    {
        spheres.Add(new StaticSphere(sphereName, centre.WithoutNegativeZero(), radius, restitution, friction, filter));
        return this;
    }

    /// <summary>Adds a body; the n-th added, counted from 0, has the identity (0, 0, n).</summary>
    /// <param name="bodyName">1 to 64 characters, no control characters among them, and no other part's.</param>
    /// <param name="spec">Size, mass, material and flight.</param>
    /// <param name="position">Where its centre starts, in metres, each component within 1e12. Bodies start apart or touching, not inside of
    /// anything.</param>
    /// <param name="velocity">In m/s; default none. At most a tenth of the smallest radius in a tick, 1.1e11 m/s times that radius in
    /// metres.</param>
    /// <param name="players">Which peers may do something to it, in a session; default everyone.</param>
    /// <param name="spin">How it turns, in rad/s about the vector; default not at all. It matters where something has friction, or under a
    /// Magnus force.</param>
    public SceneBuilder AddBody(
        string bodyName, BodySpec spec, Vector3D position, Vector3D velocity = default, PeerSet players = default, Vector3D spin = default)
    {
        bodies.Add(new SceneBody(bodyName, spec, position.WithoutNegativeZero(), velocity.WithoutNegativeZero(), players, spin.WithoutNegativeZero()));
        return this;
    }

    /// <summary>Sets which peers may spawn bodies in a session; default everyone. Who may do something to a spawned
    /// body is said with its spawn (<see cref="Events.PlayerAction.Spawn"/>), by default everyone.</summary>
    public SceneBuilder WithSpawners(PeerSet peers)
    {
        spawners = peers;
        return this;
    }

    /// <summary>Puts everything in a periodic box from the origin to <paramref name="size"/>: a body that leaves it on one side comes in on
    /// the opposite side.</summary>
    /// <remarks>It allows free flight alone: no gravity, planes, static spheres or other forces, and only bodies that fly by Ballistic.
    /// Each side is at least five times the largest diameter; bodies start, and are spawned or put, inside. Their paths are opened again
    /// after an eighth of the least side, so that no body meets two images of another at once.</remarks>
    public SceneBuilder WithPeriodicBox(Vector3D size)
    {
        box = new PeriodicBox(size);
        return this;
    }

    /// <summary>Adds a sensor behind a plane through a point, such as a goal behind its line. It touches nothing and never moves.</summary>
    /// <param name="sensorName">1 to 64 characters, no control characters among them, and no other part's.</param>
    /// <param name="normal">Points away from the region; of any length between 1e-150 and 1e150.</param>
    /// <param name="point">Any point of the plane, in metres.</param>
    /// <param name="coverage">How much of a body has to be behind the plane; default its centre.</param>
    /// <param name="filter">Which bodies it sees: those that would collide with this; default all.</param>
    /// <exception cref="SceneException">The point is not finite, or the normal has no length.</exception>
    public SceneBuilder AddSensorPlane(
        string sensorName, Vector3D normal, Vector3D point, SensorCoverage coverage = SensorCoverage.Centre,
        CollisionFilter filter = default)
    {
        if (!point.IsFinite)
        {
            throw new SceneException($"The point of sensor '{sensorName}' is {point}; every component must be finite.");
        }

        return AddSensorPlane(sensorName, normal, Vector3D.Dot(UnitNormal.Of("sensor", sensorName, normal), point), coverage, filter);
    }

    /// <summary>Adds a sensor of the points p with n . p below <paramref name="offset"/>, n the normal at unit length.</summary>
    /// <param name="sensorName">1 to 64 characters, no control characters among them, and no other part's.</param>
    /// <param name="normal">Points away from the region; of any length between 1e-150 and 1e150.</param>
    /// <param name="offset">The signed distance of the plane from the origin along the normal, in metres, within 1e12.</param>
    /// <param name="coverage">How much of a body has to be behind the plane; default its centre.</param>
    /// <param name="filter">Which bodies it sees: those that would collide with this; default all.</param>
    /// <exception cref="SceneException">The normal is not finite, or has no length.</exception>
    public SceneBuilder AddSensorPlane(
        string sensorName, Vector3D normal, double offset, SensorCoverage coverage = SensorCoverage.Centre,
        CollisionFilter filter = default)
    {
        Vector3D unit = UnitNormal.Of("sensor", sensorName, normal);
        return Add(new Sensor(sensorName, SensorShape.Plane, unit, offset + 0.0, coverage, filter), null);
    }

    /// <summary>Adds a sensor in a sphere, which touches nothing. It never moves, or goes with a body: a player's reach, a
    /// magnet's.</summary>
    /// <param name="sensorName">1 to 64 characters, no control characters among them, and no other part's.</param>
    /// <param name="centre">In metres, each component within 1e12; from the centre of the carrier, without turning, if there is
    /// one.</param>
    /// <param name="radius">In metres, 1e-9 to 1e9.</param>
    /// <param name="coverage">How much of a body has to be in the sphere; default its centre.</param>
    /// <param name="filter">Which bodies it sees: those that would collide with this; default all.</param>
    /// <param name="carrier">The name of the body of the scene that carries it, and that it does not see; default none. Where the
    /// carrier is removed, nothing is inside.</param>
    public SceneBuilder AddSensorSphere(
        string sensorName, Vector3D centre, double radius, SensorCoverage coverage = SensorCoverage.Centre,
        CollisionFilter filter = default, string? carrier = null)
    {
        return Add(new Sensor(sensorName, SensorShape.Sphere, centre.WithoutNegativeZero(), radius, coverage, filter), carrier);
    }

    /// <summary>Adds a force; it acts on the bodies that name it.</summary>
    /// <param name="force">The force; its name must not be another part's.</param>
    /// <param name="itself">The set of this force alone, for a <see cref="BodySpec"/>.</param>
    public SceneBuilder AddForce(Force force, out ForceSet itself)
    {
        itself = forces.Count < ForceSet.MaxForces ? ForceSet.Of(forces.Count) : ForceSet.None; // there it ends with an error on Build
        return AddForce(force);
    }

    /// <summary>Adds a force; the n-th added, counted from 0, is <see cref="ForceSet.Of"/> n. It acts on the bodies that have it in
    /// <see cref="BodySpec.Forces"/>, at most <see cref="ForceSet.MaxForces"/> there are.</summary>
    /// <exception cref="ArgumentNullException">There is no force.</exception>
    public SceneBuilder AddForce(Force force)
    {
        forces.Add(force ?? throw new ArgumentNullException(nameof(force)));
        return this;
    }

    /// <summary>Gives the scene the rules of a game; see <see cref="Rules.GameRules"/>. A scene has one object of rules, default
    /// none.</summary>
    /// <exception cref="ArgumentNullException">There are no rules.</exception>
    public SceneBuilder WithRules(SceneRules ofGame)
    {
        rules = ofGame ?? throw new ArgumentNullException(nameof(ofGame));
        return this;
    }

    /// <summary>Sets what the random numbers of the rules begin with, any value; default 0. Another gives another game.</summary>
    public SceneBuilder WithSeed(ulong value)
    {
        seed = value;
        return this;
    }

    /// <summary>Checks everything and makes the scene. Cost: O(n log n) in the bodies, on several threads if they are many
    /// (<see cref="WithThreads"/>).</summary>
    /// <exception cref="SceneException">Something is not valid; the sentence names the value and what is allowed.</exception>
    public Scene Build()
    {
        CheckWhole();
        int used = bodies.Count < ParallelPair.MinBodies ? 1 : threads ?? Environment.ProcessorCount;
        Force[] forceArray = forces.ToArray();
        SceneBody[] bodyArray = bodies.ToArray();
        ParallelPair.InParts(0, bodyArray.Length, used, (from, to) =>
        {
            for (int i = from; i < to; i++)
            {
                Limits.CheckSpec(bodyArray[i].Spec, Whose(bodyArray[i]), gravity, forceArray);
                bodyArray[i] = bodyArray[i].With(FlightLaws.Chosen(bodyArray[i].Spec, gravity, forceArray));
            }
        });
        double smallest = SmallestRadius.Of(bodies, smallestSpawn);
        if (box.Exists)
        {
            Limits.CheckBox(box, smallestSpawn ?? 0, $"scene '{name}'");
            PeriodicBoxCheck.Throw(name, box, gravity, planes.Count, spheres.Count, forces.Count, sensors.Count, bodies);
        }

        Sensor[] sensorArray = SensorCheck.Checked(name, sensors, carriers, bodies);
        ParallelPair.InParts(0, bodyArray.Length, used, (from, to) =>
        {
            for (int i = from; i < to; i++)
            {
                ref readonly SceneBody body = ref bodyArray[i];
                Limits.CheckPosition(body.Position, Whose(body));
                Limits.CheckCentres(body.Position, body.Spec, Whose(body), forceArray);
                Limits.CheckVelocity(body.Velocity, smallest, Whose(body));
                Limits.CheckSpin(body.Spin, body.Spec, smallest, Whose(body), forceArray);
            }
        });
        Scene? scene = null;
        ParallelPair.Do(
            used, NameAndHash, () => StartOverlap.Check(bodyArray, planes, spheres, box, restitutionThreshold, Math.Max(1, used - 1)));
        return scene!;

        void NameAndHash()
        {
            PartName.CheckAll(name, PartNames());
            scene = new Scene(
                name, gravity.WithoutNegativeZero(), restitutionThreshold, contactTolerance ?? DefaultContactTolerance(smallest),
                planes.ToArray(), spheres.ToArray(), bodyArray, forceArray, smallest, spawners, box, sensorArray, rules, seed);
        }
    }

    /// <summary>Adds a sensor as another scene has it; if a body carries it, one of the same name.</summary>
    internal SceneBuilder AddSensor(in Sensor sensor, Scene of) =>
        Add(sensor, sensor.Carrier is BodyId carrier ? of.Bodies[carrier.Index].Name : null);

    private SceneBuilder Add(in Sensor sensor, string? carrier)
    {
        sensors.Add(sensor);
        carriers.Add(carrier);
        return this;
    }

    internal static BodyText Whose(in SceneBody body) => new(body.Name);

    private void CheckWhole()
    {
        if (PartName.Problem(name) is string problem)
        {
            throw new SceneException($"'{PartName.Shown(name)}' is no name for a scene: {problem}.");
        }

        Limits.Components(gravity, 1e6, $"scene '{name}'", "gravity", "m/s^2");
        Limits.InRange(restitutionThreshold, 1e-15, 1e-3, $"scene '{name}'", "restitution threshold", "m");
        Limits.InRange(contactTolerance ?? MinContactTolerance, MinContactTolerance, MaxContactTolerance, $"scene '{name}'", "contact tolerance", "m");
        if (smallestSpawn is double least)
        {
            Limits.InRange(least, Limits.MinRadius, Limits.MaxRadius, $"scene '{name}'", "smallest radius", "m");
        }

        if (rules?.Problem is string ofRules)
        {
            throw new SceneException($"Scene '{name}' has the rules '{rules}', which {ofRules}.");
        }

        if (threads is < 1 or > MaxThreads)
        {
            throw new SceneException($"Scene '{name}' is to be checked on {threads} threads; 1 to {MaxThreads} are allowed.");
        }

        if (bodies.Count > MaxBodies)
        {
            throw new SceneException($"Scene '{name}' has {bodies.Count} bodies; at most {MaxBodies} are allowed.");
        }

        if (forces.Count > ForceSet.MaxForces)
        {
            throw new SceneException($"Scene '{name}' has {forces.Count} forces besides gravity; at most {ForceSet.MaxForces} are allowed.");
        }

        foreach (Force force in forces)
        {
            Limits.CheckForce(force);
        }

        StaticSurfaceCheck.Throw(planes, spheres);
    }

    /// <summary>The names of all parts.</summary>
    private List<string> PartNames()
    {
        List<string> names = new();
        forces.ForEach(force => names.Add(force.Name));
        planes.ForEach(plane => names.Add(plane.Name));
        spheres.ForEach(sphere => names.Add(sphere.Name));
        bodies.ForEach(body => names.Add(body.Name));
        sensors.ForEach(sensor => names.Add(sensor.Name));
        return names;
    }
}
