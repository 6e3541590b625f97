using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <content>Sweeps through all contacts, each of which gets what it alone would need, made the gradient of conjugate gradients.</content>
/// <remarks>
/// What one sweep changes hardly gets on where many contacts carry something together, as those of a tower that leans. So after each the search goes on along
/// the direction it has had, by the ratio of the sizes of the last two changes, as long as they shrink (Silcowitz, Niebe and Erleben 2010, Vis. Comput. 26,
/// 893-901: nonsmooth nonlinear conjugate gradients, after Fletcher and Reeves).
/// </remarks>
internal sealed partial class LastingContactSolver
{
    /// <summary>So often at most all contacts are gone through in a turn.</summary>
    private const int Sweeps = 32;

    /// <summary>
    /// What a contact gives, by what it alone would need: more than 1, for its neighbours take some of it back. Below 2 no energy is gained by it.
    /// </summary>
    private const double Relaxation = 1.3;

    /// <summary>What changes by less than this part of the largest speed is settled.</summary>
    private const double Settled = 1e-9;

    private Way[] ways = Array.Empty<Way>(); // by contact
    private Way[] directions = Array.Empty<Way>();

    /// <summary>
    /// Goes through all contacts until a sweep changes no speed by more than <paramref name="settled"/>, or often enough. False if the first did not, and
    /// changed nothing that counts.
    /// </summary>
    private bool Sweep(Span<ContactPoint> contacts, Span<Rub> rubs, Span<double> radii, Span<Vector3D> velocities, Span<Vector3D> spins, double settled)
    {
        if (ways.Length < contacts.Length)
        {
            ways = new Way[Math.Max(contacts.Length, 2 * ways.Length)];
            directions = new Way[ways.Length];
        }

        double before = 0;
        for (int sweep = 0; sweep < Sweeps; sweep++)
        {
            double most = SweepOnce(contacts, rubs, radii, velocities, spins, out double size);
            if (!(most > settled))
            {
                return sweep > 0;
            }

            if (sweep < Sweeps - 1) // the last one leaves every contact within its law
            {
                GoOn(contacts, rubs, velocities, spins, size < before ? size / before : 0);
                before = size;
            }
        }

        return true;
    }

    /// <summary>
    /// Goes through all contacts once. Returns by how much of a speed that has changed any at most; the size is the energy that the changes of impulse alone would
    /// make.
    /// </summary>
    private double SweepOnce(
        Span<ContactPoint> contacts, Span<Rub> rubs, Span<double> radii, Span<Vector3D> velocities, Span<Vector3D> spins, out double size)
    {
        for (int b = 0; b < velocities.Length; b++)
        {
            bodies[b].VelocityBefore = velocities[b];
            bodies[b].SpinBefore = spins[b];
        }

        double most = 0;
        size = 0;
        for (int i = 0; i < contacts.Length; i++)
        {
            ref ContactPoint c = ref contacts[i];
            ref Rub rub = ref rubs[i];
            Way from = new() { Impulse = c.Impulse, Push = rub.Push, Turn = rub.Turn };
            most = Math.Max(most, Relax(ref c, ref rub, radii, velocities, spins));
            ref Way way = ref ways[i];
            way.Impulse = c.Impulse - from.Impulse;
            way.Push = rub.Push - from.Push;
            way.Turn = rub.Turn - from.Turn;
            bool isPair = c.Second != ContactPoint.Static;
            size += ((way.Impulse * way.Impulse) + (ImpactFriction.SlipPerImpulse * way.Push.LengthSquared)) * (bodies[c.First].PerPush + (isPair ? bodies[c.Second].PerPush : 0));
            size += way.Turn.LengthSquared * (bodies[c.First].PerTurn + (isPair ? bodies[c.Second].PerTurn : 0));
        }

        return most;
    }

    /// <summary>Goes on in the direction of the search, by so much of it, and makes what the last sweep has changed a part of that.</summary>
    private void GoOn(Span<ContactPoint> contacts, Span<Rub> rubs, Span<Vector3D> velocities, Span<Vector3D> spins, double kept)
    {
        for (int i = 0; i < contacts.Length; i++)
        {
            ref Way direction = ref directions[i];
            ref Way way = ref ways[i];
            if (kept > 0)
            {
                contacts[i].Impulse += kept * direction.Impulse;
                rubs[i].Push += direction.Push * kept;
                rubs[i].Turn += direction.Turn * kept;
                way.Impulse += kept * direction.Impulse;
                way.Push += direction.Push * kept;
                way.Turn += direction.Turn * kept;
            }

            direction = way;
        }

        for (int b = 0; b < velocities.Length; b++)
        {
            ref Body body = ref bodies[b];
            Vector3D more = kept > 0 ? body.VelocityWay * kept : Vector3D.Zero;
            Vector3D turning = kept > 0 ? body.SpinWay * kept : Vector3D.Zero;
            body.VelocityWay = velocities[b] - body.VelocityBefore + more;
            body.SpinWay = spins[b] - body.SpinBefore + turning;
            velocities[b] += more;
            spins[b] += turning;
        }
    }

    /// <summary>Gives a contact what it needs if nothing else changed. Returns by how much of a speed that has changed.</summary>
    private double Relax(ref ContactPoint c, ref Rub rub, Span<double> radii, Span<Vector3D> velocities, Span<Vector3D> spins)
    {
        bool isPair = c.Second != ContactPoint.Static;
        double inverse = bodies[c.First].PerPush + (isPair ? bodies[c.Second].PerPush : 0);
        double more = Math.Max(-c.Impulse, Relaxation * (c.Target - ImpactSolver.Opening(c, velocities)) / inverse);
        c.Impulse += more;
        PushAlong(c, more, velocities);

        Vector3D slip = ImpactFriction.Slip(c, radii, velocities, spins);
        // Gently: a ball that slips on a floor is pressed to a wall, which lifts it off the floor again, by mu² of what pressed it there. To follow that at once
        // would be to go to and fro for ever. What is not followed yet counts as change, or a strong friction would never be followed to its end.
        double lagging = ((rub.Friction * c.Impulse) - rub.Allowed) / (1 + (rub.Friction * rub.Friction));
        rub.Allowed += lagging;
        Vector3D wantedPush = rub.Push - (slip * (Relaxation / (ImpactFriction.SlipPerImpulse * inverse)));
        Vector3D push = Within(wantedPush, rub.Allowed);
        Vector3D across = push - rub.Push;
        rub.Push = push;
        PushAcross(c, across, velocities, spins);
        bool slips = wantedPush.LengthSquared > rub.Allowed * rub.Allowed;
        double most = Math.Max(Math.Max(Math.Abs(more), across.Length), slips ? rub.Friction * rub.Friction * Math.Abs(lagging) : 0) * inverse;

        if (rub.Lever > 0)
        {
            Vector3D turning = spins[c.First] - (isPair ? spins[c.Second] : Vector3D.Zero);
            double perTurn = bodies[c.First].PerTurn + (isPair ? bodies[c.Second].PerTurn : 0);
            Vector3D wanted = rub.Turn - (turning * (Relaxation / perTurn));
            Vector3D pivot = c.Normal * Vector3D.Dot(c.Normal, wanted);
            double allowed = rub.Lever * c.Impulse;
            Vector3D turn = Within(wanted - pivot, allowed) + Within(pivot, allowed) - rub.Turn;
            rub.Turn += turn;
            TurnBy(c, turn, spins);
            most = Math.Max(most, turn.Length * perTurn * radii[c.First]);
        }

        return most;
    }

    private static Vector3D Within(in Vector3D wanted, double allowed)
    {
        double size = wanted.Length;
        return size > allowed ? wanted * (allowed / size) : wanted;
    }

    /// <summary>By how much the impulses of a contact change.</summary>
    private struct Way
    {
        internal double Impulse;
        internal Vector3D Push;
        internal Vector3D Turn;
    }
}
