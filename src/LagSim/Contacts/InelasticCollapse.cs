using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>
/// Decides whether contacts that are struck in turn stop after finitely many impacts, or are struck infinitely often in a finite time.
/// </summary>
/// <remarks>
/// <para>Two contacts of one body whose pushes meet by the cosine k, in the metric of the masses, strike in turn for ever if k (1 + e) >= 2
/// sqrt(e): then the product of the two impacts has a real positive eigenvalue, and the closing speeds are a geometric series. Otherwise
/// its eigenvalues are complex, and after a finite number of impacts the two part. For many contacts the cosine is the greatest eigenvalue
/// of the matrix that couples them. For a row of N balls that closes on a wall it is cos(pi / 2N), which gives the known threshold tan^2
/// (pi/4 (1 - 1/N)).</para>
/// <para>Reference: Bernu and Mazighi 1990 (J. Phys. A 23, 5745-5754); Constantin, Grossman and Mungan 1995 (Physica D 83, 409-420).
/// Restitutions that differ: the impact at a contact turns its speed by -e and gives the others 1 + e times the coupling, so the cosine is
/// multiplied by the root of (1 + e)(1 + f), over the root of e and the root of f. Friction drives a body across the normal by mu of its
/// push at most, in whatever direction it slips, so the cosine is taken at the direction that couples most: where two contacts of one body
/// are at right angles it is the root of the product of their frictions.</para>
/// <para>A pure function; the order of contacts affects rounding alone. Cost: the cube of the contacts.</para>
/// </remarks>
internal sealed class InelasticCollapse
{
    private double[] matrix = Array.Empty<double>();

    /// <summary>Whether infinitely many impacts may follow among these contacts, all of which touch.</summary>
    /// <param name="contacts">With their normals.</param>
    /// <param name="restitutions">Of each contact, 0 to 1.</param>
    /// <param name="frictions">Of each contact, the coefficient.</param>
    /// <param name="masses">Of the bodies, in kg; infinite for a held one.</param>
    internal bool IsPossible(Span<ContactPoint> contacts, Span<double> restitutions, Span<double> frictions, Span<double> masses)
    {
        int count = contacts.Length;
        if (matrix.Length < count * count)
        {
            matrix = new double[2 * count * count];
        }

        for (int i = 0; i < count; i++)
        {
            for (int j = 0; j < i; j++)
            {
                (double e, double f) = (restitutions[i], restitutions[j]);
                double part = Math.Sqrt((1 + e) * (1 + f)) / (Math.Sqrt(e) + Math.Sqrt(f));
                double cosine = Cosine(contacts[i], frictions[i], contacts[j], frictions[j], masses);
                if (cosine * part >= 1)
                {
                    return true; // two alone; infinite where neither bounces
                }

                matrix[(i * count) + j] = cosine > 0 ? -cosine * part : 0;
            }
        }

        return !IsPositiveDefinite(count);
    }

    /// <summary>
    /// The cosine at which the pushes of two contacts meet, positive where each makes the other close. Where friction makes the two unlike,
    /// their geometric mean: the product of the two is what an impact to and one fro leave.
    /// </summary>
    private static double Cosine(in ContactPoint a, double frictionOfA, in ContactPoint b, double frictionOfB, Span<double> masses)
    {
        double to = Closing(a, frictionOfA, b, masses);
        double fro = Closing(b, frictionOfB, a, masses);
        double square = Inverse(a, masses) * Inverse(b, masses);
        return to > 0 && fro > 0 && square > 0 ? Math.Sqrt(to * fro / square) : 0;
    }

    /// <summary>
    /// How fast b closes for a unit of push in a, by way of the bodies that they share, where friction in a drives it as it can at most.
    /// </summary>
    private static double Closing(in ContactPoint a, double friction, in ContactPoint b, Span<double> masses) =>
        Closing(a, friction, b, a.First, masses) + (a.Second == ContactPoint.Static ? 0 : Closing(a, friction, b, a.Second, masses));

    private static double Closing(in ContactPoint a, double friction, in ContactPoint b, int body, Span<double> masses)
    {
        double sign = (a.First == body ? 1 : -1) * (b.First == body ? 1 : b.Second == body ? -1 : 0);
        double along = Vector3D.Dot(a.Normal, b.Normal);
        double across = friction > 0 && sign != 0 ? friction * Math.Sqrt(Math.Max(0, 1 - (along * along))) : 0;
        return (across - (sign * along)) * ImpactSolver.Inverse(masses[body]);
    }

    private static double Inverse(in ContactPoint c, Span<double> masses) =>
        ImpactSolver.Inverse(masses[c.First]) + (c.Second == ContactPoint.Static ? 0 : ImpactSolver.Inverse(masses[c.Second]));

    /// <summary>Cholesky's decomposition of the matrix with a diagonal of 1; it ends early if there is none.</summary>
    private bool IsPositiveDefinite(int count)
    {
        for (int i = 0; i < count; i++)
        {
            Span<double> row = matrix.AsSpan(i * count, count);
            double left = 1;
            for (int j = 0; j < i; j++)
            {
                double sum = row[j];
                for (int k = 0; k < j; k++)
                {
                    sum -= row[k] * matrix[(j * count) + k];
                }

                row[j] = sum / matrix[(j * count) + j];
                left -= row[j] * row[j];
            }

            if (!(left > 0))
            {
                return false;
            }

            row[i] = Math.Sqrt(left);
        }

        return true;
    }
}
