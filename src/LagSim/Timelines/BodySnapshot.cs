using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>One body of a <see cref="WorldSnapshot"/>: its spec, and the segment it is on.</summary>
/// <remarks>
/// Immutable. It may hold any values; <see cref="Simulation(Scene, WorldSnapshot, SimulationOptions)"/> checks them.
/// </remarks>
public readonly struct BodySnapshot
{
    /// <summary>The most planes that carry a body together.</summary>
    public const int MaxSupports = SupportSet.Most;

    /// <summary>A body on a path that <paramref name="opened"/> began.</summary>
    /// <param name="id">See <see cref="Id"/>.</param>
    /// <param name="spec">See <see cref="Spec"/>.</param>
    /// <param name="opened">See <see cref="Opened"/>.</param>
    /// <param name="law">See <see cref="Law"/>.</param>
    /// <param name="epoch">See <see cref="Epoch"/>.</param>
    /// <param name="end">See <see cref="End"/>.</param>
    /// <param name="position">See <see cref="Position"/>.</param>
    /// <param name="velocity">See <see cref="Velocity"/>.</param>
    /// <param name="acceleration">See <see cref="Acceleration"/>.</param>
    /// <param name="supports">The planes that carry it, by index in the scene; at most <see cref="MaxSupports"/>.</param>
    /// <param name="cubic">See <see cref="Cubic"/>.</param>
    /// <param name="quartic">See <see cref="Quartic"/>.</param>
    /// <param name="quintic">See <see cref="Quintic"/>.</param>
    /// <param name="hold">See <see cref="Hold"/>.</param>
    /// <param name="nextStep">See <see cref="NextStep"/>.</param>
    /// <param name="spin">See <see cref="Spin"/>.</param>
    /// <param name="spinRate">See <see cref="SpinRate"/>.</param>
    /// <param name="centre">See <see cref="Centre"/>.</param>
    /// <param name="stillSince">See <see cref="StillSince"/>.</param>
    /// <param name="contacts">See <see cref="Contacts"/>.</param>
    /// <param name="filter">See <see cref="Filter"/>; by default that of the spec.</param>
    /// <param name="inside">See <see cref="Inside"/>.</param>
    /// <param name="crossings">See <see cref="Crossings"/>.</param>
    /// <param name="players">See <see cref="Players"/>.</param>
    /// <exception cref="ArgumentException">There are more than <see cref="MaxSupports"/> supports.</exception>
    public BodySnapshot(
        BodyId id,
        in BodySpec spec,
        in EventKey opened,
        MotionLaw law,
        SimTime epoch,
        SimTime end,
        in Vector3D position,
        in Vector3D velocity,
        in Vector3D acceleration,
        ReadOnlySpan<int> supports = default,
        in Vector3D cubic = default,
        in Vector3D quartic = default,
        in Vector3D quintic = default,
        in Hold hold = default,
        SimDuration nextStep = default,
        in Vector3D spin = default,
        in Vector3D spinRate = default,
        SimTime centre = default,
        SimTime stillSince = default,
        ReadOnlySpan<PersistentContact> contacts = default,
        CollisionFilter? filter = null,
        ReadOnlySpan<int> inside = default,
        ReadOnlySpan<Crossing> crossings = default,
        PeerSet players = default)
    {
        if (supports.Length > MaxSupports)
        {
            throw new ArgumentException($"{supports.Length} planes carry body {id}; at most {MaxSupports} can.", nameof(supports));
        }

        Id = id;
        Spec = spec;
        Opened = opened;
        Span<int> planes = stackalloc int[] { 0, 0, 0 };
        supports.CopyTo(planes);
        SupportSet set = new(supports.Length, planes[0], planes[1], planes[2]);
        Segment = new MotionSegment(law, epoch, end, position, velocity, acceleration, set);
        Dense = new DenseOutput(cubic, quartic, quintic, nextStep);
        Hold = hold;
        SpinPath = new Spin(spin, spinRate);
        Centre = centre;
        StillSince = stillSince;
        ContactArray = contacts.ToArray();
        Filter = filter ?? spec.Filter;
        Players = players;
        InsideArray = inside.ToArray();
        CrossingArray = crossings.ToArray();
    }

    internal BodySnapshot(BodyId id, in BodySpec spec, in EventKey opened, in MotionSegment segment, in DenseOutput dense, in Hold hold, in Spin spin, SimTime centre,
        SimTime stillSince, PersistentContact[] contacts, CollisionFilter filter, int[] inside, Crossing[] crossings, PeerSet players)
    {
        Id = id;
        Spec = spec;
        Opened = opened;
        Segment = segment;
        Dense = dense;
        Hold = hold;
        SpinPath = spin;
        Centre = centre;
        StillSince = stillSince;
        ContactArray = contacts;
        Filter = filter;
        InsideArray = inside;
        CrossingArray = crossings;
        Players = players;
    }

    /// <summary>The identity of the body.</summary>
    public BodyId Id { get; }

    /// <summary>The spec of the body.</summary>
    public BodySpec Spec { get; }

    /// <summary>The event that opened this segment.</summary>
    public EventKey Opened { get; }

    /// <summary>How it moves on it.</summary>
    public MotionLaw Law => Segment.Law;

    /// <summary>The instant at which the state below holds.</summary>
    public SimTime Epoch => Segment.Epoch;

    /// <summary>The last instant for which the path's formula was made; <see cref="SimTime.MaxValue"/>: none.</summary>
    public SimTime End => Segment.End;

    /// <summary>The position at the epoch, in metres.</summary>
    public Vector3D Position => Segment.Position;

    /// <summary>The velocity at the epoch, in m/s.</summary>
    public Vector3D Velocity => Segment.Velocity;

    /// <summary>The acceleration at the epoch, in m/s^2.</summary>
    public Vector3D Acceleration => Segment.Acceleration;

    /// <summary>How many planes carry it.</summary>
    public int SupportCount => Segment.Supports.Count;

    /// <summary>
    /// For a member of an island, the instant that its velocity belongs to, the middle of a contact step; the default for any other.
    /// </summary>
    public SimTime Centre { get; }

    /// <summary>For a member of an island, the instant since which it has not moved; the default for any other.</summary>
    public SimTime StillSince { get; }

    /// <summary>For a member of an island, the contacts that it carries from step to step; none for any other.</summary>
    public ReadOnlySpan<PersistentContact> Contacts => ContactArray;

    /// <summary>What it collides with now: that of its spec, unless it was changed.</summary>
    public CollisionFilter Filter { get; }

    /// <summary>Which peers may do something to it, if it was spawned; everyone for a body of the scene, which has its own rights.</summary>
    public PeerSet Players { get; }

    internal PersistentContact[] ContactArray { get; }

    /// <summary>The sensors that it is inside of, by ascending index in the scene.</summary>
    public ReadOnlySpan<int> Inside => InsideArray;

    /// <summary>The sensors that it has crossed since its path was opened, in canonical order.</summary>
    public ReadOnlySpan<Crossing> Crossings => CrossingArray;

    internal int[] InsideArray { get; }

    internal Crossing[] CrossingArray { get; }

    /// <summary>For an integrated step or a held path, the coefficient of t^3, in m/s^3; zero for any other.</summary>
    public Vector3D Cubic => Dense.Cubic;

    /// <summary>For an integrated step, the coefficient of t^4, in m/s^4; zero for any other.</summary>
    public Vector3D Quartic => Dense.Quartic;

    /// <summary>For an integrated step, the coefficient of t^5, in m/s^5; zero for any other.</summary>
    public Vector3D Quintic => Dense.Quintic;

    /// <summary>For a step under error control, the proposed length of the next; zero for any other.</summary>
    public SimDuration NextStep => Dense.NextStep;

    /// <summary>The hold on a held body; the default for any other.</summary>
    public Hold Hold { get; }

    /// <summary>How the body turns at the epoch, in rad/s.</summary>
    public Vector3D Spin => SpinPath.AtEpoch;

    /// <summary>The change of its spin on this segment, in rad/s².</summary>
    public Vector3D SpinRate => SpinPath.Rate;

    internal Spin SpinPath { get; }

    internal MotionSegment Segment { get; }

    internal DenseOutput Dense { get; }

    /// <summary>The index in the scene of the n-th plane that carries it.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such one.</exception>
    public int Support(int n) =>
        n >= 0 && n < SupportCount ? Segment.Supports[n] : throw new ArgumentOutOfRangeException(nameof(n), n, $"{Limits.Count(SupportCount, "plane carries", "planes carry")} body {Id}.");
}
