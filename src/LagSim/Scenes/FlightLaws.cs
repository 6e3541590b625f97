namespace LagSim.Scenes;

/// <summary>Which laws of flight are exact for a body's forces, and which of them is the cheapest.</summary>
internal static class FlightLaws
{
    /// <summary>
    /// What a body flies by: what it asks for, or the cheapest law that is exact for its forces, or, where none is, the one under error control.
    /// </summary>
    internal static MotionLaw Chosen(in BodySpec spec, in Vector3D gravity, Force[] forces) =>
        spec.Flight != MotionLaw.Automatic ? spec.Flight
        : spec.Forces.IsEmpty ? MotionLaw.Ballistic
        : HasClosedForm(spec, gravity, forces) ? MotionLaw.ClosedForm
        : MotionLaw.DormandPrince54;

    /// <summary>Whether a body's forces have a closed form together: all linear in position and velocity, or one inverse-square pull alone.</summary>
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
}
