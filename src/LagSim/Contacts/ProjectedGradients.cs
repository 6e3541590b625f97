using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Solves many contacts at once, such as a large heap, by conjugate gradients that are kept from pulling.</summary>
/// <remarks>
/// <para>It solves the problem of <see cref="ActiveSet"/>: the impulses p >= 0 that minimise 1/2 p'Ap - p'demand, which is the change of
/// energy where nothing is to open after. The method is "modified proportioning with reduced gradient projections" (Dostál and Schöberl
/// 2005, Comput. Optim. Appl. 30, 23-43): conjugate gradients among the contacts that push, a step along the gradient cut off at zero where
/// one of them would pull, and one along what closes where that has come to outweigh the rest. The minimised quantity never grows. So where
/// nothing is to part faster than at rest no energy is gained, whenever it ends.</para>
/// <para>Each contact is measured by the root of its 1/mass, so that unequal masses count alike. Cost: the number of contacts, times some
/// 50 to 300 steps, at most <see cref="MaxSteps"/>; more where light bodies carry heavy ones. Allocates only when there are more contacts
/// or bodies than ever before.</para>
/// </remarks>
internal sealed class ProjectedGradients
{
    /// <summary>The largest number of steps.</summary>
    internal const int MaxSteps = 1000;

    /// <summary>A demand counts as met once its shortfall is below this part of the largest that any contact had.</summary>
    private const double Met = 1e-12;

    /// <summary>And what lacks more than this part of it at the end is not.</summary>
    private const double NotMet = 1e-9;

    private double[] scales = Array.Empty<double>(); // by contact: what its impulse is measured in
    private double[] impulses = Array.Empty<double>(); // in those
    private double[] gradient = Array.Empty<double>(); // how much faster than asked for each opens, likewise
    private double[] direction = Array.Empty<double>();
    private double[] response = Array.Empty<double>(); // of the gradient to a step along the direction

    /// <summary>How many steps the last took.</summary>
    internal int Steps { get; private set; }

    /// <summary>
    /// Solves; false if some demand cannot be met, or was not within the steps. Leaves the impulses, and the change of every velocity.
    /// </summary>
    /// <param name="contacts">With their normals.</param>
    /// <param name="masses">By number of body, in kg; a held one has an infinite mass.</param>
    /// <param name="demand">By contact: by how much faster it is to open, at least.</param>
    /// <param name="impulse">By contact: is set.</param>
    /// <param name="change">By body: is set.</param>
    /// <param name="again">Whether to begin with the contacts' impulses as they are, not with none.</param>
    /// <param name="enough">A shortfall of no more than this, in m/s, counts as met too.</param>
    /// <param name="steps">The largest number of steps.</param>
    internal bool TrySolve(
        Span<ContactPoint> contacts, Span<double> masses, Span<double> demand, Span<double> impulse, Span<Vector3D> change, bool again,
        double enough = 0, int steps = MaxSteps)
    {
        Grow(contacts.Length);
        double stride = Prepare(contacts, masses, demand, change, again, out double lacking);
        double most = 0;
        Begin(contacts);
        for (Steps = 0; Steps < steps; Steps++)
        {
            double free = 0; // how far from met those are that push, each no further than until it pulls no more
            double bound = 0; // and those that do not, and close
            most = 0;
            for (int i = 0; i < contacts.Length; i++)
            {
                double g = gradient[i];
                if (impulses[i] > 0)
                {
                    free += Math.Min(impulses[i] / stride, g) * g;
                    most = Math.Max(most, Math.Abs(g) / scales[i]);
                }
                else if (g < 0)
                {
                    bound += g * g;
                    most = Math.Max(most, -g / scales[i]);
                }
            }

            if (!(most > Math.Max(enough, Met * lacking)))
            {
                break;
            }

            bool goesOn = bound <= free ? Follow(contacts, masses, demand, change, stride) : Release(contacts, masses, change);
            if (!goesOn)
            {
                break;
            }
        }

        for (int i = 0; i < contacts.Length; i++)
        {
            impulse[i] = impulses[i] * scales[i];
        }

        Respond(contacts, masses, impulses, change);
        return most <= Math.Max(enough, NotMet * lacking);
    }

    /// <summary>Scales, first impulses and the gradient there. Returns a step along the gradient that is sure to lead down.</summary>
    private double Prepare(Span<ContactPoint> contacts, Span<double> masses, Span<double> demand, Span<Vector3D> change, bool again, out double lacking)
    {
        change.Clear();
        lacking = 0;
        for (int i = 0; i < contacts.Length; i++)
        {
            ref readonly ContactPoint c = ref contacts[i];
            double inverse = ImpactSolver.Inverse(masses[c.First]) + (c.Second == ContactPoint.Static ? 0 : ImpactSolver.Inverse(masses[c.Second]));
            scales[i] = inverse > 0 ? 1 / Math.Sqrt(inverse) : 0; // of two hands: nothing changes how they open
            impulses[i] = again && inverse > 0 ? c.Impulse / scales[i] : 0;
            lacking = inverse > 0 ? Math.Max(lacking, Math.Abs(demand[i])) : lacking;
            change[c.First] += new Vector3D(scales[i], 0, 0);
            if (c.Second != ContactPoint.Static)
            {
                change[c.Second] += new Vector3D(scales[i], 0, 0);
            }
        }

        double norm = 1; // at least as large as what multiplies any impulses most: the largest sum of a row of A, without signs
        for (int i = 0; i < contacts.Length; i++)
        {
            ref readonly ContactPoint c = ref contacts[i];
            double row = scales[i] * ((change[c.First].X * ImpactSolver.Inverse(masses[c.First]))
                + (c.Second == ContactPoint.Static ? 0 : change[c.Second].X * ImpactSolver.Inverse(masses[c.Second])));
            norm = Math.Max(norm, row);
        }

        Evaluate(contacts, masses, demand, change);
        return 1.75 / norm;
    }

    /// <summary>
    /// A step along the direction, or as far along it as no contact pulls, and then one along the gradient. False if that gains nothing.
    /// </summary>
    private bool Follow(Span<ContactPoint> contacts, Span<double> masses, Span<double> demand, Span<Vector3D> change, double stride)
    {
        double curvature = Probe(contacts, masses, change);
        if (!(curvature > 0))
        {
            return false;
        }

        double slope = 0;
        double room = double.PositiveInfinity;
        for (int i = 0; i < contacts.Length; i++)
        {
            slope += gradient[i] * direction[i];
            room = direction[i] > 0 ? Math.Min(room, impulses[i] / direction[i]) : room;
        }

        double along = Math.Min(slope / curvature, room);
        for (int i = 0; i < contacts.Length; i++)
        {
            impulses[i] = Math.Max(0, impulses[i] - (along * direction[i]));
            gradient[i] -= along * response[i];
        }

        if (along < room)
        {
            double kept = 0; // so that the next direction undoes nothing of this one
            for (int i = 0; i < contacts.Length; i++)
            {
                kept += impulses[i] > 0 ? gradient[i] * response[i] : 0;
            }

            for (int i = 0; i < contacts.Length; i++)
            {
                direction[i] = (impulses[i] > 0 ? gradient[i] : 0) - (kept / curvature * direction[i]);
            }

            return true;
        }

        for (int i = 0; i < contacts.Length; i++)
        {
            impulses[i] = Math.Max(0, impulses[i] - (impulses[i] > 0 ? stride * gradient[i] : 0));
        }

        Evaluate(contacts, masses, demand, change);
        Begin(contacts);
        return true;
    }

    /// <summary>Lets those push that do not and close.</summary>
    private bool Release(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> change)
    {
        double slope = 0;
        for (int i = 0; i < contacts.Length; i++)
        {
            direction[i] = impulses[i] > 0 ? 0 : Math.Min(0, gradient[i]);
            slope += gradient[i] * direction[i];
        }

        double curvature = Probe(contacts, masses, change);
        if (!(curvature > 0))
        {
            return false;
        }

        for (int i = 0; i < contacts.Length; i++)
        {
            impulses[i] -= slope / curvature * direction[i];
            gradient[i] -= slope / curvature * response[i];
        }

        Begin(contacts);
        return true;
    }

    /// <summary>Begins a new sequence of directions: down the gradient, among those that push.</summary>
    private void Begin(Span<ContactPoint> contacts)
    {
        for (int i = 0; i < contacts.Length; i++)
        {
            direction[i] = impulses[i] > 0 ? gradient[i] : 0;
        }
    }

    /// <summary>How the gradient responds to the direction; returns how much, along it.</summary>
    private double Probe(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> change)
    {
        Respond(contacts, masses, direction, change);
        double curvature = 0;
        for (int i = 0; i < contacts.Length; i++)
        {
            response[i] = scales[i] * ImpactSolver.Opening(contacts[i], change);
            curvature += direction[i] * response[i];
        }

        return curvature;
    }

    /// <summary>The gradient at the impulses as they are.</summary>
    private void Evaluate(Span<ContactPoint> contacts, Span<double> masses, Span<double> demand, Span<Vector3D> change)
    {
        Respond(contacts, masses, impulses, change);
        for (int i = 0; i < contacts.Length; i++)
        {
            gradient[i] = scales[i] * (ImpactSolver.Opening(contacts[i], change) - demand[i]);
        }
    }

    /// <summary>The changes of velocity that impulses make.</summary>
    private void Respond(Span<ContactPoint> contacts, Span<double> masses, double[] pushes, Span<Vector3D> change)
    {
        change.Clear();
        for (int i = 0; i < contacts.Length; i++)
        {
            ref readonly ContactPoint c = ref contacts[i];
            Vector3D push = c.Normal * (scales[i] * pushes[i]);
            change[c.First] += push * ImpactSolver.Inverse(masses[c.First]);
            if (c.Second != ContactPoint.Static)
            {
                change[c.Second] -= push * ImpactSolver.Inverse(masses[c.Second]);
            }
        }
    }

    private void Grow(int contacts)
    {
        if (contacts > impulses.Length)
        {
            int count = Math.Max(contacts, 2 * impulses.Length);
            scales = new double[count];
            impulses = new double[count];
            gradient = new double[count];
            direction = new double[count];
            response = new double[count];
        }
    }
}
