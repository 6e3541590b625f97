using LagSim.Time;

namespace LagSim.Scenes;

/// <summary>Which laws of flight are exact for a body's forces, and which of them is the cheapest.</summary>
internal static class FlightLaws
{
    /// <summary>The largest product of rate and step that the method of this name follows; see there for its origin.</summary>
    internal const double RateTimesStepOfRungeKutta4 = 2.785;

    /// <inheritdoc cref="RateTimesStepOfRungeKutta4"/>
    internal const double RateTimesStepOfDormandPrince54 = 1;

    /// <summary>
    /// The flight law of a body: the one it asks for, or the cheapest that is exact for its forces, or, if none is, the one under error
    /// control.
    /// </summary>
    internal static MotionLaw Chosen(in BodySpec spec, in Vector3D gravity, Force[] forces) =>
        spec.Flight != MotionLaw.Automatic ? spec.Flight
        : spec.Forces.IsEmpty ? MotionLaw.Ballistic
        : HasClosedForm(spec, gravity, forces) ? MotionLaw.ClosedForm
        : MotionLaw.DormandPrince54;

    /// <summary>
    /// Whether a body's forces have a closed form together: all linear in position and velocity, or one inverse-square pull alone.
    /// </summary>
    internal static bool HasClosedForm(in BodySpec spec, in Vector3D gravity, Force[] forces) =>
        AreLinear(spec, forces) || IsKepler(spec, gravity, forces);

    /// <summary>Whether all forces of a body are linear in position and velocity.</summary>
    internal static bool AreLinear(in BodySpec spec, Force[] forces)
    {
        foreach (Force force in spec.Forces.Among(forces))
        {
            if (force.Kind is not (ForceKind.LinearDrag or ForceKind.Spring or ForceKind.Magnetic or ForceKind.Magnus))
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>Whether one centre that pulls as gravity does is all that acts on a body.</summary>
    internal static bool IsKepler(in BodySpec spec, in Vector3D gravity, Force[] forces)
    {
        int centres = 0;
        foreach (Force force in spec.Forces.Among(forces))
        {
            bool isCentre = force.Kind == ForceKind.Central && force.Power == -2 && force.Strength > 0;
            centres += isCentre ? 1 : 2;
        }

        return centres == 1 && gravity == Vector3D.Zero;
    }

    /// <summary>Whether a body flies by steps whose length does not go by an estimate of their error.</summary>
    internal static bool HasFixedSteps(in BodySpec spec) =>
        spec.Flight == MotionLaw.RungeKutta4 || (spec.Flight == MotionLaw.DormandPrince54 && spec.Tolerance == 0);

    /// <summary>To what fixed steps are halved, at the most.</summary>
    internal static SimDuration ShortestStep(in BodySpec spec)
    {
        SimDuration shortest = spec.Step;
        while (shortest.Ticks >= 2 * Limits.MinStep.Ticks)
        {
            shortest = SimDuration.FromTicks(shortest.Ticks / 2);
        }

        return shortest;
    }

    /// <summary>The fastest rate, in 1/s, that a body's fixed steps follow.</summary>
    internal static double MaxStableRate(in BodySpec spec) =>
        (spec.Flight == MotionLaw.RungeKutta4 ? RateTimesStepOfRungeKutta4 : RateTimesStepOfDormandPrince54) / ShortestStep(spec).ToSeconds();
}
