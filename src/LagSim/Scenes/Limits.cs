using System;
using System.Globalization;
using LagSim.Time;

namespace LagSim.Scenes;

/// <summary>The ranges of every value that enters the world, each checked in one place with a message that names the value.</summary>
/// <remarks>The owner of a value comes as any object that has a text, which is made only if there is an error.</remarks>
internal static class Limits
{
    internal const double MaxCoordinate = 1e12;
    internal const double MinRadius = 1e-9;
    internal const double MaxRadius = 1e9;
    internal const double MinMass = 1e-30;
    internal const double MaxMass = 1e30;

    /// <summary>
    /// The latest instant of a world: 7 x 2^20 s, which is 84 days. The rest of what a <see cref="SimTime"/> holds, 12 days, is room for what lies
    /// ahead of the present: steps, waits and looks ahead are instants too.
    /// </summary>
    internal static readonly SimTime LatestTime = SimTime.FromTicks(7L << 60);

    /// <summary>How far from the origin, before or after, a world may begin: 3 x 2^21 s, which is 72 days, so that one lasts 12 days at least.</summary>
    internal static readonly SimDuration FurthestStart = SimDuration.FromTicks(3L << 61);

    /// <summary>
    /// The fastest that forces may change a deviation, in 1/s: what is stiffer is not moved by steps of which there are millions a second.
    /// </summary>
    internal const double MaxRate = 1e6;

    /// <summary>The shortest step of any law: 16 ticks, 1.5e-11 s. A path that needs shorter ones is at a singularity.</summary>
    internal static readonly SimDuration ShortestStep = SimDuration.FromTicks(16);

    /// <summary>The largest coefficient of friction, which leaves friction to the other side of a contact.</summary>
    internal const double MaxFriction = 100;

    /// <summary>The greatest strength of a force, and of a hand in N and in W.</summary>
    internal const double MaxStrength = 1e30;

    private const int MaxPower = 4;

    internal static readonly SimDuration MinStep = SimDuration.FromSeconds(1e-6);
    internal static readonly SimDuration MaxStep = SimDuration.FromSeconds(1);

    /// <summary>Whether a world may begin at an instant.</summary>
    internal static bool IsStart(SimTime start) => start.Ticks >= -FurthestStart.Ticks && start.Ticks <= FurthestStart.Ticks;

    internal static void CheckSpec<T>(in BodySpec spec, T whose, in Vector3D gravity, Force[] forces)
    {
        InRange(spec.Radius, MinRadius, MaxRadius, whose, "radius", "m");
        InRange(spec.Mass, MinMass, MaxMass, whose, "mass", "kg");
        InRange(spec.Restitution, 0, 1, whose, "restitution", "(no unit)");
        InRange(spec.Tolerance, 0, 1, whose, "tolerance", "m");
        InRange(spec.Friction, 0, MaxFriction, whose, "friction", "(no unit)");
        InRange(spec.RollingResistance, 0, 1, whose, "rolling resistance", "(no unit)");
        if (spec.Flight is not (MotionLaw.Ballistic or MotionLaw.RungeKutta4 or MotionLaw.ClosedForm or MotionLaw.DormandPrince54 or MotionLaw.Automatic))
        {
            throw new SceneException(
                $"The motion law of {whose} is {spec.Flight}; a body flies by Ballistic, RungeKutta4, ClosedForm, DormandPrince54 or Automatic.");
        }

        if (spec.Step < MinStep || spec.Step > MaxStep)
        {
            throw new SceneException($"The integrator step of {whose} is {spec.Step.ToShortString()}; it must lie between 1 microsecond and 1 s.");
        }

        if (spec.Forces.UpTo > forces.Length)
        {
            throw new SceneException(
                $"{Capital($"{whose}")} names force {spec.Forces.UpTo - 1}, counted from 0, but the scene has {Forces(forces.Length)}. A ForceSet holds "
                + "numbers, of the scene whose AddForce gave it: take one of this scene.");
        }

        if (!spec.Forces.IsEmpty && spec.Flight == MotionLaw.Ballistic)
        {
            throw new SceneException(
                $"{Capital($"{whose}")} flies by Ballistic, which is exact for gravity alone, and names the forces {spec.Forces.NamesAmong(forces)}; use"
                + " Automatic, ClosedForm, DormandPrince54 or RungeKutta4.");
        }

        if (spec.Flight == MotionLaw.ClosedForm && !FlightLaws.HasClosedForm(spec, gravity, forces))
        {
            throw new SceneException(
                $"{Capital($"{whose}")} flies by ClosedForm and names the forces {spec.Forces.NamesAmong(forces)}; a closed form there is for linear drag,"
                + " springs, magnetic fields and Magnus forces together with gravity, and for one inverse-square pull without gravity. Use Automatic,"
                + " DormandPrince54 or RungeKutta4.");
        }

        CheckRate(spec, whose, gravity, forces);
    }

    /// <summary>
    /// No point of a body's surface turns faster than a body may be given to move, nor does a Magnus force turn its path faster than may be
    /// followed.
    /// </summary>
    internal static void CheckSpin<T>(in Vector3D spin, in BodySpec spec, double smallestRadius, T whose, Force[] forces)
    {
        Components(spin, double.MaxValue, whose, "spin", "rad/s");
        double limit = MaxGivenSpeed(smallestRadius) / spec.Radius;
        if (!(spin.Length <= limit))
        {
            throw new SceneException(
                $"The spin of {whose} is {spin} rad/s; at most {Text(limit)} rad/s is allowed, at which its surface moves as fast as a body may be given to.");
        }

        foreach (Force force in spec.Forces.Among(forces))
        {
            double rate = force.Kind == ForceKind.Magnus ? force.RateAt(spec.Mass, Vector3D.Zero, Vector3D.Zero, spin) : 0;
            if (!(rate <= MaxRate))
            {
                throw new SceneException(
                    $"On {whose}, of {Text(spec.Mass)} kg and with a spin of {spin} rad/s, force '{force.Name}', of strength {Text(force.Strength)}, acts at a"
                    + $" rate of {Text(rate)} 1/s; at most {Text(MaxRate)} 1/s is allowed.");
            }
        }
    }

    /// <summary>A force has a finite strength of the right sign, and a place within the world.</summary>
    internal static void CheckForce(Force force)
    {
        string whose = $"force '{force.Name}'";
        double least = force.Kind is ForceKind.Magnetic or ForceKind.Central or ForceKind.Magnus ? -MaxStrength : 0;
        (string strength, string unit, string vector, string vectorUnit) = force.Kind switch
        {
            ForceKind.LinearDrag => ("coefficient", "kg/s", "medium's velocity", "m/s"),
            ForceKind.QuadraticDrag => ("coefficient", "kg/m", "medium's velocity", "m/s"),
            ForceKind.Spring => ("stiffness", "N/m", "anchor", "m"),
            ForceKind.Magnetic => ("charge", "C", "field", "T"),
            ForceKind.Magnus => ("coefficient", "kg", "vector", ""),
            ForceKind.Central => ("strength", "m/s^2 at 1 m", "centre", "m"),
            _ => ("strength", "", "vector", ""), // a program's own force has neither
        };
        InRange(force.Strength, least, MaxStrength, whose, strength, unit);
        InRange(force.Damping, 0, MaxStrength, whose, "damping", "kg/s");
        Components(force.Vector, MaxCoordinate, whose, vector, vectorUnit);
        if (force.Power is < -MaxPower or > MaxPower)
        {
            throw new SceneException($"The power of {whose} is {force.Power}; it must lie between {-MaxPower} and {MaxPower}.");
        }
    }

    /// <summary>
    /// Forces whose rate does not depend on where the body is are not too stiff for its mass, nor is quadratic drag at the speed that
    /// gravity keeps up; and what is moved by fixed steps has no more of them together than those follow.
    /// </summary>
    private static void CheckRate<T>(in BodySpec spec, T whose, in Vector3D gravity, Force[] forces)
    {
        double sum = 0;
        foreach (Force force in spec.Forces.Among(forces))
        {
            double rate = force.Kind switch
            {
                ForceKind.LinearDrag or ForceKind.Spring or ForceKind.Magnetic => force.RateAt(spec.Mass, Vector3D.Zero, Vector3D.Zero, Vector3D.Zero),
                ForceKind.QuadraticDrag => 2 * Math.Sqrt(force.Strength / spec.Mass * gravity.Length),
                _ => 0,
            };
            if (!(rate <= MaxRate))
            {
                throw new SceneException(
                    $"On {whose}, of {Text(spec.Mass)} kg, force '{force.Name}', of strength {Text(force.Strength)} and damping {Text(force.Damping)}, acts at"
                    + $" a rate of {Above(rate, MaxRate)} 1/s; at most {Text(MaxRate)} 1/s is allowed.");
            }

            sum += force.Kind == ForceKind.QuadraticDrag ? 0 : rate; // which is not that where the body starts
        }

        if (FlightLaws.HasFixedSteps(spec) && sum > FlightLaws.MaxStableRate(spec))
        {
            double most = FlightLaws.MaxStableRate(spec);
            throw new SceneException(
                $"On {whose}, of {Text(spec.Mass)} kg, the forces {spec.Forces.NamesAmong(forces)} act together at a rate of {Above(sum, most)} 1/s; at most"
                + $" {Short(most)} 1/s is allowed under {spec.Flight} with fixed steps, which are halved to {Short(FlightLaws.ShortestStep(spec).ToSeconds())} s. Make"
                + " them weaker, or use Automatic.");
        }
    }

    /// <summary>
    /// A body is not at the very centre of a pull that grows without bound towards it: there is no direction in which it would be drawn.
    /// </summary>
    internal static void CheckCentres<T>(in Vector3D position, in BodySpec spec, T whose, Force[] forces)
    {
        foreach (Force force in spec.Forces.Among(forces))
        {
            if (force.Kind == ForceKind.Central && force.Power < 0 && position == force.Vector)
            {
                throw new SceneException(
                    $"The position of {whose} is {position} m, the centre of force '{force.Name}', whose power is {force.Power}; at the centre of a pull with"
                    + " a power below 0 a body may not be.");
            }
        }
    }

    /// <summary>Whether a body would be at such a centre.</summary>
    internal static bool IsAtCentre(in Vector3D position, in BodySpec spec, Force[] forces)
    {
        bool isAt = false;
        foreach (Force force in spec.Forces.Among(forces))
        {
            isAt |= force.Kind == ForceKind.Central && force.Power < 0 && position == force.Vector;
        }

        return isAt;
    }

    /// <summary>The highest speed that a scene or a player may give a body: a tenth of the smallest radius in a tick.</summary>
    internal static double MaxGivenSpeed(double smallestRadius) => 0.1 * smallestRadius * SimDuration.TicksPerSecond;

    /// <summary>
    /// The highest speed that a body may reach by impacts and forces: twice that, so that gravity does not end what a player just began.
    /// </summary>
    internal static double MaxSpeed(double smallestRadius) => 2 * MaxGivenSpeed(smallestRadius);

    /// <summary>
    /// The highest speed that an impact leaves: a light body that meets a heavy one would otherwise leave the range in which its state
    /// means something, so any player that may spawn two bodies could end a world. Halfway between the two above, so that gravity does not
    /// end at once what an impact begins.
    /// </summary>
    internal static double MaxReboundSpeed(double smallestRadius) => 1.5 * MaxGivenSpeed(smallestRadius);

    /// <summary>
    /// A speed that is given to a body is not so high that its drag takes most of it within the shortest step: no law would follow that.
    /// </summary>
    internal static void CheckDrag<T>(in Vector3D velocity, in BodySpec spec, T whose, Force[] forces)
    {
        foreach (Force force in spec.Forces.Among(forces))
        {
            double rate = force.Kind == ForceKind.QuadraticDrag ? force.RateAt(spec.Mass, Vector3D.Zero, velocity, Vector3D.Zero) : 0;
            double most = 1 / ShortestStep.ToSeconds();
            if (!(rate <= most))
            {
                throw new SceneException(
                    $"The velocity of {whose} is {velocity} m/s, at which force '{force.Name}' acts on its {Text(spec.Mass)} kg at a rate of {Above(rate, most)} 1/s; at most"
                    + $" {Short(most)} 1/s can be followed.");
            }
        }
    }

    /// <summary>A box holds at least the smallest body that the scene promises.</summary>
    internal static void CheckBox<T>(in PeriodicBox box, double smallestRadius, T whose)
    {
        Components(box.Size, MaxCoordinate, whose, "periodic box", "m");
        if (!(box.MinSide > 0))
        {
            throw new SceneException($"The periodic box of {whose} is {box.Size} m; every side must be above zero.");
        }

        double least = 2 * PeriodicBox.MinSides * smallestRadius;
        if (box.MinSide < least)
        {
            throw new SceneException(
                $"The periodic box of {whose} is {box.Size} m, and the smallest radius of a body {Text(smallestRadius)} m; every side must be at least"
                + $" {PeriodicBox.MinSides} times the diameter, {Short(least)} m.");
        }
    }

    /// <summary>Checks that everything put into a box is small enough for it, flies as it must there, and lies in it.</summary>
    internal static void CheckInBox<T>(in BodySpec spec, in Vector3D position, in PeriodicBox box, T whose)
    {
        if (spec.Flight != MotionLaw.Ballistic)
        {
            throw new SceneException($"The motion law of {whose} is {spec.Flight}; in a periodic box a body flies by Ballistic.");
        }

        double least = 2 * PeriodicBox.MinSides * spec.Radius;
        if (box.MinSide < least)
        {
            throw new SceneException(
                $"The periodic box is {box.Size} m, and the radius of {whose} is {Text(spec.Radius)} m; every side must be at least {PeriodicBox.MinSides}"
                + $" times its diameter, {Short(least)} m.");
        }

        CheckPlaceInBox(position, box, whose);
    }

    /// <summary>A place lies in the box, if there is one.</summary>
    internal static void CheckPlaceInBox<T>(in Vector3D position, in PeriodicBox box, T whose)
    {
        if (box.Exists && !box.Contains(position))
        {
            throw new SceneException(
                $"The position of {whose} is {position} m; in the periodic box each component is at least 0 and less than that of {box.Size}.");
        }
    }

    internal static void CheckPosition<T>(in Vector3D position, T whose) => Components(position, MaxCoordinate, whose, "position", "m");

    internal static void CheckVelocity<T>(in Vector3D velocity, double smallestRadius, T whose)
    {
        Components(velocity, double.MaxValue, whose, "velocity", "m/s");
        double limit = MaxGivenSpeed(smallestRadius);
        if (!(velocity.Length <= limit))
        {
            throw new SceneException(
                $"The velocity of {whose} is {velocity} m/s; with a smallest radius of {Text(smallestRadius)} m a speed that is given is at most "
                + $"{Text(limit)} m/s (a tenth of that radius in a tick).");
        }
    }

    internal static void Components<T>(in Vector3D v, double limit, T whose, string what, string unit)
    {
        if (!v.IsFinite || Math.Abs(v.X) > limit || Math.Abs(v.Y) > limit || Math.Abs(v.Z) > limit)
        {
            string allowed = limit == double.MaxValue ? "finite" : $"finite and within +-{Text(limit)} {unit}";
            throw new SceneException($"The {what} of {whose} is {v}; every component must be {allowed}.");
        }
    }

    internal static void InRange<T>(double value, double least, double most, T whose, string what, string unit)
    {
        if (!(value >= least && value <= most))
        {
            throw new SceneException(
                $"The {what} of {whose} is {Text(value)}; it must lie between {Text(least)} and {Text(most)} {unit}.");
        }
    }

    internal static string Text(double value) => value.ToString("R", CultureInfo.InvariantCulture);

    /// <summary>The text of a computed value: six digits are enough.</summary>
    internal static string Short(double value) =>
        Text(double.Parse(value.ToString("G6", CultureInfo.InvariantCulture), NumberStyles.Float, CultureInfo.InvariantCulture));

    internal static string Short(in Vector3D v) => $"({Short(v.X)}, {Short(v.Y)}, {Short(v.Z)})";

    /// <summary>A number of things: "1 plane", "2 planes".</summary>
    internal static string Count(int count, string one, string? many = null) =>
        $"{count.ToString(CultureInfo.InvariantCulture)} {(count == 1 ? one : many ?? one + "s")}";

    /// <summary>The text of a value above a limit, so that it is not read as the limit itself.</summary>
    private static string Above(double value, double limit) => Short(value) == Short(limit) ? $"just above {Short(limit)}" : Short(value);

    private static string Forces(int count) => count == 0 ? "none" : count == 1 ? "1, number 0" : $"{count}, numbers 0 to {count - 1}";

    private static string Capital(string text) => text.Length == 0 ? text : char.ToUpperInvariant(text[0]) + text.Substring(1);
}
