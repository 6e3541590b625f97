using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Solves many contacts at once, as of a large heap, one after the other in their order, again and again: projected Gauss-Seidel.</summary>
/// <remarks>
/// The law is that of <see cref="ImpactSolver"/>, met as far as the sweeps get. Each contact by itself comes nearer to it, so where nothing is to part faster than at rest no energy is gained,
/// whenever it ends; but it comes near slowly in high columns, of whose closing a part cos²(π / (2n + 1)) is left by a sweep, n equal balls high,
/// and where masses are very unequal. Cost: at most <see cref="MostSweeps"/> times the number of contacts. No allocation.
/// </remarks>
internal static class ContactSweeps
{
    /// <summary>So often at most all contacts are gone through.</summary>
    internal const int MostSweeps = 256;

    /// <summary>What changes speeds by less than this part of the largest that is lacking is settled.</summary>
    private const double Settled = 1e-12;

    /// <summary>Changes the velocities by the impulses of all contacts, and sets those. Masses and velocities by number of body; one in a hand has an infinite mass.</summary>
    internal static void Solve(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities, int sweeps = MostSweeps)
    {
        double scale = 0;
        for (int i = 0; i < contacts.Length; i++)
        {
            contacts[i].Impulse = 0;
            scale = Math.Max(scale, Math.Abs(contacts[i].Target - ImpactSolver.Opening(contacts[i], velocities)));
        }

        double most = scale;
        for (int sweep = 0; sweep < sweeps && most > Settled * scale; sweep++)
        {
            most = 0;
            for (int i = 0; i < contacts.Length; i++)
            {
                most = Math.Max(most, Push(ref contacts[i], masses, velocities));
            }
        }
    }

    /// <summary>Gives a contact what it lacks, or takes back what it has too much. Returns by how much its opening changes, in m/s.</summary>
    private static double Push(ref ContactPoint c, Span<double> masses, Span<Vector3D> velocities)
    {
        bool isPair = c.Second != ContactPoint.Static;
        double inverse = Inverse(masses[c.First]) + (isPair ? Inverse(masses[c.Second]) : 0);
        double given = inverse > 0 ? Math.Max(-c.Impulse, (c.Target - ImpactSolver.Opening(c, velocities)) / inverse) : 0;
        if (given == 0)
        {
            return 0;
        }

        c.Impulse += given;
        velocities[c.First] += c.Normal * (given * Inverse(masses[c.First]));
        if (isPair)
        {
            velocities[c.Second] -= c.Normal * (given * Inverse(masses[c.Second]));
        }

        return Math.Abs(given) * inverse;
    }

    // Of a body in a hand zero: nothing moves it.
    private static double Inverse(double mass) => double.IsPositiveInfinity(mass) ? 0 : 1 / mass;
}
