using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>
/// Poisson's law for contacts that are struck together: first all are pressed until none closes, then each gives back what it was pressed
/// with, times its restitution.
/// </summary>
/// <remarks>
/// <para>In the metric of the masses, the velocities at which no contact closes are a convex cone T. Pressing takes the velocities v to w,
/// the point of T that is nearest: w = v + y, where y is what the impulses do, and w and y are at right angles. So pressing takes the
/// energy of y. The same impulses again, times the restitutions, would add z. Where z makes other contacts close, these are pressed too: d
/// is the point of T that is nearest to z. Then w + s d closes nowhere for any s of at least zero, all its impulses push, and s is where
/// the energy is back. It never is more than before, and where nothing loses any it is the same. Momentum is kept, since impulses are.</para>
/// <para>Only what is jammed has no such d: contacts whose pushes cancel each other, as those of a row that just fits between two walls.
/// What was closing there is lost. As is all of it where d is so small that it is rounding (<see cref="LeastPart"/>).</para>
/// <para>Reference: Poisson's hypothesis as in Glocker and Pfeiffer 1995 (Nonlinear Dyn. 7, 471-497). Cone and nearest point: Moreau 1962.
/// That d is zero only if T is a subspace: Gaddum 1952 (Proc. AMS 3, 957-960).</para>
/// <para>Deterministic: contacts come in canonical order. Cost: two solutions of <see cref="NormalImpulses"/>. Allocates only for more
/// contacts or bodies than ever before.</para>
/// </remarks>
internal sealed class PoissonImpact
{
    /// <summary>
    /// The least size of d for a size of z: 2^-20, which is 2^32 roundings of a double. Then the error of d, multiplied by s, stays as far
    /// below the speeds as that of a solution with masses of 10^12 to one.
    /// </summary>
    private const double LeastPart = 1.0 / (1 << 20);

    /// <summary>To and fro between the two ends of a light body: more would change nothing that can be told from rounding.</summary>
    private const int MaxSweeps = 64;

    private readonly NormalImpulses normals = new();
    private double[] demand = Array.Empty<double>(); // by contact
    private double[] impulse = Array.Empty<double>(); // by contact
    private Vector3D[] pressed = Array.Empty<Vector3D>(); // by body: w, then the velocities after the impact
    private Vector3D[] back = Array.Empty<Vector3D>(); // by body: z, then d
    private Vector3D[] change = Array.Empty<Vector3D>(); // by body

    /// <summary>Solves the impact, and sets the target of each contact to the speed at which it opens afterwards.</summary>
    /// <param name="contacts">All that touch, with their normals.</param>
    /// <param name="restitutions">Of each contact, 0 to 1.</param>
    /// <param name="masses">By number of body, in kg; none is infinite.</param>
    /// <param name="velocities">By number of body, before the impact; they stay as they are.</param>
    internal void Solve(Span<ContactPoint> contacts, Span<double> restitutions, Span<double> masses, Span<Vector3D> velocities)
    {
        Grow(contacts.Length, velocities.Length);
        Span<Vector3D> w = pressed.AsSpan(0, velocities.Length);
        Span<Vector3D> d = back.AsSpan(0, velocities.Length);
        AddPush(contacts, masses, velocities, w);
        Span<Vector3D> y = change.AsSpan(0, velocities.Length);
        double taken = Product(masses, y, y);
        Return(contacts, restitutions, masses, d);
        double z = Product(masses, d, d);
        double given = Math.Min(taken, z) * (1 - ImpactSolver.Rounding);
        AddPush(contacts, masses, d, d);
        double square = Product(masses, d, d);
        double along = Math.Max(0, Product(masses, w, d));
        double scale = square > LeastPart * LeastPart * z ? given / (along + Math.Sqrt((along * along) + (square * given))) : 0;
        for (int b = 0; b < w.Length; b++)
        {
            w[b] += d[b] * scale;
        }

        for (int i = 0; i < contacts.Length; i++)
        {
            contacts[i].Target = Math.Max(0, ImpactSolver.Opening(contacts[i], w));
        }
    }

    /// <summary>
    /// Gives the bodies the velocities of the last solution. What still closes there by rounding, as on a light body between heavy ones, is
    /// stopped contact by contact, by fractions of the masses.
    /// </summary>
    internal void Apply(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities)
    {
        pressed.AsSpan(0, velocities.Length).CopyTo(velocities);
        bool closes = true;
        for (int sweep = 0; sweep < MaxSweeps && closes; sweep++)
        {
            closes = false;
            for (int i = 0; i < contacts.Length; i++)
            {
                if (ImpactSolver.Opening(contacts[i], velocities) < 0)
                {
                    ContactPoint plastic = contacts[i];
                    plastic.Target = 0;
                    ImpactSolver.Single(ref plastic, masses, velocities);
                    closes = true;
                }
            }
        }
    }

    /// <summary>Sets the velocities at which no contact closes that are nearest to some; leaves the impulses.</summary>
    private void AddPush(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities, Span<Vector3D> result)
    {
        for (int i = 0; i < contacts.Length; i++)
        {
            demand[i] = -ImpactSolver.Opening(contacts[i], velocities);
        }

        Span<Vector3D> changes = change.AsSpan(0, velocities.Length);
        _ = normals.TrySolve(contacts, masses, demand.AsSpan(0, contacts.Length), impulse.AsSpan(0, contacts.Length), changes);
        for (int b = 0; b < velocities.Length; b++)
        {
            result[b] = velocities[b] + changes[b];
        }
    }

    /// <summary>Sets what the impulses do to the velocities, each times the restitution of its contact.</summary>
    private void Return(Span<ContactPoint> contacts, Span<double> restitutions, Span<double> masses, Span<Vector3D> result)
    {
        result.Clear();
        for (int i = 0; i < contacts.Length; i++)
        {
            ref readonly ContactPoint c = ref contacts[i];
            Vector3D push = c.Normal * (restitutions[i] * Math.Max(0, impulse[i]));
            result[c.First] += push * ImpactSolver.Inverse(masses[c.First]);
            if (c.Second != ContactPoint.Static)
            {
                result[c.Second] -= push * ImpactSolver.Inverse(masses[c.Second]);
            }
        }
    }

    /// <summary>The product of two sets of velocities in the metric of the masses.</summary>
    private static double Product(Span<double> masses, Span<Vector3D> a, Span<Vector3D> b)
    {
        double sum = 0;
        for (int i = 0; i < masses.Length; i++)
        {
            sum += masses[i] * Vector3D.Dot(a[i], b[i]);
        }

        return sum;
    }

    private void Grow(int contacts, int bodies)
    {
        if (contacts > demand.Length)
        {
            demand = new double[2 * contacts];
            impulse = new double[2 * contacts];
        }

        if (bodies > change.Length)
        {
            pressed = new Vector3D[2 * bodies];
            back = new Vector3D[2 * bodies];
            change = new Vector3D[2 * bodies];
        }
    }
}
