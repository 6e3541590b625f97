using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Solves all contacts of one impact together: what are the velocities after it?</summary>
/// <remarks>
/// <para>The law, for every contact i: separation speed u_i' >= target_i, impulse p_i >= 0, and one of the two is an equality. With the
/// targets e_i |u_i| of closing contacts this is Newton's law of restitution for each, made consistent by leaving out what would have to
/// pull. Energy changes by -1/2 sum (1 - e_i) p_i |u_i|, so it never grows for e_i at most 1 (Moreau 1988 treats this family).</para>
/// <para>If no velocities satisfy all targets (a body squeezed between surfaces that cannot give way), or only at an expense of energy,
/// every target becomes 0, which can always be had.</para>
/// <para>Solved by <see cref="NormalImpulses"/>. Allocates only when an impact has more contacts or bodies than any before.</para>
/// </remarks>
internal sealed class ImpactSolver
{
    /// <summary>By what share of what is exchanged the energy may be off by rounding.</summary>
    internal const double Rounding = 1e-9;

    private NormalImpulses? normals; // made when an impact has several contacts
    private double[] demand = Array.Empty<double>(); // by contact: target - u before
    private double[] impulse = Array.Empty<double>(); // by contact
    private Vector3D[] change = Array.Empty<Vector3D>(); // by body: of its velocity
    private int bodies;

    /// <summary>
    /// Changes the velocities by the impulses of all contacts. <paramref name="masses"/> and velocities by number of body; a held one has
    /// an infinite mass.
    /// </summary>
    internal void Solve(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities)
    {
        if (contacts.Length == 1)
        {
            Single(ref contacts[0], masses, velocities);
            return;
        }

        bodies = velocities.Length;
        Grow(contacts.Length);
        SolveSeveral(contacts, masses, velocities);
    }

    private void SolveSeveral(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities)
    {
        if (!TryMeet(contacts, masses, velocities))
        {
            Demand(contacts, velocities, part: 0);
            TrySolve(contacts, masses);
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

    /// <summary>How much an impulse changes a velocity: zero for a held body.</summary>
    internal static double Inverse(double mass) => IsHand(mass) ? 0 : 1 / mass;

    // By mass fractions instead of impulses: a few ulp at any mass ratio, and an elastic bounce off a plane is exactly a mirror.
    internal static void Single(ref ContactPoint c, Span<double> masses, Span<Vector3D> velocities)
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
    private bool TryMeet(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities)
    {
        Demand(contacts, velocities, part: 1);
        return TrySolve(contacts, masses) && !IsCostly(contacts, masses, velocities);
    }

    /// <summary>Asks for a part, all or nothing, of the targets.</summary>
    private void Demand(Span<ContactPoint> contacts, Span<Vector3D> velocities, double part)
    {
        for (int i = 0; i < contacts.Length; i++)
        {
            demand[i] = (part * contacts[i].Target) - Opening(contacts[i], velocities);
        }
    }

    /// <summary>Whether the bodies would gain energy, beyond rounding.</summary>
    private bool IsCostly(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities)
    {
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
            allowed += masses[b] * (Rounding * ((v.Length * d.Length) + d.LengthSquared));
        }

        if (isPushed)
        {
            // The work of a hand is not a gain: only what the contacts make of the approach speeds counts.
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

    /// <summary>Meets what is demanded, as far as it can be met: false if it cannot.</summary>
    private bool TrySolve(Span<ContactPoint> contacts, Span<double> masses)
    {
        Span<double> impulses = impulse.AsSpan(0, contacts.Length);
        Span<Vector3D> changes = change.AsSpan(0, bodies);
        normals ??= new NormalImpulses();
        return normals.TrySolve(contacts, masses, demand.AsSpan(0, contacts.Length), impulses, changes);
    }

    private void Grow(int contacts)
    {
        if (contacts > demand.Length)
        {
            int count = Math.Max(contacts, 2 * demand.Length);
            demand = new double[count];
            impulse = new double[count];
        }

        if (bodies > change.Length)
        {
            change = new Vector3D[Math.Max(bodies, 2 * change.Length)];
        }
    }
}
