using System;

namespace LagSim.Scenes;

/// <summary>A force that a scene has besides uniform gravity; bodies name the forces that act on them.</summary>
/// <remarks>
/// Immutable, safe on any thread. Values are checked by <see cref="SceneBuilder.Build"/>. The formulas use only <c>+ - * /</c> and square
/// roots, so every peer gets the same bits.
/// </remarks>
public sealed class Force
{
    private Force(ForceKind kind, string name) => (Kind, Name) = (kind, name ?? throw new ArgumentNullException(nameof(name)));

    /// <summary>Which formula it has.</summary>
    public ForceKind Kind { get; }

    /// <summary>The name of the force in the scene; 1 to 64 characters.</summary>
    public string Name { get; }

    /// <summary>
    /// How strong: of linear drag c in kg/s; of quadratic drag k in kg/m, half of density times drag coefficient times cross-section; of a
    /// spring its stiffness in N/m; of a magnetic field the body's charge in C; of a central pull s, in m/s² at 1 m from the centre; of a
    /// Magnus force s in kg.
    /// </summary>
    public double Strength { get; private set; }

    /// <summary>For a spring, the damper's coefficient in kg/s; 0 for any other force.</summary>
    public double Damping { get; private set; }

    /// <summary>
    /// Of drag the medium's velocity in m/s; of a spring its anchor, of a central pull its centre, in m; of a magnetic field its flux
    /// density in T.
    /// </summary>
    public Vector3D Vector { get; private set; }

    /// <summary>For a central pull, the power of the distance: -2 for gravity and electrostatics; 0 for any other force.</summary>
    public int Power { get; private set; }

    /// <summary>The acceleration that a program supplies; null for all other kinds.</summary>
    public IAcceleration? Acceleration { get; private set; }

    /// <summary>Stokes drag, F = -c (v - w): slow motion in what is viscous.</summary>
    /// <param name="name">1 to 64 characters.</param>
    /// <param name="coefficient">c in kg/s, 0 to 1e30; of a sphere in a fluid of viscosity eta it is 6 pi eta r.</param>
    /// <param name="medium">w, the medium's velocity (wind) in m/s, each component within 1e12; default none.</param>
    public static Force LinearDrag(string name, double coefficient, Vector3D medium = default) =>
        new(ForceKind.LinearDrag, name) { Strength = coefficient, Vector = medium.WithoutNegativeZero() };

    /// <summary>Newton drag, F = -k |v - w| (v - w): balls in air.</summary>
    /// <param name="name">1 to 64 characters.</param>
    /// <param name="coefficient">k in kg/m, 0 to 1e30; of a sphere 0.5 rho C pi r², with C about 0.47.</param>
    /// <param name="medium">w, the medium's velocity (wind) in m/s, each component within 1e12; default none.</param>
    public static Force QuadraticDrag(string name, double coefficient, Vector3D medium = default) =>
        new(ForceKind.QuadraticDrag, name) { Strength = coefficient, Vector = medium.WithoutNegativeZero() };

    /// <summary>A spring to a point, F = -k (x - a) - c v.</summary>
    /// <param name="name">1 to 64 characters.</param>
    /// <param name="anchor">a, where the spring has length zero, in m; each component within 1e12.</param>
    /// <param name="stiffness">k in N/m, 0 to 1e30.</param>
    /// <param name="damping">c in kg/s, 0 to 1e30; default none.</param>
    public static Force Spring(string name, Vector3D anchor, double stiffness, double damping = 0) =>
        new(ForceKind.Spring, name) { Strength = stiffness, Damping = damping, Vector = anchor.WithoutNegativeZero() };

    /// <summary>The force of a uniform magnetic field on a charge, F = q v x B: it turns the velocity and keeps the speed.</summary>
    /// <param name="name">1 to 64 characters.</param>
    /// <param name="field">B in T, each component within 1e12.</param>
    /// <param name="charge">q in C, within 1e30.</param>
    public static Force Magnetic(string name, Vector3D field, double charge) =>
        new(ForceKind.Magnetic, name) { Strength = charge, Vector = field.WithoutNegativeZero() };

    /// <summary>
    /// A pull towards a centre that gives every mass the same acceleration, s |r|^p, and none at the centre itself: gravity of a fixed body
    /// with p = -2.
    /// </summary>
    /// <param name="name">1 to 64 characters.</param>
    /// <param name="centre">In m, each component within 1e12. With a power below 0 no body may start at it, and none gets through
    /// it.</param>
    /// <param name="strength">
    /// s, within 1e30: the acceleration at 1 m in m/s²; below zero it pushes. With p = -2 it is the gravitational parameter in m³/s².
    /// </param>
    /// <param name="power">p, -4 to 4.</param>
    public static Force Central(string name, Vector3D centre, double strength, int power = -2) =>
        new(ForceKind.Central, name) { Strength = strength, Vector = centre.WithoutNegativeZero(), Power = power };

    /// <summary>The Magnus force, F = s w x v, which bends the path of a body that turns and leaves its speed.</summary>
    /// <param name="name">1 to 64 characters.</param>
    /// <param name="coefficient">
    /// s in kg, within 1e30; of a smooth sphere in a medium of density rho at low speed it is pi rho r³ (Rubinow and Keller 1961).
    /// </param>
    public static Force Magnus(string name, double coefficient) => new(ForceKind.Magnus, name) { Strength = coefficient };

    /// <summary>
    /// An acceleration in C#, a program's own. It is sent by name and author's version, never as code: a client that does not have it among
    /// <c>ClientOptions.Accelerations</c> does not get in. A body under it never comes to rest, and its steps are
    /// <see cref="MotionLaw.DormandPrince54"/>'s or fixed.
    /// </summary>
    /// <exception cref="ArgumentNullException">There is none.</exception>
    public static Force Supplied(IAcceleration acceleration) =>
        new(ForceKind.Supplied, (acceleration ?? throw new ArgumentNullException(nameof(acceleration))).Name) { Acceleration = acceleration };

    /// <summary>The acceleration that it gives a body, in m/s².</summary>
    internal Vector3D At(double mass, double seconds, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        switch (Kind)
        {
            case ForceKind.LinearDrag:
                return (velocity - Vector) * (-Strength / mass);
            case ForceKind.QuadraticDrag:
                Vector3D through = velocity - Vector;
                return through * (-Strength / mass * through.Length);
            case ForceKind.Spring:
                return ((position - Vector) * (-Strength / mass)) + (velocity * (-Damping / mass));
            case ForceKind.Magnetic:
                return Vector3D.Cross(velocity, Vector) * (Strength / mass);
            case ForceKind.Magnus:
                return Vector3D.Cross(spin, velocity) * (Strength / mass);
            case ForceKind.Central:
                Vector3D from = position - Vector;
                return from == Vector3D.Zero ? Vector3D.Zero : from * (-Strength * DistanceToPower(from.LengthSquared, Power - 1));
            default:
                return Acceleration!.At(seconds, position, velocity);
        }
    }

    /// <summary>
    /// How fast, in 1/s, a deviation changes under the force at a state: the size of the largest eigenvalue that it adds to the equations
    /// of motion. Zero of what a program supplies, of which it is not known.
    /// </summary>
    internal double RateAt(double mass, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        switch (Kind)
        {
            case ForceKind.LinearDrag:
                return Strength / mass;
            case ForceKind.QuadraticDrag:
                return 2 * Strength / mass * (velocity - Vector).Length;
            case ForceKind.Spring:
                return Math.Max(Math.Sqrt(Strength / mass), Damping / mass);
            case ForceKind.Magnetic:
                return Math.Abs(Strength) / mass * Vector.Length;
            case ForceKind.Magnus:
                return Math.Abs(Strength) / mass * spin.Length;
            case ForceKind.Central:
                double gradient = Math.Abs(Strength) * Math.Max(1, Math.Abs(Power)) * DistanceToPower((position - Vector).LengthSquared, Power - 1);
                return Math.Sqrt(gradient);
            default:
                return 0;
        }
    }

    /// <summary>
    /// How fast, in 1/s, the force itself changes because the body moves past a centre where it has no bound: (1 - p) |v| / |r|.
    /// Integration by fixed steps could otherwise step over such a centre, and leave it with any speed. Zero for all other forces.
    /// </summary>
    internal double PassingRateAt(in Vector3D position, in Vector3D velocity) =>
        Kind == ForceKind.Central && Power < 0 && Strength != 0 ? (1 - Power) * velocity.Length / (position - Vector).Length : 0;

    internal void AddTo(ref StableHash hash)
    {
        if (Kind == ForceKind.Supplied)
        {
            hash.Add(Name);
            hash.Add(Acceleration!.Version);
            return;
        }

        hash.Add(((ulong)Kind << 32) | unchecked((uint)Power) | (1UL << 63));
        hash.Add(Strength);
        hash.Add(Damping);
        hash.Add(Vector);
    }

    // |r|^n from the square of |r|: whole powers by multiplication, one root where n is odd.
    private static double DistanceToPower(double squared, int n)
    {
        double power = 1;
        for (int i = Math.Abs(n) / 2; i > 0; i--)
        {
            power *= squared;
        }

        power = n % 2 != 0 ? power * Math.Sqrt(squared) : power;
        return n < 0 ? 1 / power : power;
    }
}
