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
/// satisfy all targets (a body squeezed between surfaces that cannot give way), or only at an expense of energy, only restitution is asked for, and
/// if that cannot be had either every target becomes 0, which always can.</para>
/// <para>The rows of the active contacts are made orthogonal in the space of the bodies' motions, by modified Gram-Schmidt with 1/mass as
/// weight, rather than by factors of the matrix of their products: where a light body carries a heavy one, that matrix has already lost
/// the heavy one to rounding. No square roots: small integer systems, such as equal masses in a row, stay exact and a symmetric impact
/// keeps its symmetry.</para>
/// <para>Cost: contacts^2 times bodies; more than <see cref="FewAtOnce"/> contacts, as in a heap, are left to <see cref="ProjectedGradients"/>. Allocates only when an impact has more contacts or bodies than any before.</para>
/// </remarks>
internal sealed class ImpactSolver
{
    private const double Tolerance = 1e-12;

    /// <summary>So many contacts at most are solved exactly: beyond, what that costs grows too fast for one event.</summary>
    internal const int MostAtOnce = 96;

    /// <summary>So many are always solved exactly; more than these only if masses differ by more than <see cref="LikeMasses"/>, else gradients get as near in less time.</summary>
    internal const int FewAtOnce = 32;

    /// <summary>By what factor masses may differ for <see cref="ProjectedGradients"/> to get to the rounding in its steps.</summary>
    internal const double LikeMasses = 1000;

    /// <summary>By what share of what is exchanged the energy may be off by rounding.</summary>
    private const double Rounding = 1e-9;

    /// <summary>
    /// What is left of a row's part at one body counts as nothing below this share of what was taken away: normals that differ by less than a
    /// microradian are one. A light body squeezed between two such is held, and not shot out sideways at a million times their speed.
    /// </summary>
    private const double Cancelled = 1e-6;

    private readonly ProjectedGradients gradients = new();
    private double[] demand = Array.Empty<double>(); // target - u before
    private double[] impulse = Array.Empty<double>();
    private int[] active = Array.Empty<int>();
    private bool[] isActive = Array.Empty<bool>();
    private bool[] dependent = Array.Empty<bool>();

    // By place in the active set.
    private Vector3D[] basis = Array.Empty<Vector3D>(); // row by row: the orthogonal rows, a part for each body
    private double[] extent = Array.Empty<double>(); // the lengths of those parts
    private double[] share = Array.Empty<double>(); // row by row: how much of each earlier basis row a contact's row has
    private double[] weight = Array.Empty<double>(); // of a basis row: its square, by 1/mass
    private double[] along = Array.Empty<double>(); // the impulse along each basis row
    private double[] trial = Array.Empty<double>();

    // By body.
    private double[] size = Array.Empty<double>();
    private Vector3D[] change = Array.Empty<Vector3D>();

    private int bodies;
    private int kept; // how many contacts are in the active set that the last solution ended with

    /// <summary>
    /// Changes the velocities by the impulses of all contacts. <paramref name="masses"/> and velocities by number of body; one in a hand has an infinite mass.
    /// </summary>
    internal void Solve(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities)
    {
        if (contacts.Length == 1)
        {
            Single(ref contacts[0], masses, velocities);
            return;
        }

        if (AreForGradients(contacts.Length, masses))
        {
            gradients.Solve(contacts, masses, velocities);
            return;
        }

        bodies = velocities.Length;
        Grow(contacts.Length);
        SolveSeveral(contacts, masses, velocities, again: false);
    }

    /// <summary>
    /// The same with other targets and velocities: for the very bodies and normals that were solved last, which saves most of the work. It begins with the contacts that pushed then.
    /// </summary>
    internal void SolveAgain(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities)
    {
        if (contacts.Length == 1)
        {
            Single(ref contacts[0], masses, velocities);
        }
        else if (AreForGradients(contacts.Length, masses))
        {
            gradients.Solve(contacts, masses, velocities, again: true);
        }
        else
        {
            SolveSeveral(contacts, masses, velocities, again: true);
        }
    }

    private static bool AreForGradients(int count, Span<double> masses)
    {
        if (count <= FewAtOnce || count > MostAtOnce)
        {
            return count > MostAtOnce;
        }

        double least = double.PositiveInfinity;
        double most = 0;
        for (int b = 0; b < masses.Length; b++)
        {
            least = Math.Min(least, masses[b]);
            most = IsHand(masses[b]) ? most : Math.Max(most, masses[b]);
        }

        return most <= LikeMasses * least;
    }

    private void SolveSeveral(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities, bool again)
    {
        if (!TryMeet(contacts, masses, velocities, c => c.Target, again) && !TryMeet(contacts, masses, velocities, c => c.Restored, again: false))
        {
            Demand(contacts, velocities, _ => 0);
            TrySolve(contacts, masses, again: false);
        }

        for (int b = 0; b < bodies; b++)
        {
            velocities[b] += change[b];
        }

        for (int i = 0; i < contacts.Length; i++)
        {
            contacts[i].Impulse = Math.Max(0, impulse[i]);
        }
    }

    /// <summary>How fast the two of a contact part; negative while they close.</summary>
    internal static double Opening(in ContactPoint contact, Span<Vector3D> velocities) =>
        Vector3D.Dot(
            contact.Normal,
            contact.Second == ContactPoint.Static ? velocities[contact.First] : velocities[contact.First] - velocities[contact.Second]);

    // By mass fractions instead of impulses: a few ulp at any mass ratio, and an elastic bounce off a plane is exactly a mirror.
    private static void Single(ref ContactPoint c, Span<double> masses, Span<Vector3D> velocities)
    {
        double change = c.Target - Opening(c, velocities);
        if (!(change > 0))
        {
            c.Impulse = 0; // what was solved before may be solved again
            return;
        }

        if (c.Second == ContactPoint.Static)
        {
            velocities[c.First] += c.Normal * change;
            c.Impulse = change * masses[c.First];
            return;
        }

        if (IsHand(masses[c.First]) || IsHand(masses[c.Second]))
        {
            velocities[c.First] += IsHand(masses[c.First]) ? Vector3D.Zero : c.Normal * change;
            velocities[c.Second] -= IsHand(masses[c.Second]) ? Vector3D.Zero : c.Normal * change;
            c.Impulse = change * (IsHand(masses[c.First]) ? masses[c.Second] : masses[c.First]); // of two hands nothing that counts
            return;
        }

        double whole = masses[c.First] + masses[c.Second];
        c.Impulse = change * masses[c.First] * (masses[c.Second] / whole);
        velocities[c.First] += c.Normal * (change * (masses[c.Second] / whole));
        velocities[c.Second] -= c.Normal * (change * (masses[c.First] / whole));
    }

    /// <summary>Solves for these speeds after the impact; false if they cannot be had, or only at an expense of energy.</summary>
    private bool TryMeet(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities, Func<ContactPoint, double> target, bool again)
    {
        Demand(contacts, velocities, target);
        return TrySolve(contacts, masses, again) && !IsCostly(contacts, masses, velocities);
    }

    private void Demand(Span<ContactPoint> contacts, Span<Vector3D> velocities, Func<ContactPoint, double> target)
    {
        for (int i = 0; i < contacts.Length; i++)
        {
            demand[i] = target(contacts[i]) - Opening(contacts[i], velocities);
        }
    }

    /// <summary>
    /// Whether the bodies would gain more energy than the speeds beyond restitution give them where they are free to part: twice the largest of
    /// those for each. A row that just fits between two walls has almost no way to part, and would be shot out sideways for a micrometre's hop.
    /// </summary>
    private bool IsCostly(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities)
    {
        double given = 0;
        foreach (ref readonly ContactPoint c in contacts)
        {
            given = Math.Max(given, c.Target - c.Restored);
        }

        double gain = 0;
        double allowed = 0;
        bool isPushed = false;
        for (int b = 0; b < bodies; b++)
        {
            if (IsHand(masses[b]))
            {
                isPushed = true;
                continue;
            }

            Vector3D v = velocities[b];
            Vector3D d = change[b];
            gain += masses[b] * (Vector3D.Dot(v, d) + (0.5 * d.LengthSquared));
            allowed += masses[b] * ((2 * given * given) + (Rounding * ((v.Length * d.Length) + d.LengthSquared)));
        }

        if (isPushed)
        {
            // What a hand does to the bodies is no gain: what counts is what the contacts make of the speeds at which they are met.
            gain = 0;
            for (int i = 0; i < contacts.Length; i++)
            {
                gain += impulse[i] * (Opening(contacts[i], velocities) + (0.5 * Opening(contacts[i], change.AsSpan(0, bodies))));
            }
        }

        return !(gain <= allowed);
    }

    /// <summary>Whether this is the mass of a body that a hand holds: infinite, so that nothing changes its velocity.</summary>
    private static bool IsHand(double mass) => double.IsPositiveInfinity(mass);

    /// <summary>Lawson and Hanson's active-set method; false if some demand cannot be met. Leaves the change of every velocity.</summary>
    private bool TrySolve(Span<ContactPoint> contacts, Span<double> masses, bool again)
    {
        int n = contacts.Length;
        int count = again ? kept : 0;
        double scale = 0;
        for (int i = 0; i < n; i++)
        {
            impulse[i] = 0;
            isActive[i] &= again;
            dependent[i] = false;
            scale = Math.Max(scale, Math.Abs(demand[i]));
        }

        Array.Clear(change, 0, bodies);
        count = count > 0 ? Retreat(contacts, masses, count) : 0;
        double least = Tolerance * scale;
        for (int pass = 0; pass < 10 * n; pass++)
        {
            int worst = -1;
            double gap = least;
            for (int i = 0; i < n; i++)
            {
                double missing = isActive[i] || dependent[i] ? 0 : Missing(contacts[i], i);
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
            if (!TryAddRow(contacts[worst], count, masses))
            {
                dependent[worst] = true; // its normal is a combination of those already active: it pushes nothing that they do not
                continue;
            }

            isActive[worst] = true;
            count = Retreat(contacts, masses, count + 1);
            Array.Clear(dependent, 0, n);
        }

        kept = count;
        for (int i = 0; i < n; i++)
        {
            if (!isActive[i] && Missing(contacts[i], i) > 1e3 * least)
            {
                return false;
            }
        }

        return true;
    }

    private double Missing(in ContactPoint contact, int i) => demand[i] - Opening(contact, change.AsSpan(0, bodies));

    /// <summary>Moves from the last impulses towards the active set's solution, dropping contacts that would have to pull.</summary>
    private int Retreat(Span<ContactPoint> contacts, Span<double> masses, int count)
    {
        while (true)
        {
            Substitute(count);
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
                ChangeBy(contacts, count, masses);
                return count;
            }

            count = Drop(contacts, masses, count);
        }
    }

    /// <summary>Takes the contacts whose impulse has come down to nothing out of the active set; the rows from the first of them on are made anew.</summary>
    private int Drop(Span<ContactPoint> contacts, Span<double> masses, int count)
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
            if (TryAddRow(contacts[i], row, masses))
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

    /// <summary>
    /// Makes the basis row of a contact: its own row less what it shares with the rows before, twice, so that rounding leaves nothing of
    /// them. False if nothing is left.
    /// </summary>
    private bool TryAddRow(in ContactPoint contact, int row, Span<double> masses)
    {
        Span<Vector3D> mine = basis.AsSpan(row * bodies, bodies);
        Span<double> shares = share.AsSpan(row * demand.Length, row + 1);
        mine.Clear();
        shares.Clear();
        Array.Clear(size, 0, bodies);
        mine[contact.First] = contact.Normal;
        size[contact.First] = 1;
        if (contact.Second != ContactPoint.Static)
        {
            mine[contact.Second] = -contact.Normal;
            size[contact.Second] = 1;
        }

        TakeAway(mine, shares, row, masses);
        for (int b = 0; b < bodies; b++)
        {
            if (mine[b].Length <= Cancelled * size[b])
            {
                mine[b] = Vector3D.Zero; // a part this small that counts, at a light body between heavy ones, comes back in the second pass
            }
        }

        TakeAway(mine, shares, row, masses);
        weight[row] = Product(mine, mine, masses);
        for (int b = 0; b < bodies; b++)
        {
            extent[(row * bodies) + b] = mine[b].Length;
        }

        return weight[row] > 0;
    }

    private void TakeAway(Span<Vector3D> mine, Span<double> shares, int rows, Span<double> masses)
    {
        for (int k = 0; k < rows; k++)
        {
            Span<Vector3D> theirs = basis.AsSpan(k * bodies, bodies);
            double part = Product(mine, theirs, masses) / weight[k];
            shares[k] += part;
            for (int b = 0; b < bodies && part != 0; b++)
            {
                double length = extent[(k * bodies) + b];
                if (length > 0)
                {
                    mine[b] -= theirs[b] * part;
                    size[b] = Math.Max(size[b], length * Math.Abs(part));
                }
            }
        }
    }

    private static double Product(Span<Vector3D> a, Span<Vector3D> b, Span<double> masses)
    {
        double sum = 0;
        for (int i = 0; i < a.Length; i++)
        {
            sum += Vector3D.Dot(a[i], b[i]) / masses[i];
        }

        return sum;
    }

    /// <summary>The impulses with which the active contacts meet their demands exactly: first along the basis rows, then of each contact.</summary>
    private void Substitute(int count)
    {
        for (int r = 0; r < count; r++)
        {
            double rest = demand[active[r]];
            for (int k = 0; k < r; k++)
            {
                rest -= share[(r * demand.Length) + k] * (along[k] * weight[k]);
            }

            along[r] = rest / weight[r];
        }

        for (int r = count - 1; r >= 0; r--)
        {
            trial[r] = along[r];
            for (int k = r + 1; k < count; k++)
            {
                trial[r] -= share[(k * demand.Length) + r] * trial[k];
            }
        }
    }

    /// <summary>
    /// The bodies' changes of velocity: by the contacts' impulses, which keep a symmetric impact symmetric, but along the basis rows where
    /// the impulses at a light body nearly cancel.
    /// </summary>
    private void ChangeBy(Span<ContactPoint> contacts, int count, Span<double> masses)
    {
        for (int b = 0; b < bodies; b++)
        {
            Vector3D byImpulse = Vector3D.Zero;
            Vector3D byBasis = Vector3D.Zero;
            double impulses = 0;
            double parts = 0;
            for (int k = 0; k < count; k++)
            {
                Vector3D part = basis[(k * bodies) + b] * along[k];
                byBasis += part;
                parts += part.Length;
                ref readonly ContactPoint c = ref contacts[active[k]];
                if (c.First == b || c.Second == b)
                {
                    byImpulse += c.Normal * (c.First == b ? trial[k] : -trial[k]);
                    impulses += Math.Abs(trial[k]);
                }
            }

            change[b] = (impulses <= 16 * parts ? byImpulse : byBasis) / masses[b];
        }
    }

    private void Grow(int contacts)
    {
        if (contacts > demand.Length)
        {
            int count = Math.Max(contacts, 2 * demand.Length);
            demand = new double[count];
            impulse = new double[count];
            active = new int[count];
            isActive = new bool[count];
            dependent = new bool[count];
            share = new double[count * count];
            weight = new double[count];
            along = new double[count];
            trial = new double[count];
        }

        if (bodies > change.Length)
        {
            int count = Math.Max(bodies, 2 * change.Length);
            size = new double[count];
            change = new Vector3D[count];
        }

        if (demand.Length * bodies > basis.Length)
        {
            basis = new Vector3D[demand.Length * Math.Max(bodies, change.Length)];
            extent = new double[basis.Length];
        }
    }
}
