using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Solves few contacts together exactly: each opens as fast as is demanded of it, or faster and does not push.</summary>
/// <remarks>
/// It is the least-squares problem with bounds that Lawson and Hanson solve by an active set ("Solving Least Squares Problems", 1974,
/// ch. 23): finite, and independent of the order in which the contacts were found, for they come in canonical order.
/// Cost: contacts^2 times bodies. Allocates only when there are more contacts or bodies than ever before.
/// </remarks>
internal sealed class ActiveSet
{
    private const double Tolerance = 1e-12;

    private readonly ContactBasis basis = new(); // of the contacts in the set, by their places in it
    private int[] active = Array.Empty<int>();
    private bool[] isActive = Array.Empty<bool>();
    private bool[] dependent = Array.Empty<bool>();
    private double[] trial = Array.Empty<double>();

    /// <summary>Solves; false if some demand cannot be met. Leaves the impulses, and the change of every velocity.</summary>
    /// <param name="contacts">With their normals.</param>
    /// <param name="masses">By number of body.</param>
    /// <param name="demand">By contact: by how much faster it is to open, at least.</param>
    /// <param name="impulse">By contact: is set.</param>
    /// <param name="change">By body: is set.</param>
    internal bool TrySolve(
        Span<ContactPoint> contacts, Span<double> masses, Span<double> demand, Span<double> impulse, Span<Vector3D> change)
    {
        int n = contacts.Length;
        Grow(n);
        basis.Clear(n, change.Length);
        int count = 0;
        double scale = 0;
        for (int i = 0; i < n; i++)
        {
            impulse[i] = 0;
            isActive[i] = false;
            dependent[i] = false;
            scale = Math.Max(scale, Math.Abs(demand[i]));
        }

        change.Clear();
        double least = Tolerance * scale;
        for (int pass = 0; pass < 10 * n; pass++)
        {
            int worst = -1;
            double gap = least;
            for (int i = 0; i < n; i++)
            {
                double missing = isActive[i] || dependent[i] ? 0 : Missing(contacts[i], demand[i], change);
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

            active[count] = worst;
            if (!basis.TryAdd(contacts[worst], count, masses))
            {
                dependent[worst] = true; // its normal is a combination of those already active: it pushes nothing that they do not
                continue;
            }

            isActive[worst] = true;
            count = Retreat(contacts, masses, demand, impulse, change, count + 1);
            Array.Clear(dependent, 0, n);
        }

        for (int i = 0; i < n; i++)
        {
            if (!isActive[i] && Missing(contacts[i], demand[i], change) > 1e3 * least)
            {
                return false;
            }
        }

        return true;
    }

    private static double Missing(in ContactPoint contact, double demanded, Span<Vector3D> change) => demanded - ImpactSolver.Opening(contact, change);

    /// <summary>Moves from the last impulses towards the active set's solution, dropping contacts that would have to pull.</summary>
    private int Retreat(Span<ContactPoint> contacts, Span<double> masses, Span<double> demand, Span<double> impulse, Span<Vector3D> change, int count)
    {
        while (true)
        {
            basis.Substitute(demand, active, count, trial);
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
                basis.ChangeBy(contacts, active, count, trial, masses, change);
                return count;
            }

            count = Drop(contacts, masses, impulse, count);
        }
    }

    /// <summary>
    /// Removes the contacts whose impulse has fallen to zero from the active set; the rows from the first of them on are made again.
    /// </summary>
    private int Drop(Span<ContactPoint> contacts, Span<double> masses, Span<double> impulse, int count)
    {
        int kept = 0;
        int intact = count;
        for (int k = 0; k < count; k++)
        {
            int i = active[k];
            if (trial[k] < 0 && impulse[i] <= 1e-15 * Math.Abs(trial[k]))
            {
                impulse[i] = 0;
                isActive[i] = false;
                intact = Math.Min(intact, k);
            }
            else
            {
                active[kept++] = i;
            }
        }

        int row = intact;
        for (int k = intact; k < kept; k++)
        {
            int i = active[k];
            active[row] = i;
            if (basis.TryAdd(contacts[i], row, masses))
            {
                row++;
            }
            else
            {
                impulse[i] = 0; // rounding alone: what was independent with more rows is so with fewer
                isActive[i] = false;
            }
        }

        return row;
    }

    private void Grow(int contacts)
    {
        if (contacts > active.Length)
        {
            int count = Math.Max(contacts, 2 * active.Length);
            active = new int[count];
            isActive = new bool[count];
            dependent = new bool[count];
            trial = new double[count];
        }
    }
}
