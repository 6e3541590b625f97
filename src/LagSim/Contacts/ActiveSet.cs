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
    private const double Met = 1e3; // times the least: less than that is missing of a demand that is met

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
            isActive[worst] = true;
            if (basis.TryAdd(contacts[worst], count, masses))
            {
                count++;
            }
            else if (!(gap > Met * least && TryExchange(contacts, masses, impulse, ref count)))
            {
                isActive[worst] = false;
                dependent[worst] = true; // its normal is a combination of those already active: it pushes nothing that they do not
                continue;
            }

            count = Retreat(contacts, masses, demand, impulse, change, count);
            Array.Clear(dependent, 0, n);
        }

        for (int i = 0; i < n; i++)
        {
            if (!isActive[i] && Missing(contacts[i], demand[i], change) > Met * least)
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>
    /// Has a contact whose row is a combination of active ones push in place of one of them: as much of the same push as that one has left.
    /// So what it demands can be met, though together with all of them it could push nothing that they do not. False if none pushes the
    /// same way: then they keep the demand from being met.
    /// </summary>
    /// <remarks>A step of the dual method of Goldfarb and Idnani 1983 (Math. Program. 27, 1-33) where no step in velocities is left.</remarks>
    private bool TryExchange(Span<ContactPoint> contacts, Span<double> masses, Span<double> impulse, ref int count)
    {
        int entering = active[count];
        basis.Combine(count, trial);
        int leaving = -1;
        double most = double.PositiveInfinity;
        for (int k = 0; k < count; k++)
        {
            if (trial[k] > ContactBasis.Cancelled && impulse[active[k]] < most * trial[k])
            {
                leaving = k;
                most = impulse[active[k]] / trial[k];
            }
        }

        if (leaving < 0)
        {
            return false;
        }

        for (int k = 0; k < count; k++)
        {
            impulse[active[k]] = k == leaving ? 0 : Math.Max(0, impulse[active[k]] - (most * trial[k]));
        }

        isActive[active[leaving]] = false;
        impulse[entering] = most;
        Array.Copy(active, leaving + 1, active, leaving, count - leaving); // and the one that enters, at the end
        count = Readd(contacts, masses, impulse, leaving, count);
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

        return Readd(contacts, masses, impulse, intact, kept);
    }

    /// <summary>Makes the rows of the active set again from one on; how many there are.</summary>
    private int Readd(Span<ContactPoint> contacts, Span<double> masses, Span<double> impulse, int from, int count)
    {
        int row = from;
        for (int k = from; k < count; k++)
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
