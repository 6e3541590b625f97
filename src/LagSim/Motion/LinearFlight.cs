using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>
/// Flight under forces that are linear in position and velocity, in closed form: gravity, linear drag, springs with dampers, magnetic
/// fields, and the Magnus force of a body that turns evenly. Together they are x'' = f - kappa x - gamma v + Omega x v.
/// </summary>
/// <remarks>
/// <para>A segment is the quintic Hermite polynomial between two states. The second follows from the first by <see cref="LinearResponse"/>,
/// so only rounding adds up. The error of the polynomial within a segment is at most the body's tolerance. The bound uses that |x^(6)|
/// stays below |x^(6)(0)| + t |x^(7)(0)|: the derivatives obey the same equation without f, and its responses to a position and a velocity
/// of 1 never exceed 1 and t.</para>
/// </remarks>
internal readonly struct LinearFlight
{
    private readonly double gamma;
    private readonly double kappa;
    private readonly Vector3D omega;
    private readonly double turn;
    private readonly BodySpec spec;
    private readonly Vector3D spin;

    /// <summary>The flight of a body.</summary>
    internal LinearFlight(Scene scene, in BodySpec spec, in Vector3D spin)
    {
        this.spec = spec;
        this.spin = spin;
        gamma = 0;
        kappa = 0;
        omega = Vector3D.Zero;
        foreach (Force force in spec.Forces.Among(scene.ForceArray))
        {
            gamma += (force.Kind == ForceKind.LinearDrag ? force.Strength : force.Damping) / spec.Mass; // only a spring has damping
            kappa += force.Kind == ForceKind.Spring ? force.Strength / spec.Mass : 0;
            omega -= force.Kind == ForceKind.Magnetic ? force.Vector * (force.Strength / spec.Mass) : Vector3D.Zero;
            omega += force.Kind == ForceKind.Magnus ? spin * (force.Strength / spec.Mass) : Vector3D.Zero;
        }

        turn = omega.Length;
    }

    /// <summary>A segment of the flight from a state on, as long as a quintic follows it within the body's tolerance.</summary>
    internal MotionSegment Piece(in Forces forces, SimTime epoch, in Vector3D x, in Vector3D v, out DenseOutput dense)
    {
        Vector3D still = forces.At(spec, epoch, 0, x, Vector3D.Zero, spin);
        Vector3D a = Damped(v) + still;
        SimDuration step = Length(x, v, a);
        double h = step.ToSeconds();
        Vector3D dx, v1;
        LinearResponse along = LinearResponse.After(new Rotor(gamma, 0), kappa, h);
        if (turn == 0)
        {
            dx = (v * along.S.Real) + (still * along.Q.Real);
            v1 = (v * along.E.Real) + (still * along.S.Real);
        }
        else
        {
            LinearResponse across = LinearResponse.After(new Rotor(gamma, -turn), kappa, h);
            Vector3D axis = omega / turn;
            dx = Apply(axis, along.S, across.S, v) + Apply(axis, along.Q, across.Q, still);
            v1 = Apply(axis, along.E, across.E, v) + Apply(axis, along.S, across.S, still);
        }

        Vector3D a1 = Damped(v1) + still - (dx * kappa);
        dense = DenseOutput.Between(h, dx, v1 - v, v, a, a1);
        return new MotionSegment(MotionLaw.ClosedForm, epoch, epoch + step, x, v, a);
    }

    /// <summary>The part of the acceleration that depends on the velocity, and of every derivative on the one before.</summary>
    private Vector3D Damped(in Vector3D v) => (v * -gamma) + Vector3D.Cross(omega, v);

    private SimDuration Length(in Vector3D x, in Vector3D v, in Vector3D a)
    {
        Vector3D third = Damped(a) - (v * kappa);
        Vector3D fourth = Damped(third) - (a * kappa);
        Vector3D fifth = Damped(fourth) - (third * kappa);
        Vector3D sixth = Damped(fifth) - (fourth * kappa);
        Vector3D seventh = Damped(sixth) - (fifth * kappa);
        double h = HermiteError.LongestStep(spec.Tolerance, x.Length + spec.Radius, v.Length, a.Length, sixth.Length, seventh.Length, 1);
        return StepSize.Scaled(StepSize.Longest, h);
    }

    private static Vector3D Apply(in Vector3D axis, in Rotor along, in Rotor across, in Vector3D to)
    {
        double part = Vector3D.Dot(axis, to);
        return (to * across.Real) + (Vector3D.Cross(axis, to) * across.Imaginary) + (axis * (part * (along.Real - across.Real)));
    }
}
