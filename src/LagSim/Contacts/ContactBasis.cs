using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>
/// The rows of contacts that push, made orthogonal, and what follows from them: the impulses with which each meets its demand, and how they
/// change the velocities.
/// </summary>
/// <remarks>
/// <para>A contact's row is its part in each body's motion: its normal at the first, the opposite at the second. They are made orthogonal
/// in the space of the bodies' motions, by modified Gram-Schmidt with 1/mass as weight, rather than by factors of the matrix of their
/// products: where a light body carries a heavy one, that matrix has already lost the heavy one to rounding. No square roots in what is
/// solved: small integer systems, such as equal masses in a row, stay exact and a symmetric impact keeps its symmetry.</para>
/// <para>Cost: a row is made in the rows before it times the bodies. Allocates only when there are more contacts or bodies than ever
/// before.</para>
/// </remarks>
internal sealed class ContactBasis
{
    /// <summary>
    /// The remainder of a row's part at one body counts as zero below this share of what was subtracted: normals that differ by less than a
    /// microradian are one. So a light body squeezed between two such is held, and not shot out sideways at a million times their speed.
    /// </summary>
    internal const double Cancelled = 1e-6;

    private Vector3D[] basis = Array.Empty<Vector3D>(); // row by row: the orthogonal rows, a part for each body
    private double[] extent = Array.Empty<double>(); // the lengths of those parts
    private double[] share = Array.Empty<double>(); // row by row: how much of each earlier basis row a contact's row has
    private double[] weight = Array.Empty<double>(); // of a basis row: its square, by 1/mass
    private double[] along = Array.Empty<double>(); // the impulse along each basis row
    private double[] size = Array.Empty<double>(); // by body, for the current row: the largest that its part has been
    private int bodies;
    private int stride;

    /// <summary>Begins again, with room for that many rows of that many bodies.</summary>
    internal void Clear(int rows, int bodyCount)
    {
        bodies = bodyCount;
        if (rows > stride)
        {
            stride = Math.Max(rows, 2 * stride);
            share = new double[stride * stride];
            weight = new double[stride];
            along = new double[stride];
        }

        if (bodies > size.Length)
        {
            size = new double[Math.Max(bodies, 2 * size.Length)];
        }

        if (stride * bodies > basis.Length)
        {
            basis = new Vector3D[stride * Math.Max(bodies, size.Length)];
            extent = new double[basis.Length];
        }
    }

    /// <summary>
    /// Makes the basis row of a contact: its own row less what it shares with the rows before, twice, so that rounding leaves nothing of
    /// them. False if nothing is left: at a body that the contact has no part in, rounding may leave something that was never larger.
    /// </summary>
    internal bool TryAdd(in ContactPoint contact, int row, Span<double> masses)
    {
        Span<Vector3D> mine = basis.AsSpan(row * bodies, bodies);
        Span<double> shares = share.AsSpan(row * stride, row + 1);
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
        TakeAway(mine, shares, row, masses);
        if (Cut(mine))
        {
            // Add back what the rows before need of it, as at a light body between heavy ones. That changes no share: shares are those of
            // the contact as it is.
            TakeAway(mine, Span<double>.Empty, row, masses);
        }

        weight[row] = Product(mine, mine, masses);
        double left = 0;
        double largest = 0;
        for (int b = 0; b < bodies; b++)
        {
            extent[(row * bodies) + b] = mine[b].Length;
            left = Math.Max(left, mine[b].Length);
            largest = Math.Max(largest, size[b]);
        }

        return left > Cancelled * largest;
    }

    /// <summary>Makes nothing of the parts that have cancelled; whether there were any.</summary>
    private bool Cut(Span<Vector3D> mine)
    {
        bool has = false;
        for (int b = 0; b < bodies; b++)
        {
            if (mine[b] != Vector3D.Zero && mine[b].Length <= Cancelled * size[b])
            {
                mine[b] = Vector3D.Zero;
                has = true;
            }
        }

        return has;
    }

    private void TakeAway(Span<Vector3D> mine, Span<double> shares, int rows, Span<double> masses)
    {
        for (int k = 0; k < rows; k++)
        {
            Span<Vector3D> theirs = basis.AsSpan(k * bodies, bodies);
            double part = Product(mine, theirs, masses) / weight[k];
            if (!shares.IsEmpty)
            {
                shares[k] += part;
            }

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

    /// <summary>
    /// The impulses with which the active contacts meet their demands exactly: first along the basis rows, then of each contact.
    /// </summary>
    internal void Substitute(Span<double> demand, Span<int> active, int count, Span<double> trial)
    {
        for (int r = 0; r < count; r++)
        {
            double rest = demand[active[r]];
            for (int k = 0; k < r; k++)
            {
                rest -= share[(r * stride) + k] * (along[k] * weight[k]);
            }

            along[r] = rest / weight[r];
        }

        OfContacts(along, count, trial);
    }

    /// <summary>How much of each row before a row that nothing was left of is made, <paramref name="row"/> of them.</summary>
    internal void Combine(int row, Span<double> parts) => OfContacts(share.AsSpan(row * stride, row), row, parts);

    /// <summary>From parts of the basis rows to parts of the contacts' own.</summary>
    private void OfContacts(Span<double> ofBasis, int count, Span<double> ofContacts)
    {
        for (int r = count - 1; r >= 0; r--)
        {
            ofContacts[r] = ofBasis[r];
            for (int k = r + 1; k < count; k++)
            {
                ofContacts[r] -= share[(k * stride) + r] * ofContacts[k];
            }
        }
    }

    /// <summary>
    /// The bodies' changes of velocity: by the contacts' impulses, which keep a symmetric impact symmetric, but along the basis rows where
    /// the impulses at a light body nearly cancel.
    /// </summary>
    internal void ChangeBy(Span<ContactPoint> contacts, Span<int> active, int count, Span<double> trial, Span<double> masses, Span<Vector3D> change)
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
                parts += extent[(k * bodies) + b] * Math.Abs(along[k]);
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
}
