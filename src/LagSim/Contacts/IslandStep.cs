using System;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Contacts;

/// <summary>One step of bodies in lasting contact: where they are after it, and which contacts have pushed.</summary>
/// <remarks>
/// <para>The method is RATTLE (Andersen 1983, J. Comput. Phys. 52, 24-34) for contacts that push and do not pull: half a kick and impulses along the normals at
/// the start of the step, so that at its end no gap is below zero, or smaller than it was if it was below; half a kick and impulses along the normals at its
/// end, so that nothing closes. Of order 2, without drift, and without friction it neither makes nor loses energy but by what a contact takes that begins to
/// push. Each half is one solution of all contacts together with their friction.</para>
/// <para>Between the two ends the path is a cubic with the positions and velocities of both.</para>
/// <para>Deterministic; the order of bodies and contacts counts, so both come in canonical order. Cost: some four times that of <see
/// cref="LastingContactSolver"/>. Allocates only when an island has more bodies or contacts than any before.</para>
/// </remarks>
internal sealed partial class IslandStep
{
    /// <summary>As long as a step is where nothing asks for less: 2^-9 s, some 2 ms.</summary>
    internal static readonly SimDuration Longest = SimDuration.FromTicks(1L << 31);

    /// <summary>A contact that changes a speed by less than this part of what gravity and forces do does not push.</summary>
    private const double LeastPush = 1e-9;

    private readonly Scene scene;
    private readonly Forces forces;
    private readonly LastingContactSolver solver = new();
    private Member[] members = Array.Empty<Member>();
    private Touch[] touches = Array.Empty<Touch>();
    private double[] masses = Array.Empty<double>();
    private double[] radii = Array.Empty<double>();
    private Vector3D[] velocities = Array.Empty<Vector3D>();
    private Vector3D[] spins = Array.Empty<Vector3D>();
    private ContactPoint[] points = Array.Empty<ContactPoint>();
    private Rub[] rubs = Array.Empty<Rub>();
    private int[] closed = Array.Empty<int>();

    internal IslandStep(Scene scene, Forces forces)
    {
        this.scene = scene;
        this.forces = forces;
    }

    /// <summary>How many bodies take part.</summary>
    internal int BodyCount { get; private set; }

    /// <summary>How many contacts there are.</summary>
    internal int ContactCount { get; private set; }

    /// <summary>How long the step is.</summary>
    internal SimDuration Length { get; private set; }

    /// <summary>Whether a contact has friction.</summary>
    internal bool Rubs { get; private set; }

    /// <summary>Takes no step anew, however deep what lasts gets on the way: only a test's negative control sets it.</summary>
    internal bool MayBeDeep { get; set; }

    /// <summary>Begins anew, with nobody.</summary>
    internal void Clear()
    {
        BodyCount = 0;
        ContactCount = 0;
        Rubs = false;
    }

    /// <summary>Adds a body; returns its number.</summary>
    internal int AddBody(BodyId id, in BodySpec spec, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        if (BodyCount == members.Length)
        {
            int size = Math.Max(4, BodyCount * 2);
            Array.Resize(ref members, size);
            Array.Resize(ref masses, size);
            Array.Resize(ref radii, size);
            Array.Resize(ref velocities, size);
            Array.Resize(ref spins, size);
        }

        members[BodyCount] = new Member { Id = id, Spec = spec, Start = position, GivenVelocity = velocity, GivenSpin = spin };
        masses[BodyCount] = spec.Mass;
        radii[BodyCount] = spec.Radius;
        return BodyCount++;
    }

    /// <summary>Adds a contact of a body with another, or with a static surface: planes by index, static spheres after them.</summary>
    internal void AddContact(int first, int second, int surface, double friction, double lever)
    {
        if (ContactCount == touches.Length)
        {
            int size = Math.Max(8, ContactCount * 2);
            Array.Resize(ref touches, size);
            Array.Resize(ref points, size);
            Array.Resize(ref rubs, size);
            Array.Resize(ref closed, size);
        }

        touches[ContactCount++] = new Touch { First = first, Second = second, Surface = surface, Friction = friction, Lever = lever };
        Rubs |= friction > 0;
    }

    /// <summary>
    /// Takes the step from <paramref name="time"/> on. Before it what closes by no more than so many m/s is stopped without a rebound; what is faster has an
    /// impact of its own to come.
    /// </summary>
    internal void Take(SimTime time, double closing)
    {
        for (int b = 0; b < BodyCount; b++)
        {
            ref Member m = ref members[b];
            m.StartVelocity = m.GivenVelocity;
            m.StartSpin = m.GivenSpin;
        }

        Settle(closing);
        TakeWith(time, fromRest: false);
        for (long ticks = Length.Ticks / 2; ticks >= Shortest && (IsTooStiff() || (!MayBeDeep && Depth(closing) > MostDepth * scene.Resolution)); ticks /= 2)
        {
            TakeFor(time, SimDuration.FromTicks(ticks), fromRest: false);
        }
    }

    /// <summary>
    /// At which rate in 1/s the forces on a body act, where even the shortest step does not follow that: the step is then not to be used. Else zero. What has no
    /// number is infinite.
    /// </summary>
    internal double RateNotFollowed(int body) => IsTooStiff(body, out double rate) ? (double.IsNaN(rate) ? double.PositiveInfinity : rate) : 0;

    /// <summary>The fastest rate, in 1/s, that the shortest steps follow.</summary>
    internal static double MostRateFollowed => StableRateTimesStep / SimDuration.FromTicks(Shortest).ToSeconds();

    /// <summary>Takes the step as if nobody moved.</summary>
    internal void TakeFromRest(SimTime time) => TakeWith(time, fromRest: true);

    private void TakeWith(SimTime time, bool fromRest)
    {
        for (int b = 0; b < BodyCount; b++)
        {
            ref Member m = ref members[b];
            m.Velocity = fromRest ? Vector3D.Zero : m.StartVelocity;
            m.Acceleration = forces.On(m.Id).At(m.Spec, time, 0, m.Start, m.Velocity, m.StartSpin);
        }

        TakeFor(time, SimDuration.FromTicks(Ticks()), fromRest);
    }

    private void TakeFor(SimTime time, SimDuration length, bool fromRest)
    {
        Length = length;
        Move(length.ToSeconds(), fromRest);
        Kick(time, length.ToSeconds(), fromRest);
    }

    /// <summary>Whether another step is of the same bodies from the same states, to the bit, with the same contacts.</summary>
    internal bool IsFrom(IslandStep other)
    {
        bool isSame = BodyCount == other.BodyCount && ContactCount == other.ContactCount;
        for (int b = 0; b < BodyCount && isSame; b++)
        {
            ref readonly Member m = ref members[b];
            ref readonly Member o = ref other.members[b];
            isSame = m.Start.Equals(o.Start) && m.GivenVelocity.Equals(o.GivenVelocity) && m.GivenSpin.Equals(o.GivenSpin) && m.Spec.Equals(o.Spec);
        }

        for (int i = 0; i < ContactCount && isSame; i++)
        {
            ref readonly Touch t = ref touches[i];
            ref readonly Touch o = ref other.touches[i];
            isSame = t.First == o.First && t.Second == o.Second && t.Surface == o.Surface && t.Friction == o.Friction && t.Lever == o.Lever;
        }

        return isSame;
    }

    /// <summary>Whether a contact pushes in the step, by more than rounding.</summary>
    internal bool Pushes(int contact)
    {
        ref readonly Touch t = ref touches[contact];
        double inverse = (1 / masses[t.First]) + (t.Second == ContactPoint.Static ? 0 : 1 / masses[t.Second]);
        return t.Push * inverse > LeastPush * Length.ToSeconds() * Pull();
    }

    /// <summary>
    /// How fast a body gets in the step: at its middle or its end, on its surface or with its centre, whichever is most; in m/s. A spin that stays does not
    /// count, nor one that the step stops.
    /// </summary>
    internal double Stir(int body)
    {
        ref readonly Member m = ref members[body];
        double spin = Math.Min((m.EndSpin - m.StartSpin).Length, m.EndSpin.Length); // it turns on as it did, or not any more
        return Math.Max(Math.Max(m.Middle.Length, m.EndVelocity.Length), spin * radii[body]);
    }

    /// <summary>How a body turns at the end of the step, in rad/s.</summary>
    internal Vector3D EndSpin(int body) => members[body].EndSpin;

    /// <summary>The largest acceleration that anybody would have if nothing touched him, in m/s².</summary>
    internal double Pull()
    {
        double most = 0;
        for (int b = 0; b < BodyCount; b++)
        {
            most = Math.Max(most, members[b].Acceleration.Length);
        }

        return most;
    }

    /// <summary>The path of a body on the step that was taken, and how it turns.</summary>
    internal MotionSegment PathOf(int body, SimTime time, int crowding, out DenseOutput dense, out Spin spin)
    {
        ref readonly Member m = ref members[body];
        double h = Length.ToSeconds();
        Vector3D way = m.Middle * h; // the position's change, not yet lost in the position
        Vector3D quadratic = ((way * 3) - (((m.Velocity * 2) + m.EndVelocity) * h)) / (h * h);
        dense = new DenseOutput((((m.Velocity + m.EndVelocity) * h) - (way * 2)) / (h * h * h), Vector3D.Zero, Vector3D.Zero);
        spin = new Spin(m.StartSpin, (m.EndSpin - m.StartSpin) / h);
        return new MotionSegment(
            MotionLaw.Constrained, time, time + Length, m.Start, m.Velocity, (quadratic * 2).WithoutNegativeZero(), crowding: crowding);
    }

    /// <summary>One body in the step.</summary>
    private struct Member
    {
        internal BodyId Id; // for what is told of an error
        internal BodySpec Spec;
        internal Vector3D Start;
        internal Vector3D GivenVelocity;
        internal Vector3D GivenSpin;
        internal Vector3D StartVelocity; // once nothing closes
        internal Vector3D StartSpin;
        internal Vector3D Velocity; // with which the step begins: that of the start, or none
        internal Vector3D Acceleration; // at the start, if nothing touched it
        internal Vector3D Middle; // the velocity with which it goes from the one end to the other
        internal Vector3D MiddleSpin;
        internal Vector3D End;
        internal Vector3D EndVelocity;
        internal Vector3D EndSpin;
    }

    /// <summary>One contact in the step.</summary>
    private struct Touch
    {
        internal int First;
        internal int Second;
        internal int Surface;
        internal double Friction;
        internal double Lever; // of rolling resistance
        internal double Gap; // at the start
        internal double Bend; // how much faster the gap opens in the mean than the normal at the start tells
        internal double Push; // the impulses of both halves, in N s
    }
}
