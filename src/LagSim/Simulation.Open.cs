using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>Opening a segment: which law a body follows from a state on.</content>
public sealed partial class Simulation
{
    /// <summary>All of time, from its least to its largest value, in seconds.</summary>
    private const double LongestSpan = 1L << 24;

    /// <summary>
    /// Opens the body's next segment from a state that holds <paramref name="carry"/> seconds before the key's tick (under a tick, either
    /// way): at rest on or sliding along those of the touched planes that carry it, else in free flight.
    /// </summary>
    private void Open(
        int slot, in EventKey key, in Vector3D position, in Vector3D velocity, double carry, Span<int> touchedPlanes, in Vector3D spin)
    {
        if (touchedPlanes.Length > 0 && TryOpenSupported(slot, key, position, velocity, carry, touchedPlanes, spin))
        {
            return;
        }

        Vector3D x = position;
        Vector3D v = velocity;
        if (carry != 0)
        {
            Vector3D a = forces.On(bodies.Id(slot)).At(bodies.Spec(slot), key.Time, -carry, position, velocity, spin);
            x += (v + (a * (0.5 * carry))) * carry;
            v += a * carry;
        }

        OpenFlight(slot, key, x, v, spin);
    }

    private void OpenFlight(int slot, in EventKey key, in Vector3D position, in Vector3D velocity, in Vector3D spin = default)
    {
        Vector3D x = Scene.Box.Wrap(position.WithoutNegativeZero());
        Vector3D v = velocity.WithoutNegativeZero();
        ref readonly BodySpec spec = ref bodies.Spec(slot);
        CheckState(slot, key, x, v);
        if (spec.Flight == MotionLaw.Ballistic)
        {
            SimTime end = Scene.Box.Exists ? EndOfFlight(key.Time, v) : EndOfRange(key.Time, v, Scene.Gravity);
            Append(slot, key, new MotionSegment(MotionLaw.Ballistic, key.Time, end, x, v, Scene.Gravity), default, spin: new Spin(spin));
        }
        else
        {
            MotionSegment piece = PieceOfFlight(slot, key.Time, x, v, spin, out DenseOutput dense);
            Append(slot, key, piece, dense, spin: new Spin(spin));
        }
    }

    /// <summary>The first piece of a flight that is no parabola: a step of an integrator, or as much of a closed form as a polynomial follows.</summary>
    private MotionSegment PieceOfFlight(int slot, SimTime from, in Vector3D x, in Vector3D v, in Vector3D spin, out DenseOutput dense)
    {
        ref readonly BodySpec spec = ref bodies.Spec(slot);
        double tooStiff = 0;
        double tooLarge = 0;
        Forces on = forces.On(bodies.Id(slot));
        MotionSegment piece = spec.Flight switch
        {
            MotionLaw.RungeKutta4 => RungeKutta4.Step(on, spec, from, x, v, spin, out dense, out tooStiff),
            MotionLaw.ClosedForm when FlightLaws.AreLinear(spec, Scene.ForceArray) => new LinearFlight(Scene, spec, spin).Piece(on, from, x, v, out dense),
            MotionLaw.ClosedForm => new KeplerFlight(Scene, spec).Piece(from, x, v, out dense, out tooLarge),
            _ => DormandPrince54.Step(on, spec, from, x, v, spin, StepToTry(slot), out dense, out tooLarge, out tooStiff),
        };
        if (!piece.Acceleration.IsFinite || !dense.IsFinite || tooStiff > 0 || tooLarge > 0)
        {
            throw TooMuch(slot, from, x, v, spin, tooStiff, tooLarge, piece.Acceleration.IsFinite);
        }

        return piece;
    }

    /// <summary>What the step before proposes, if there was one; else nothing.</summary>
    private SimDuration StepToTry(int slot)
    {
        int last = timelines.Last(slot);
        return last == TimelineStore.None || timelines.Segment(last).Law != MotionLaw.DormandPrince54 ? SimDuration.Zero : timelines.Dense(last).NextStep;
    }

    /// <summary>A body with the law of flight that it asks for, or that is the cheapest for it.</summary>
    private BodySpec Chosen(in BodySpec spec)
    {
        MotionLaw law = FlightLaws.Chosen(spec, Scene.Gravity, Scene.ForceArray);
        return law == spec.Flight ? spec : spec.With(law);
    }

    /// <summary>
    /// Rest or sliding, if after the impact no bounce is left that the scene resolves. The bounces that remain rise at most w^2 / 2a and last
    /// 2w / (a (1 - e)) in all, for a rebound at speed w pressed back by a: below the scene's resolution they are left out, the body is put on
    /// the plane, and it rests from the end of that time on. Tangential motion goes on unchanged: frictionless bounces do not touch it.
    /// </summary>
    private bool TryOpenSupported(
        int slot, in EventKey key, in Vector3D position, in Vector3D velocity, double carry, Span<int> touchedPlanes, in Vector3D spin)
    {
        if (!bodies.Spec(slot).Forces.IsEmpty)
        {
            return false;
        }

        Span<int> slow = touchedPlanes.Length <= 8 ? stackalloc int[8] : new int[touchedPlanes.Length];
        int count = 0;
        foreach (int plane in touchedPlanes)
        {
            double rebound = Vector3D.Dot(surfaces.Plane(plane).Normal, velocity);
            if (Math.Abs(rebound) <= UnresolvedSpeed(plane))
            {
                slow[count++] = plane;
            }
        }

        if (count == 0)
        {
            return false; // as after nearly every bounce
        }

        SupportSet supports = PlaneSupport.Solve(slow.Slice(0, count), Scene.PlaneArray, Scene.Gravity, out Vector3D acceleration);
        if (supports.Count == 0)
        {
            return false;
        }

        SimDuration left = BouncesLeft(slot, supports, velocity);
        Vector3D tangential = PlaneSupport.Tangential(velocity, supports, Scene.PlaneArray);
        Vector3D start = OntoSupports(slot, supports, position + (tangential * carry));
        tangential = (tangential + (acceleration * carry)).WithoutNegativeZero();
        CheckState(slot, key, start, tangential);
        if (supports.Count == 1 && FrictionOn(slot, supports[0]) > 0)
        {
            OpenRubbing(slot, key, start, tangential, spin, supports, acceleration, left);
            return true;
        }

        bool rests = tangential == Vector3D.Zero && acceleration == Vector3D.Zero;
        if (rests && left == SimDuration.Zero)
        {
            Append(slot, key, MotionSegment.AtRest(key.Time, start, supports), default, spin: new Spin(spin));
        }
        else
        {
            SimTime end = rests ? key.Time + left : EndOfRange(key.Time, tangential, acceleration);
            MotionSegment slide = new(MotionLaw.Sliding, key.Time, end, start, tangential, acceleration, supports);
            Append(slot, key, slide, default, spin: new Spin(spin));
        }

        return true;
    }

    /// <summary>The rebound speed below which a bounce on the plane rises less than the scene resolves.</summary>
    private double UnresolvedSpeed(int plane)
    {
        double pressing = -Vector3D.Dot(surfaces.Plane(plane).Normal, Scene.Gravity);
        return Math.Sqrt(2 * Scene.Resolution * (pressing > 0 ? pressing : Scene.Gravity.Length));
    }

    /// <summary>How long the bounces that are left out would have lasted; zero for what never loses speed, or has none.</summary>
    private SimDuration BouncesLeft(int slot, SupportSet supports, in Vector3D velocity)
    {
        double longest = 0;
        for (int k = 0; k < supports.Count; k++)
        {
            ref readonly StaticPlane plane = ref surfaces.Plane(supports[k]);
            double rebound = Vector3D.Dot(plane.Normal, velocity);
            double pressing = -Vector3D.Dot(plane.Normal, Scene.Gravity);
            double restitution = Math.Min(plane.Restitution, bodies.Spec(slot).Restitution);
            if (rebound > 0 && pressing > 0 && restitution < 1)
            {
                longest = Math.Max(longest, 2 * rebound / (pressing * (1 - restitution)));
            }
        }

        return TickConversion.TryFromSeconds(longest, out long ticks) ? SimDuration.FromTicks(ticks) : SimDuration.Zero;
    }

    /// <summary>The limit of the bounces lies on the plane; only what a bounce below the resolution leaves is taken away, never a real overlap.</summary>
    private Vector3D OntoSupports(int slot, SupportSet supports, in Vector3D position)
    {
        Vector3D onto = position;
        for (int k = 0; k < supports.Count; k++)
        {
            ref readonly StaticPlane plane = ref surfaces.Plane(supports[k]);
            double gap = plane.Gap(onto, bodies.Spec(slot).Radius);
            if (Math.Abs(gap) <= Scene.Resolution)
            {
                onto -= plane.Normal * gap;
            }
        }

        return onto.WithoutNegativeZero();
    }

    /// <summary>
    /// When a closed form would exceed the permitted speed: the root of |v + a t| = limit, which there is one of. Beyond the range of a time
    /// for anything but the smallest bodies and the strongest gravity.
    /// </summary>
    private SimTime EndOfRange(SimTime from, in Vector3D velocity, in Vector3D acceleration)
    {
        double limit = Limits.MaxSpeed(Scene.SmallestRadius);
        double a = acceleration.LengthSquared;
        if (4 * velocity.LengthSquared <= limit * limit && 4 * a * LongestSpan * LongestSpan <= limit * limit)
        {
            return SimTime.MaxValue; // neither half can fill the limit
        }

        double b = Vector3D.Dot(velocity, acceleration);
        double c = velocity.LengthSquared - (limit * limit);
        double root = Math.Sqrt((b * b) - (a * c));
        double seconds = b > 0 ? -c / (b + root) : (root - b) / a; // 0 / 0 without acceleration
        return TickConversion.TryFromSeconds(seconds, out long ticks) && ticks <= SimTime.MaxValue.Ticks - Math.Max(0, from.Ticks)
            ? from + SimDuration.FromTicks(ticks)
            : SimTime.MaxValue;
    }

    /// <summary>
    /// When a flight in a periodic box is opened anew: after an eighth of the least side. Two bodies come nearer by at most a quarter of it then, and touch at
    /// less than another quarter, so that whichever image is nearest when both paths are open is the one that they can meet.
    /// </summary>
    private SimTime EndOfFlight(SimTime from, in Vector3D velocity)
    {
        double seconds = PeriodicBox.FlightPart * Scene.Box.LeastSide / velocity.Length;
        return TickConversion.TryFromSeconds(seconds, out long ticks) && ticks <= SimTime.MaxValue.Ticks - Math.Max(0, from.Ticks)
            ? from + SimDuration.FromTicks(ticks)
            : SimTime.MaxValue;
    }

    private void CheckState(int slot, in EventKey key, in Vector3D position, in Vector3D velocity)
    {
        double limit = Limits.MaxSpeed(Scene.SmallestRadius);
        if (!position.IsFinite || !(velocity.Length <= limit))
        {
            throw new SimulationException(
                $"At {key.Time.ToShortString()} {Whose(slot)} is at {position} m with {velocity} m/s; a position must stay finite, and a speed at most "
                + $"{Limits.Text(limit)} m/s, a fifth of the smallest radius in a tick.");
        }
    }
}
