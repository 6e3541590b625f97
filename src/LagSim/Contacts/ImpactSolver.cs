using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Solves all contacts of one impact together: what are the velocities after it?</summary>
/// <remarks>
/// <para>The law, for every contact i: separation speed u_i' >= target_i, impulse p_i >= 0, and one of the two is an equality. With the
/// targets e_i |u_i| of closing contacts this is Newton's law of restitution for each, made consistent by leaving out what would have to
/// pull. Energy changes by -1/2 sum (1 - e_i) p_i |u_i|, so it never grows for e_i at most 1 (Moreau 1988 treats this family).</para>
/// <para>It is the least-squares problem with bounds that Lawson and Hanson solve by an active set ("Solving Least Squares Problems", 1974,
/// ch. 23): finite, and independent of the order in which the contacts were found, for they come in canonical order. If no velocities
/// satisfy all targets (a body squeezed between surfaces that cannot give way), every target becomes 0, which is always possible.</para>
/// <para>Allocates only when an impact has more contacts than any before.</para>
/// </remarks>
internal sealed class ImpactSolver
{
    private const double Tolerance = 1e-12;

    private double[] system = new double[16]; // A = J M^-1 J^T, row by row
    private double[] factor = new double[16];
    private double[] demand = new double[4]; // target - u before
    private double[] impulse = new double[4];
    private double[] trial = new double[4];
    private int[] active = new int[4];
    private bool[] isActive = new bool[4];
    private bool[] dependent = new bool[4];

    /// <summary>Changes the velocities by the impulses of all contacts. <paramref name="masses"/> and velocities by number of body.</summary>
    internal void Solve(ReadOnlySpan<ContactPoint> contacts, ReadOnlySpan<double> masses, Span<Vector3D> velocities)
    {
        if (contacts.Length == 1)
        {
            Single(contacts[0], masses, velocities);
            return;
        }

        Grow(contacts.Length);
        Assemble(contacts, masses, velocities, plastic: false);
        if (!TrySolve(contacts.Length))
        {
            Assemble(contacts, masses, velocities, plastic: true);
            TrySolve(contacts.Length);
        }

        for (int i = 0; i < contacts.Length; i++)
        {
            ref readonly ContactPoint c = ref contacts[i];
            velocities[c.First] += c.Normal * (impulse[i] / masses[c.First]);
            if (c.Second != ContactPoint.Static)
            {
                velocities[c.Second] -= c.Normal * (impulse[i] / masses[c.Second]);
            }
        }
    }

    internal static double Closing(in ContactPoint contact, ReadOnlySpan<Vector3D> velocities) =>
        Vector3D.Dot(
            contact.Normal,
            contact.Second == ContactPoint.Static ? velocities[contact.First] : velocities[contact.First] - velocities[contact.Second]);

    // By mass fractions instead of impulses: a few ulp at any mass ratio, and an elastic bounce off a plane is exactly a mirror.
    private static void Single(in ContactPoint c, ReadOnlySpan<double> masses, Span<Vector3D> velocities)
    {
        double change = c.Target - Closing(c, velocities);
        if (!(change > 0))
        {
            return;
        }

        if (c.Second == ContactPoint.Static)
        {
            velocities[c.First] += c.Normal * change;
            return;
        }

        double whole = masses[c.First] + masses[c.Second];
        velocities[c.First] += c.Normal * (change * (masses[c.Second] / whole));
        velocities[c.Second] -= c.Normal * (change * (masses[c.First] / whole));
    }

    private void Assemble(ReadOnlySpan<ContactPoint> contacts, ReadOnlySpan<double> masses, ReadOnlySpan<Vector3D> velocities, bool plastic)
    {
        int n = contacts.Length;
        for (int i = 0; i < n; i++)
        {
            demand[i] = (plastic ? 0 : contacts[i].Target) - Closing(contacts[i], velocities);
            for (int j = 0; j < n; j++)
            {
                system[(i * n) + j] = Coupling(contacts[i], contacts[j], masses);
            }
        }
    }

    private static double Coupling(in ContactPoint a, in ContactPoint b, ReadOnlySpan<double> masses)
    {
        double sum = 0;
        double along = Vector3D.Dot(a.Normal, b.Normal);
        if (a.First == b.First)
        {
            sum += along / masses[a.First];
        }

        if (a.Second != ContactPoint.Static && a.Second == b.Second)
        {
            sum += along / masses[a.Second];
        }

        if (a.First == b.Second)
        {
            sum -= along / masses[a.First];
        }

        if (a.Second != ContactPoint.Static && a.Second == b.First)
        {
            sum -= along / masses[a.Second];
        }

        return sum;
    }

    /// <summary>Lawson and Hanson's active-set method; false if some demand cannot be met.</summary>
    private bool TrySolve(int n)
    {
        int count = 0;
        double scale = 0;
        for (int i = 0; i < n; i++)
        {
            impulse[i] = 0;
            isActive[i] = false;
            dependent[i] = false;
            scale = Math.Max(scale, Math.Abs(demand[i]));
        }

        double least = Tolerance * scale;
        for (int pass = 0; pass < 10 * n; pass++)
        {
            int worst = -1;
            double gap = least;
            for (int i = 0; i < n; i++)
            {
                double missing = isActive[i] || dependent[i] ? 0 : Missing(i, n);
                if (missing > gap)
                {
                    worst = i;
                    gap = missing;
                }
            }

            if (worst < 0)
            {
                break;
            }

            active[count++] = worst;
            isActive[worst] = true;
            if (!Factor(count, n))
            {
                // Its normal is a combination of those already active: it pushes nothing that they do not.
                isActive[worst] = false;
                dependent[worst] = true;
                count--;
                continue;
            }

            count = Retreat(count, n);
            Array.Clear(dependent, 0, n);
        }

        for (int i = 0; i < n; i++)
        {
            if (!isActive[i] && Missing(i, n) > 1e3 * least)
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>Moves from the last impulses towards the active set's solution, dropping contacts that would have to pull.</summary>
    private int Retreat(int count, int n)
    {
        while (true)
        {
            Substitute(count, n);
            double step = 1;
            for (int k = 0; k < count; k++)
            {
                if (trial[k] < 0)
                {
                    step = Math.Min(step, impulse[active[k]] / (impulse[active[k]] - trial[k]));
                }
            }

            for (int k = 0; k < count; k++)
            {
                impulse[active[k]] += step * (trial[k] - impulse[active[k]]);
            }

            if (step >= 1)
            {
                return count;
            }

            int kept = 0;
            for (int k = 0; k < count; k++)
            {
                int i = active[k];
                if (trial[k] < 0 && impulse[i] <= 1e-15 * Math.Abs(trial[k]))
                {
                    impulse[i] = 0;
                    isActive[i] = false;
                }
                else
                {
                    active[kept++] = i;
                }
            }

            count = kept;
            Factor(count, n);
        }
    }

    private double Missing(int i, int n)
    {
        double missing = demand[i];
        for (int j = 0; j < n; j++)
        {
            missing -= system[(i * n) + j] * impulse[j];
        }

        return missing;
    }

    /// <summary>
    /// The factors L D L^T of the active rows and columns, D on the diagonal; false if they are dependent. Without square roots small
    /// integer systems, such as equal masses in a row, stay exact and a symmetric impact keeps its symmetry.
    /// </summary>
    private bool Factor(int count, int n)
    {
        for (int r = 0; r < count; r++)
        {
            for (int c = 0; c <= r; c++)
            {
                double sum = system[(active[r] * n) + active[c]];
                for (int k = 0; k < c; k++)
                {
                    sum -= factor[(r * n) + k] * factor[(c * n) + k] * factor[(k * n) + k];
                }

                if (r == c && !(sum > Tolerance * system[(active[r] * n) + active[r]]))
                {
                    return false;
                }

                factor[(r * n) + c] = r == c ? sum : sum / factor[(c * n) + c];
            }
        }

        return true;
    }

    private void Substitute(int count, int n)
    {
        for (int r = 0; r < count; r++)
        {
            trial[r] = demand[active[r]];
            for (int k = 0; k < r; k++)
            {
                trial[r] -= factor[(r * n) + k] * trial[k];
            }
        }

        for (int r = count - 1; r >= 0; r--)
        {
            trial[r] /= factor[(r * n) + r];
            for (int k = r + 1; k < count; k++)
            {
                trial[r] -= factor[(k * n) + r] * trial[k];
            }
        }
    }

    private void Grow(int contacts)
    {
        if (contacts <= demand.Length)
        {
            return;
        }

        int size = Math.Max(contacts, 2 * demand.Length);
        system = new double[size * size];
        factor = new double[size * size];
        demand = new double[size];
        impulse = new double[size];
        trial = new double[size];
        active = new int[size];
        isActive = new bool[size];
        dependent = new bool[size];
    }
}
