using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Coulomb friction in an impact, once the impulses along the normals are known.</summary>
/// <remarks>
/// <para>In each contact it works against the slip u of the two surfaces, by as much as the normal impulse p allows, mu p, or as stops the
/// slip, |u| / (7/2 (1/m1 + 1/m2)) between solid spheres (moment of inertia 2/5 m r²): for one contact this is the usual law of a bouncing
/// ball (Garwin 1969, Am. J. Phys. 37, 88-92).</para>
/// <para>All contacts see the velocities that the normal impulses left, whatever their order, and each gives the part 1/n of its impulse, n
/// the larger number of rubbing contacts of its two bodies. So energy never grows: each impulse alone lowers it, and the square of a mean
/// is at most the mean of the squares.</para>
/// <para>Cost: the number of contacts. Allocates only when an impact has more bodies than any before.</para>
/// </remarks>
internal sealed class ImpactFriction
{
    /// <summary>How much of its slip an impulse takes from a solid sphere, times 1/m: 1 by the centre, 5/2 by the turning.</summary>
    internal const double SlipPerImpulse = 1 + TurnPerImpulse;

    /// <summary>How much an impulse at the surface turns a solid sphere, times 1/(m r).</summary>
    internal const double TurnPerImpulse = 2.5;

    private Vector3D[] changes = Array.Empty<Vector3D>();
    private Vector3D[] turns = Array.Empty<Vector3D>();
    private int[] rubbing = Array.Empty<int>();

    /// <summary>Changes velocities and spins. All by number of body but the coefficients, which are by number of contact.</summary>
    internal void Solve(
        Span<ContactPoint> contacts, Span<double> coefficients, Span<double> masses, Span<double> radii, Span<Vector3D> velocities, Span<Vector3D> spins)
    {
        int count = velocities.Length;
        if (count > changes.Length)
        {
            changes = new Vector3D[count * 2];
            turns = new Vector3D[count * 2];
            rubbing = new int[count * 2];
        }

        Array.Clear(changes, 0, count);
        Array.Clear(turns, 0, count);
        Array.Clear(rubbing, 0, count);
        for (int i = 0; i < contacts.Length; i++)
        {
            if (Rubs(contacts[i], coefficients[i]))
            {
                rubbing[contacts[i].First]++;
                if (contacts[i].Second != ContactPoint.Static)
                {
                    rubbing[contacts[i].Second]++;
                }
            }
        }

        for (int i = 0; i < contacts.Length; i++)
        {
            if (Rubs(contacts[i], coefficients[i]))
            {
                FrictionImpulse(contacts[i], coefficients[i], masses, radii, velocities, spins);
            }
        }

        for (int b = 0; b < count; b++)
        {
            velocities[b] += changes[b];
            spins[b] += turns[b];
        }
    }

    /// <summary>How the surface of the first slips over that of the second where they touch, in m/s.</summary>
    private static Vector3D Slip(in ContactPoint c, Span<double> radii, Span<Vector3D> velocities, Span<Vector3D> spins)
    {
        Vector3D slip = velocities[c.First] - (Vector3D.Cross(spins[c.First], c.Normal) * radii[c.First]);
        if (c.Second != ContactPoint.Static)
        {
            slip -= velocities[c.Second] + (Vector3D.Cross(spins[c.Second], c.Normal) * radii[c.Second]);
        }

        return slip - (c.Normal * Vector3D.Dot(c.Normal, slip));
    }

    private static bool Rubs(in ContactPoint c, double coefficient) => c.Impulse > 0 && coefficient > 0;

    private void FrictionImpulse(
        in ContactPoint c, double coefficient, Span<double> masses, Span<double> radii, Span<Vector3D> velocities, Span<Vector3D> spins)
    {
        Vector3D slip = Slip(c, radii, velocities, spins);
        double speed = slip.Length;
        bool isPair = c.Second != ContactPoint.Static;
        double inverse = ImpactSolver.Inverse(masses[c.First]) + (isPair ? ImpactSolver.Inverse(masses[c.Second]) : 0);
        if (!(speed > 0) || !(inverse > 0))
        {
            return;
        }

        int shared = Math.Max(rubbing[c.First], isPair ? rubbing[c.Second] : 0);
        double impulse = Math.Min(coefficient * c.Impulse, speed / (SlipPerImpulse * inverse)) / shared;
        Vector3D push = slip * (-impulse / speed);
        Vector3D turn = Vector3D.Cross(push, c.Normal) * TurnPerImpulse; // the lever -r n times the push, by 2/5 m r²
        changes[c.First] += push * ImpactSolver.Inverse(masses[c.First]);
        turns[c.First] += turn * (ImpactSolver.Inverse(masses[c.First]) / radii[c.First]);
        if (isPair)
        {
            changes[c.Second] -= push * ImpactSolver.Inverse(masses[c.Second]);
            turns[c.Second] += turn * (ImpactSolver.Inverse(masses[c.Second]) / radii[c.Second]);
        }
    }
}
