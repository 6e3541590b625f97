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
internal sealed class IslandStep
{
    /// <summary>As long as a step is where nothing asks for less: 2^-9 s, some 2 ms.</summary>
    internal static readonly SimDuration Longest = SimDuration.FromTicks(1L << 31);

    /// <summary>No step is shorter than 2^-20 s, whatever asks for it.</summary>
    private const long Shortest = 1L << 20;

    /// <summary>By how much, in radians, the line between two centres may turn in a step.</summary>
    private const double MostTurn = 1.0 / 128;

    /// <summary>So far, in lengths of what touches, an acceleration may carry within a step; and so far a force's own rate.</summary>
    private const double MostFall = 1.0 / 1024;

    private const double MostRateTimesStep = 1.0 / 16;

    /// <summary>A contact that changes a speed by less than this part of what gravity and forces do does not push.</summary>
    private const double LeastPush = 1e-9;

    /// <summary>
    /// So many of the scene's resolutions deep at most what lasts may get on the way, 100 nm by default: else the step is taken anew, half as long.
    /// </summary>
    private const double MostDepth = 100;

    /// <summary>What closes, or turns on its surface, slower than this, in m/s, is rounding.</summary>
    private const double Still = 1e-10;

    /// <summary>So often at most the normals' turning is taken in anew; each time it is right to two orders more.</summary>
    private const int MostRefinements = 8;

    /// <summary>
    /// So many turns the solver may take where it is asked who rests: a tower that leans is held by the rolling resistance of all its contacts together, which
    /// comes to light slowly, and what is left over moves it for ever.
    /// </summary>
    private const int RestTurns = 64;

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
    internal int AddBody(in BodySpec spec, in Vector3D position, in Vector3D velocity, in Vector3D spin)
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

        members[BodyCount] = new Member { Spec = spec, Start = position, GivenVelocity = velocity, GivenSpin = spin };
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
        for (long ticks = Length.Ticks / 2; ticks >= Shortest && !MayBeDeep && Depth(closing) > MostDepth * scene.Resolution; ticks /= 2)
        {
            TakeFor(time, SimDuration.FromTicks(ticks), fromRest: false);
        }
    }

    /// <summary>Takes the step as if nobody moved.</summary>
    /// <remarks>What is apart by less than the scene resolves touches then, and nothing sinks into that.</remarks>
    internal void TakeFromRest(SimTime time) => TakeWith(time, fromRest: true);

    private void TakeWith(SimTime time, bool fromRest)
    {
        for (int b = 0; b < BodyCount; b++)
        {
            ref Member m = ref members[b];
            m.Velocity = fromRest ? Vector3D.Zero : m.StartVelocity;
            m.Acceleration = forces.At(m.Spec, time, 0, m.Start, m.Velocity, m.StartSpin);
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

    /// <summary>Stops what closes at the start by no more than so many m/s.</summary>
    private void Settle(double closing)
    {
        for (int b = 0; b < BodyCount; b++)
        {
            velocities[b] = members[b].StartVelocity;
            spins[b] = members[b].StartSpin;
        }

        bool closes = false;
        int count = 0;
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly Touch t = ref touches[i];
            ContactPoint point = new(t.First, t.Second, t.Surface, default) { Normal = Normal(t, atEnd: false) };
            double opening = ImpactSolver.Opening(point, velocities.AsSpan(0, BodyCount));
            if (opening >= -closing)
            {
                points[count] = point;
                rubs[count++] = new Rub { Friction = t.Friction };
                closes |= opening < -Still;
            }
        }

        if (!closes)
        {
            return;
        }

        Solve(count, LastingContactSolver.Start.Anew, isPatient: false);
        for (int b = 0; b < BodyCount; b++)
        {
            members[b].StartVelocity = velocities[b].WithoutNegativeZero();
            members[b].StartSpin = spins[b];
        }
    }

    /// <summary>The first half: impulses that keep the gaps open, and where they lead.</summary>
    private void Move(double h, bool fromRest)
    {
        for (int i = 0; i < ContactCount; i++)
        {
            ref Touch t = ref touches[i];
            t.Gap = Gap(t, atEnd: false);
            points[i] = new ContactPoint(t.First, t.Second, t.Surface, default) { Normal = Normal(t, atEnd: false) };
            rubs[i] = new Rub { Friction = t.Friction, Lever = t.Lever };
            t.Bend = 0;
        }

        for (int n = 0; n < MostRefinements; n++)
        {
            for (int b = 0; b < BodyCount; b++)
            {
                ref Member m = ref members[b];
                velocities[b] = m.Velocity + (m.Acceleration * (0.5 * h));
                spins[b] = m.StartSpin;
            }

            for (int i = 0; i < ContactCount; i++)
            {
                ref readonly Touch t = ref touches[i];
                points[i].Target = (fromRest ? 0 : (Math.Min(0, t.Gap) - t.Gap) / h) - t.Bend;
                points[i].Restored = points[i].Target;
            }

            Solve(ContactCount, n == 0 ? LastingContactSolver.Start.Anew : LastingContactSolver.Start.Again, isPatient: fromRest);
            for (int b = 0; b < BodyCount; b++)
            {
                ref Member m = ref members[b];
                m.Middle = velocities[b];
                m.MiddleSpin = spins[b];
                m.End = m.Start + (velocities[b] * h);
            }

            if (!AreBent(h))
            {
                break;
            }
        }

        for (int i = 0; i < ContactCount; i++)
        {
            touches[i].Push = points[i].Impulse;
        }
    }

    /// <summary>By how much the gaps open more than the normals at the start tell; whether that has changed by more than rounding.</summary>
    private bool AreBent(double h)
    {
        bool has = false;
        for (int i = 0; i < ContactCount; i++)
        {
            ref Touch t = ref touches[i];
            if (t.Second == ContactPoint.Static && t.Surface < scene.PlaneArray.Length)
            {
                continue;
            }

            double opened = ImpactSolver.Opening(points[i], velocities.AsSpan(0, BodyCount));
            double bend = ((Gap(t, atEnd: true) - t.Gap) / h) - opened;
            has |= Math.Abs(bend - t.Bend) * h > Rounding * Reach(t);
            t.Bend = bend;
        }

        return has;
    }

    /// <summary>What of a length in parts of what touches is rounding.</summary>
    private const double Rounding = 1e-13;

    /// <summary>
    /// The second half: impulses along the normals where the step has led, of contacts that have pushed or have no gap, so that they do not close.
    /// </summary>
    private void Kick(SimTime time, double h, bool fromRest)
    {
        for (int b = 0; b < BodyCount; b++)
        {
            ref Member m = ref members[b];
            Vector3D a = m.Spec.Forces.IsEmpty ? scene.Gravity
                : forces.At(m.Spec, time, h, m.End, m.Middle + (m.Acceleration * (0.5 * h)), m.MiddleSpin);
            velocities[b] = m.Middle + (a * (0.5 * h));
            spins[b] = m.MiddleSpin;
        }

        int count = 0;
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly Touch t = ref touches[i];
            if (t.Push > 0 || Gap(t, atEnd: true) <= 0)
            {
                Vector3D normal = Normal(t, atEnd: true);
                points[count] = new ContactPoint(t.First, t.Second, t.Surface, default) { Normal = normal, Impulse = t.Push };
                rubs[count] = rubs[i];
                rubs[count].Push -= normal * Vector3D.Dot(normal, rubs[count].Push);
                closed[count++] = i;
            }
        }

        if (count > 0)
        {
            Solve(count, LastingContactSolver.Start.Near, isPatient: fromRest);
        }

        for (int k = 0; k < count; k++)
        {
            touches[closed[k]].Push += points[k].Impulse;
        }

        for (int b = 0; b < BodyCount; b++)
        {
            members[b].EndVelocity = velocities[b];
            members[b].EndSpin = spins[b];
        }

        StopTurning();
    }

    /// <summary>
    /// What turns by no more than rounding, and by less than resistance takes in the step, turns no more, as on a plane by closed form: else what the solver
    /// leaves would be a part of what it was each time, down to the least of all numbers, and never nothing.
    /// </summary>
    private void StopTurning()
    {
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly Touch t = ref touches[i];
            double taken = t.Lever * t.Push;
            bool isPair = t.Second != ContactPoint.Static;
            if (taken > 0 && IsStopped(t.First, taken) && (!isPair || IsStopped(t.Second, taken)))
            {
                members[t.First].EndSpin = Vector3D.Zero;
                if (isPair)
                {
                    members[t.Second].EndSpin = Vector3D.Zero;
                }
            }
        }
    }

    private bool IsStopped(int body, double taken)
    {
        double spin = members[body].EndSpin.Length;
        return spin * radii[body] <= Still && spin * masses[body] * radii[body] * radii[body] <= ImpactFriction.TurnPerImpulse * taken;
    }

    /// <summary>
    /// How much deeper in each other than at the start two get between the two ends, at most, of those that last: nobody looks for an impact of theirs. Where a
    /// contact is closed at both ends, but opens at the later one, for what pressed it has ceased to, the cubic has it closed on the way: by 4/27 of that speed
    /// times the step, at 2/3 of it; by as much at 1/3 where it closes from the start on.
    /// </summary>
    private double Depth(double closing)
    {
        double most = 0;
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly Touch t = ref touches[i];
            Vector3D other = t.Second == ContactPoint.Static ? Vector3D.Zero : members[t.Second].Velocity;
            double opening = Vector3D.Dot(Normal(t, atEnd: false), members[t.First].Velocity - other);
            if (Math.Abs(opening) <= closing)
            {
                most = Math.Max(most, Math.Min(0, t.Gap) - Math.Min(Gap(t, 1.0 / 3), Gap(t, 2.0 / 3)));
            }
        }

        return most;
    }

    private void Solve(int count, LastingContactSolver.Start start, bool isPatient) => solver.Solve(
        points.AsSpan(0, count), rubs.AsSpan(0, count), masses.AsSpan(0, BodyCount), radii.AsSpan(0, BodyCount), velocities.AsSpan(0, BodyCount),
        spins.AsSpan(0, BodyCount), start, isPatient ? RestTurns : LastingContactSolver.UsualTurns);

    /// <summary>A power of two of ticks, so short that in the step no normal turns far and no force changes much.</summary>
    private long Ticks()
    {
        double seconds = Longest.ToSeconds();
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly Touch t = ref touches[i];
            if (t.Second == ContactPoint.Static && t.Surface < scene.PlaneArray.Length)
            {
                continue; // its normal never turns
            }

            Vector3D other = t.Second == ContactPoint.Static ? Vector3D.Zero : members[t.Second].Velocity;
            double speed = (members[t.First].Velocity - other).Length;
            double pull = members[t.First].Acceleration.Length + (t.Second == ContactPoint.Static ? 0 : members[t.Second].Acceleration.Length);
            double reach = Reach(t);
            seconds = speed > 0 ? Math.Min(seconds, MostTurn * reach / speed) : seconds;
            seconds = pull > 0 ? Math.Min(seconds, Math.Sqrt(MostFall * reach / pull)) : seconds;
        }

        for (int b = 0; b < BodyCount; b++)
        {
            ref readonly Member m = ref members[b];
            double rate = forces.RateAt(m.Spec, m.Start, m.Velocity, m.StartSpin);
            seconds = rate > 0 ? Math.Min(seconds, MostRateTimesStep / rate) : seconds;
        }

        long ticks = Longest.Ticks;
        while (ticks > Shortest && ticks > seconds * SimDuration.TicksPerSecond)
        {
            ticks >>= 1;
        }

        return ticks;
    }

    private double Reach(in Touch t) =>
        radii[t.First] + (t.Second == ContactPoint.Static ? scene.SphereArray[t.Surface - scene.PlaneArray.Length].Radius : radii[t.Second]);

    private double Gap(in Touch t, bool atEnd) => Gap(t, Place(t.First, atEnd), t.Second == ContactPoint.Static ? Vector3D.Zero : Place(t.Second, atEnd));

    /// <summary>The gap on the way, where that part of the step is over.</summary>
    private double Gap(in Touch t, double part) => Gap(t, Place(t.First, part), t.Second == ContactPoint.Static ? Vector3D.Zero : Place(t.Second, part));

    private double Gap(in Touch t, in Vector3D at, in Vector3D other)
    {
        if (t.Second != ContactPoint.Static)
        {
            return (at - other).Length - Reach(t);
        }

        return t.Surface < scene.PlaneArray.Length
            ? scene.PlaneArray[t.Surface].Gap(at, radii[t.First])
            : (at - scene.SphereArray[t.Surface - scene.PlaneArray.Length].Centre).Length - Reach(t);
    }

    private Vector3D Normal(in Touch t, bool atEnd)
    {
        if (t.Second == ContactPoint.Static && t.Surface < scene.PlaneArray.Length)
        {
            return scene.PlaneArray[t.Surface].Normal;
        }

        Vector3D apart = Place(t.First, atEnd)
            - (t.Second == ContactPoint.Static ? scene.SphereArray[t.Surface - scene.PlaneArray.Length].Centre : Place(t.Second, atEnd));
        double length = apart.Length;
        return length > 0 ? apart / length : Vector3D.Up;
    }

    private Vector3D Place(int body, bool atEnd) => atEnd ? members[body].End : members[body].Start;

    /// <summary>On the cubic with the positions and velocities of both ends.</summary>
    private Vector3D Place(int body, double part)
    {
        ref readonly Member m = ref members[body];
        double left = 1 - part;
        Vector3D way = (m.Middle * (part * part * (3 - (2 * part)))) + (((m.Velocity * left) - (m.EndVelocity * part)) * (part * left));
        return m.Start + (way * Length.ToSeconds());
    }

    /// <summary>One body in the step.</summary>
    private struct Member
    {
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
