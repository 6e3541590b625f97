using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Solves contacts that last together with Coulomb friction: normals and friction by turns, until neither changes the other any more.</summary>
/// <remarks>
/// <para>Along the normals it is <see cref="ImpactSolver"/>, exact at any ratio of masses; against the slip each contact gives what stops it, or as much as its normal impulse allows, one
/// contact after the other in their order (Kaufman et al. 2008, "Staggered projections for frictional contact in multibody systems"). It ends along the normals, so whatever friction has not
/// settled by then, nothing is driven into anything.</para>
/// <para>Cost: without friction that of one <see cref="ImpactSolver"/>, else up to <see cref="MostTurns"/> times it. Allocates only when there are more contacts or bodies than ever before.</para>
/// </remarks>
internal sealed class LastingContactSolver
{
    /// <summary>So many times at most normals and friction take turns.</summary>
    private const int MostTurns = 64;

    /// <summary>So many times if there are more contacts than are solved exactly.</summary>
    private const int FewTurns = 4;

    /// <summary>So often friction goes through all contacts in a turn.</summary>
    private const int Sweeps = 4;

    /// <summary>What changes by less than this part of the largest speed is settled.</summary>
    private const double Settled = 1e-10;

    private readonly ImpactSolver normals = new();
    private Vector3D[] rubbing = Array.Empty<Vector3D>(); // the friction's impulse on the first of each contact
    private Vector3D[] freeVelocities = Array.Empty<Vector3D>();
    private Vector3D[] freeSpins = Array.Empty<Vector3D>();

    /// <summary>Changes velocities and spins so that each contact opens at least at its target, or pushes.</summary>
    /// <param name="contacts">With normals and targets; the impulses along the normals are set.</param>
    /// <param name="coefficients">Of friction, by number of contact; all zero: the spins stay as they are.</param>
    /// <param name="masses">By number of body, like the rest.</param>
    /// <param name="radii">In metres.</param>
    /// <param name="velocities">In m/s.</param>
    /// <param name="spins">In rad/s.</param>
    /// <param name="again">Whether the bodies and normals are those that were solved last.</param>
    internal void Solve(
        Span<ContactPoint> contacts, Span<double> coefficients, Span<double> masses, Span<double> radii, Span<Vector3D> velocities, Span<Vector3D> spins, bool again)
    {
        double most = 0;
        for (int i = 0; i < coefficients.Length; i++)
        {
            most = Math.Max(most, coefficients[i]);
        }

        if (!(most > 0))
        {
            SolveNormals(contacts, masses, velocities, again);
            return;
        }

        Grow(contacts.Length, velocities.Length);
        velocities.CopyTo(freeVelocities);
        spins.CopyTo(freeSpins);
        Array.Clear(rubbing, 0, contacts.Length);
        double speed = 0;
        for (int b = 0; b < velocities.Length; b++)
        {
            speed = Math.Max(speed, Math.Max(velocities[b].Length, spins[b].Length * radii[b]));
        }

        int turns = contacts.Length > ImpactSolver.MostAtOnce ? FewTurns : MostTurns;
        for (int turn = 0; ; turn++)
        {
            freeVelocities.AsSpan(0, velocities.Length).CopyTo(velocities);
            freeSpins.AsSpan(0, spins.Length).CopyTo(spins);
            for (int i = 0; i < contacts.Length; i++)
            {
                Push(contacts[i], rubbing[i], masses, radii, velocities, spins);
            }

            SolveNormals(contacts, masses, velocities, again || turn > 0);
            if (turn == turns || !(Rub(contacts, coefficients, masses, radii, velocities, spins) > Settled * speed))
            {
                return;
            }
        }
    }

    private void SolveNormals(Span<ContactPoint> contacts, Span<double> masses, Span<Vector3D> velocities, bool again)
    {
        if (again)
        {
            normals.SolveAgain(contacts, masses, velocities);
        }
        else
        {
            normals.Solve(contacts, masses, velocities);
        }
    }

    /// <summary>One turn of friction. Returns by how much of a speed it has changed at most; if that is next to nothing, the velocities are those that it was left with.</summary>
    private double Rub(
        Span<ContactPoint> contacts, Span<double> coefficients, Span<double> masses, Span<double> radii, Span<Vector3D> velocities, Span<Vector3D> spins)
    {
        double most = 0;
        for (int sweep = 0; sweep < Sweeps; sweep++)
        {
            for (int i = 0; i < contacts.Length; i++)
            {
                ref readonly ContactPoint c = ref contacts[i];
                double inverse = (1 / masses[c.First]) + (c.Second == ContactPoint.Static ? 0 : 1 / masses[c.Second]);
                Vector3D slip = ImpactFriction.Slip(c, radii, velocities, spins);
                Vector3D wanted = rubbing[i] - (slip / (ImpactFriction.SlipPerImpulse * inverse));
                double allowed = coefficients[i] * c.Impulse;
                double size = wanted.Length;
                wanted = size > allowed ? wanted * (allowed / size) : wanted;
                Vector3D change = wanted - rubbing[i];
                if (change != Vector3D.Zero)
                {
                    Push(c, change, masses, radii, velocities, spins);
                    rubbing[i] = wanted;
                    most = Math.Max(most, change.Length * inverse);
                }
            }
        }

        return most;
    }

    private static void Push(
        in ContactPoint c, in Vector3D push, Span<double> masses, Span<double> radii, Span<Vector3D> velocities, Span<Vector3D> spins)
    {
        if (push == Vector3D.Zero)
        {
            return;
        }

        Vector3D turn = Vector3D.Cross(push, c.Normal) * ImpactFriction.TurnPerImpulse;
        velocities[c.First] += push / masses[c.First];
        spins[c.First] += turn / (masses[c.First] * radii[c.First]);
        if (c.Second != ContactPoint.Static)
        {
            velocities[c.Second] -= push / masses[c.Second];
            spins[c.Second] += turn / (masses[c.Second] * radii[c.Second]);
        }
    }

    private void Grow(int contacts, int bodies)
    {
        if (contacts > rubbing.Length)
        {
            rubbing = new Vector3D[contacts * 2];
        }

        if (bodies > freeVelocities.Length)
        {
            freeVelocities = new Vector3D[bodies * 2];
            freeSpins = new Vector3D[bodies * 2];
        }
    }
}
