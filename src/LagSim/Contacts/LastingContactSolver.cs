using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Solves contacts that last together with Coulomb friction and rolling resistance.</summary>
/// <remarks>
/// <para>The law along the normals is that of <see cref="ImpactSolver"/>; across it each contact gives what stops the slip, or as much as its normal impulse
/// allows, and what stops the two from rolling, and from turning about the normal, on each other, or as much as that allows. All contacts are gone through in
/// their order, again and again, each with all three at once (Moreau and Jean's non-smooth contact dynamics; Jean 1999, Comput. Methods Appl. Mech. Eng. 177,
/// 235-257), with over-relaxation; then, with friction as it is, the normals are solved by themselves. So whatever friction has not settled by then, nothing is
/// driven into anything. That is repeated if the normals change much by it, as where a light body carries a heavy one.</para>
/// <para>Cost: without friction that of one <see cref="ImpactSolver"/>; else up to <see cref="UsualTurns"/> times that and up to <see cref="Sweeps"/> sweeps
/// each. Allocates only when there are more contacts or bodies than ever before.</para>
/// </remarks>
internal sealed partial class LastingContactSolver
{
    /// <summary>So many times friction is solved, and the normals after it, where nothing asks for more.</summary>
    internal const int UsualTurns = 4;

    private readonly ImpactSolver normals = new();
    private Body[] bodies = Array.Empty<Body>();

    /// <summary>Changes velocities and spins so that each contact opens at least at its target, or pushes.</summary>
    /// <param name="contacts">With normals and targets; the impulses along the normals are set.</param>
    /// <param name="rubs">By number of contact; without any friction the spins stay as they are.</param>
    /// <param name="masses">By number of body, like the rest; none is infinite.</param>
    /// <param name="radii">In metres.</param>
    /// <param name="velocities">In m/s.</param>
    /// <param name="spins">In rad/s.</param>
    /// <param name="start">What is known of the solution.</param>
    /// <param name="turns">So many times at most friction is solved, and the normals after it.</param>
    internal void Solve(
        Span<ContactPoint> contacts, Span<Rub> rubs, Span<double> masses, Span<double> radii, Span<Vector3D> velocities, Span<Vector3D> spins, Start start,
        int turns)
    {
        double most = 0;
        for (int i = 0; i < rubs.Length; i++)
        {
            most = Math.Max(most, rubs[i].Friction);
        }

        if (!(most > 0))
        {
            SolveNormals(contacts, masses, velocities, start == Start.Again);
            return;
        }

        double speed = Free(masses, radii, velocities, spins);
        if (start == Start.Anew)
        {
            for (int i = 0; i < rubs.Length; i++)
            {
                rubs[i].Push = Vector3D.Zero;
                rubs[i].Turn = Vector3D.Zero;
            }

            SolveNormals(contacts, masses, velocities, again: false);
            for (int i = 0; i < rubs.Length; i++)
            {
                rubs[i].Allowed = rubs[i].Friction * contacts[i].Impulse;
            }
        }
        else
        {
            for (int i = 0; i < contacts.Length; i++)
            {
                PushAcross(contacts[i], rubs[i].Push, velocities, spins);
                TurnBy(contacts[i], rubs[i].Turn, spins);
                PushAlong(contacts[i], contacts[i].Impulse, velocities);
            }
        }

        for (int turn = 0; turn < turns && (Sweep(contacts, rubs, radii, velocities, spins, Settled * speed) || (turn == 0 && start == Start.Near)); turn++)
        {
            for (int b = 0; b < velocities.Length; b++)
            {
                velocities[b] = bodies[b].Velocity;
                spins[b] = bodies[b].Spin;
            }

            for (int i = 0; i < contacts.Length; i++)
            {
                PushAcross(contacts[i], rubs[i].Push, velocities, spins);
                TurnBy(contacts[i], rubs[i].Turn, spins);
            }

            SolveNormals(contacts, masses, velocities, turn > 0 || start != Start.Near);
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

    /// <summary>Remembers how the bodies move without contacts; returns the largest speed, with the centre or on the surface.</summary>
    private double Free(Span<double> masses, Span<double> radii, Span<Vector3D> velocities, Span<Vector3D> spins)
    {
        if (velocities.Length > bodies.Length)
        {
            bodies = new Body[Math.Max(velocities.Length, 2 * bodies.Length)];
        }

        double speed = 0;
        for (int b = 0; b < velocities.Length; b++)
        {
            double turning = ImpactFriction.TurnPerImpulse / (masses[b] * radii[b]);
            bodies[b] = new Body { Velocity = velocities[b], Spin = spins[b], PerPush = 1 / masses[b], PerSurfacePush = turning, PerTurn = turning / radii[b] };
            speed = Math.Max(speed, Math.Max(velocities[b].Length, spins[b].Length * radii[b]));
        }

        return speed;
    }

    private void PushAlong(in ContactPoint c, double impulse, Span<Vector3D> velocities)
    {
        if (impulse != 0)
        {
            velocities[c.First] += c.Normal * (impulse * bodies[c.First].PerPush);
            if (c.Second != ContactPoint.Static)
            {
                velocities[c.Second] -= c.Normal * (impulse * bodies[c.Second].PerPush);
            }
        }
    }

    private void PushAcross(in ContactPoint c, in Vector3D push, Span<Vector3D> velocities, Span<Vector3D> spins)
    {
        if (push != Vector3D.Zero)
        {
            Vector3D turn = Vector3D.Cross(push, c.Normal);
            velocities[c.First] += push * bodies[c.First].PerPush;
            spins[c.First] += turn * bodies[c.First].PerSurfacePush;
            if (c.Second != ContactPoint.Static)
            {
                velocities[c.Second] -= push * bodies[c.Second].PerPush;
                spins[c.Second] += turn * bodies[c.Second].PerSurfacePush;
            }
        }
    }

    private void TurnBy(in ContactPoint c, in Vector3D turn, Span<Vector3D> spins)
    {
        if (turn != Vector3D.Zero)
        {
            spins[c.First] += turn * bodies[c.First].PerTurn;
            if (c.Second != ContactPoint.Static)
            {
                spins[c.Second] -= turn * bodies[c.Second].PerTurn;
            }
        }
    }

    /// <summary>What is known of a solution before it is looked for.</summary>
    internal enum Start
    {
        /// <summary>Nothing.</summary>
        Anew,

        /// <summary>The contacts' impulses are nearly right, though bodies or normals have changed.</summary>
        Near,

        /// <summary>Nearly right, and bodies and normals are those that were solved last.</summary>
        Again,
    }

    private struct Body
    {
        internal Vector3D Velocity; // without contacts
        internal Vector3D Spin;
        internal Vector3D VelocityBefore; // the last sweep
        internal Vector3D SpinBefore;
        internal Vector3D VelocityWay; // what the direction of the search changes
        internal Vector3D SpinWay;
        internal double PerPush; // of its velocity, by an impulse
        internal double PerSurfacePush; // of its spin, by one on its surface
        internal double PerTurn; // and by one that turns it
    }
}
