using System;
using LagSim.Motion;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>
/// Finds the impulses of a <see cref="ContactProblem"/>: each contact opens at least at its target, or pushes, with Coulomb friction and
/// rolling resistance.
/// </summary>
/// <remarks>
/// <para>The law of Stewart and Trinkle (1996, Int. J. Numer. Methods Eng. 39, 2673-2691) and of Anitescu and Potra (1997, Nonlinear Dyn.
/// 14, 231-247): along the normal opening >= target, impulse >= 0, one of the two an equality; across it the impulse against the slip that
/// stops it, or as much as mu times the normal impulse; and against turning on each other likewise, by a lever.</para>
/// <para>Projected Gauss-Seidel (Moreau and Jean's non-smooth contact dynamics; Jean 1999, Comput. Methods Appl. Mech. Eng. 177, 235-257):
/// contact after contact, to and fro, from the impulses that are given, until a sweep changes no contact's speed by more than the
/// tolerance.</para>
/// <para>Deterministic: the order of bodies and contacts counts, so both come in canonical order. Cost: contacts times sweeps.</para>
/// </remarks>
internal static class ContactSolver
{
    /// <summary>From 1 to the next number of 64 bits.</summary>
    private const double Epsilon = 1.0 / (1L << 52);

    /// <summary>
    /// Whether the impulses of the contacts can be added up: a light body between heavy ones gets two that cancel, and what is left of them
    /// is rounding, which may be no more than a tolerance, in m/s. Where it is more, sweeps change nothing and look settled.
    /// </summary>
    internal static bool CanAddUp(ContactProblem problem, double tolerance)
    {
        bool can = true;
        for (int i = 0; i < problem.ContactCount && can; i++)
        {
            ref readonly SolverContact c = ref problem.Contacts[i];
            can = c.Impulse * c.NormalInverse * Epsilon <= tolerance;
        }

        return can;
    }

    /// <summary>Adds what the impulses that the contacts begin with do to the bodies.</summary>
    internal static void ApplyGiven(ContactProblem problem)
    {
        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref SolverContact c = ref problem.Contacts[i];
            c.HasFrictionImpulse = c.FrictionImpulse != Vector3D.Zero;
            c.Bound = c.Friction * c.Impulse;
            if (c.Impulse != 0 || c.HasFrictionImpulse || c.Turn != Vector3D.Zero)
            {
                Apply(problem, c, (c.Normal * c.Impulse) + c.FrictionImpulse, c.FrictionImpulse, c.Turn);
            }
        }
    }

    /// <summary>Adds what the friction and the resistance alone do that the contacts have.</summary>
    internal static void ApplyFriction(ContactProblem problem)
    {
        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref problem.Contacts[i];
            if (c.FrictionImpulse != Vector3D.Zero || c.Turn != Vector3D.Zero)
            {
                Apply(problem, c, c.FrictionImpulse, c.FrictionImpulse, c.Turn);
            }
        }
    }

    /// <summary>
    /// Sweeps to and fro until no contact has bodies that others have changed by more than a tolerance, in m/s, since it was visited.
    /// </summary>
    /// <param name="problem">With targets.</param>
    /// <param name="tolerance">In m/s.</param>
    /// <param name="most">The largest number of sweeps.</param>
    /// <param name="knownBodies">The number of bodies that were there when it was solved before.</param>
    /// <param name="knownContacts">The number of contacts that were there then, and continue from that solution.</param>
    /// <returns>The number of sweeps it took.</returns>
    internal static int Solve(ContactProblem problem, double tolerance, int most, int knownBodies = 0, int knownContacts = 0)
    {
        SolverContact[] contacts = problem.Contacts;
        SolverBody[] bodies = problem.Bodies;
        int count = problem.ContactCount;
        for (int b = knownBodies; b < problem.BodyCount; b++)
        {
            bodies[b].Changed = 0;
        }

        for (int i = knownContacts; i < count; i++)
        {
            contacts[i].Seen = double.NegativeInfinity;
        }

        int sweeps = 0;
        for (bool isDone = false; !isDone && sweeps < most; sweeps++)
        {
            isDone = true;
            bool isForth = (sweeps & 1) == 0;
            for (int n = 0; n < count; n++)
            {
                ref SolverContact c = ref contacts[isForth ? n : count - 1 - n];
                ref SolverBody a = ref bodies[c.First];
                ref SolverBody b = ref bodies[Math.Max(0, c.Second)];
                bool isPair = c.Second >= 0;
                double changed = isPair ? a.Changed + b.Changed : a.Changed;
                if (changed - c.Seen <= tolerance)
                {
                    continue;
                }

                double change = isPair ? VisitPair(ref c, ref a, ref b) : VisitSurface(ref c, ref a);
                a.Changed += change;
                b.Changed += isPair ? change : 0;
                c.Seen = changed + (isPair ? 2 * change : change);
                if ((c.Follows < 1 || c.Lever > 0) && change > tolerance)
                {
                    c.Seen = double.NegativeInfinity; // the bound of its friction has a way to go, or resistance has changed what slips
                }

                isDone &= change <= tolerance;
            }
        }

        return sweeps;
    }

    /// <summary>
    /// Limits each hand's push to what would give all bodies that take part the speed that it asks for, and some more. So a hand throws and
    /// lifts whatever can give way, and goes through what cannot.
    /// </summary>
    /// <param name="problem">With targets, and the velocities before.</param>
    /// <param name="more">The speed, in m/s, that may be asked for besides.</param>
    internal static void LimitHands(ContactProblem problem, double more)
    {
        double mass = 0;
        bool hasHand = false;
        for (int b = 0; b < problem.BodyCount; b++)
        {
            bool isHand = problem.Bodies[b].InverseMass == 0;
            hasHand |= isHand;
            mass += isHand ? 0 : 1 / problem.Bodies[b].InverseMass;
        }

        for (int i = 0; i < problem.ContactCount && hasHand; i++)
        {
            ref SolverContact c = ref problem.Contacts[i];
            bool isByHand = problem.IsByHand(c, out int hand);
            c.Most = isByHand
                ? Math.Min(mass * (Math.Max(0, c.Target - Opening(problem, c)) + more), problem.HandRoom(hand) / HandStrength.WithFriction(c.Friction))
                : double.PositiveInfinity;
            c.Impulse = Math.Min(c.Impulse, c.Most);
            c.Seen = isByHand ? double.NegativeInfinity : c.Seen;
        }
    }

    /// <summary>
    /// Where a hand gives more in all its contacts together than it may, each of them is limited to its share of that; true if any is, and the
    /// problem has to be solved again.
    /// </summary>
    internal static bool ShareHands(ContactProblem problem)
    {
        bool any = false;
        for (int b = 0; b < problem.BodyCount; b++)
        {
            if (problem.Bodies[b].InverseMass > 0)
            {
                continue;
            }

            double given = GivenBy(problem, b);
            double room = problem.HandRoom(b);
            if (!(given > room * (1 + 1e-12))) // but for rounding, of a share that was kept
            {
                continue;
            }

            any = true;
            for (int i = 0; i < problem.ContactCount; i++)
            {
                ref SolverContact c = ref problem.Contacts[i];
                if (problem.IsByHand(c, out int hand) && hand == b)
                {
                    c.Most = c.Impulse * (room / given);
                    c.Impulse = c.Most;
                    c.Seen = double.NegativeInfinity;
                }
            }
        }

        return any;
    }

    /// <summary>The impulse that a held body gives in all its contacts together, with the most friction that goes with it, in N s.</summary>
    internal static double GivenBy(ContactProblem problem, int held)
    {
        double given = 0;
        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref problem.Contacts[i];
            given += c.First == held || c.Second == held ? c.Impulse * HandStrength.WithFriction(c.Friction) : 0;
        }

        return given;
    }

    /// <summary>How fast, and which way, the surfaces of the two of a contact slip on each other, in m/s.</summary>
    internal static Vector3D Slip(ContactProblem problem, in SolverContact c)
    {
        ref readonly SolverBody a = ref problem.Bodies[c.First];
        Vector3D velocity = a.Velocity;
        Vector3D rim = a.Spin * a.Radius;
        if (c.Second != ContactPoint.Static)
        {
            ref readonly SolverBody b = ref problem.Bodies[c.Second];
            velocity -= b.Velocity;
            rim += b.Spin * b.Radius;
        }

        return velocity - (c.Normal * Vector3D.Dot(c.Normal, velocity)) - Vector3D.Cross(rim, c.Normal);
    }

    /// <summary>How fast the two of a contact part; negative while they close.</summary>
    internal static double Opening(ContactProblem problem, in SolverContact c) =>
        Vector3D.Dot(c.Normal, c.Second == ContactPoint.Static
            ? problem.Bodies[c.First].Velocity : problem.Bodies[c.First].Velocity - problem.Bodies[c.Second].Velocity);

    /// <summary>Gives a contact of two bodies what it lacks; returns by how much that changes a speed.</summary>
    /// <remarks>Component by component: this is what nearly all the time of a heap goes into, and vectors pass through memory.</remarks>
    private static double VisitPair(ref SolverContact c, ref SolverBody a, ref SolverBody b)
    {
        double nx = c.Normal.X, ny = c.Normal.Y, nz = c.Normal.Z;
        double vx = a.Velocity.X - b.Velocity.X, vy = a.Velocity.Y - b.Velocity.Y, vz = a.Velocity.Z - b.Velocity.Z;
        double opening = (nx * vx) + (ny * vy) + (nz * vz);
        double impulse = Math.Min(c.Most, Math.Max(0, c.Impulse + ((c.Target - opening) * c.NormalMass)));
        double along = impulse - c.Impulse;
        double change = Math.Abs(along) * c.NormalInverse;
        c.Impulse = impulse;
        double px = nx * along, py = ny * along, pz = nz * along;
        if (c.Friction > 0 && (impulse > 0 || c.HasFrictionImpulse))
        {
            // The slip: the surfaces' velocities across the normal.
            double lx = (a.Spin.X * a.Radius) + (b.Spin.X * b.Radius), ly = (a.Spin.Y * a.Radius) + (b.Spin.Y * b.Radius);
            double lz = (a.Spin.Z * a.Radius) + (b.Spin.Z * b.Radius);
            double sx = vx - (nx * opening) - ((ly * nz) - (lz * ny)), sy = vy - (ny * opening) - ((lz * nx) - (lx * nz));
            double sz = vz - (nz * opening) - ((lx * ny) - (ly * nx));
            double rx = c.FrictionImpulse.X - (sx * c.FrictionMass), ry = c.FrictionImpulse.Y - (sy * c.FrictionMass), rz = c.FrictionImpulse.Z - (sz * c.FrictionMass);
            double square = (rx * rx) + (ry * ry) + (rz * rz);
            double most = c.Follows == 1 ? c.Friction * impulse : Follow(ref c, square);
            if (square > most * most)
            {
                double part = most / Math.Sqrt(square);
                (rx, ry, rz) = (rx * part, ry * part, rz * part);
            }

            double qx = rx - c.FrictionImpulse.X, qy = ry - c.FrictionImpulse.Y, qz = rz - c.FrictionImpulse.Z;
            c.FrictionImpulse = new Vector3D(rx, ry, rz);
            c.HasFrictionImpulse = impulse > 0 || c.Follows < 1;
            (px, py, pz) = (px + qx, py + qy, pz + qz);
            double slips = Math.Sqrt((qx * qx) + (qy * qy) + (qz * qz)) * ImpactFriction.SlipPerImpulse * c.NormalInverse;
            change = Math.Max(change, slips);
            double tx = (qy * nz) - (qz * ny), ty = (qz * nx) - (qx * nz), tz = (qx * ny) - (qy * nx);
            double turnA = ImpactFriction.TurnPerImpulse * a.InverseMass / a.Radius;
            double turnB = ImpactFriction.TurnPerImpulse * b.InverseMass / b.Radius;
            a.Spin = new Vector3D(a.Spin.X + (tx * turnA), a.Spin.Y + (ty * turnA), a.Spin.Z + (tz * turnA));
            b.Spin = new Vector3D(b.Spin.X + (tx * turnB), b.Spin.Y + (ty * turnB), b.Spin.Z + (tz * turnB));
        }

        double ia = a.InverseMass, ib = b.InverseMass;
        a.Velocity = new Vector3D(a.Velocity.X + (px * ia), a.Velocity.Y + (py * ia), a.Velocity.Z + (pz * ia));
        b.Velocity = new Vector3D(b.Velocity.X - (px * ib), b.Velocity.Y - (py * ib), b.Velocity.Z - (pz * ib));
        return c.Lever > 0 ? Math.Max(change, Resist(ref c, ref a, ref b, isPair: true)) : change;
    }

    /// <summary>The same of a body and a static surface.</summary>
    private static double VisitSurface(ref SolverContact c, ref SolverBody a)
    {
        Vector3D relative = a.Velocity;
        double opening = Vector3D.Dot(c.Normal, relative);
        double impulse = Math.Min(c.Most, Math.Max(0, c.Impulse + ((c.Target - opening) * c.NormalMass)));
        double along = impulse - c.Impulse;
        double change = Math.Abs(along) * c.NormalInverse;
        c.Impulse = impulse;
        Vector3D push = c.Normal * along;
        if (c.Friction > 0 && (impulse > 0 || c.HasFrictionImpulse))
        {
            Vector3D slip = relative - (c.Normal * opening) - (Vector3D.Cross(a.Spin, c.Normal) * a.Radius);
            Vector3D frictionImpulse = c.FrictionImpulse - (slip * c.FrictionMass);
            double square = frictionImpulse.LengthSquared;
            double most = c.Follows == 1 ? c.Friction * impulse : Follow(ref c, square);
            frictionImpulse = square > most * most ? frictionImpulse * (most / Math.Sqrt(square)) : frictionImpulse;
            Vector3D across = frictionImpulse - c.FrictionImpulse;
            c.FrictionImpulse = frictionImpulse;
            c.HasFrictionImpulse = impulse > 0 || c.Follows < 1;
            push += across;
            change = Math.Max(change, across.Length * ImpactFriction.SlipPerImpulse * c.NormalInverse);
            a.Spin += Vector3D.Cross(across, c.Normal) * (ImpactFriction.TurnPerImpulse * a.InverseMass / a.Radius);
        }

        a.Velocity += push * a.InverseMass;
        return c.Lever > 0 ? Math.Max(change, Resist(ref c, ref a, ref a, isPair: false)) : change;
    }

    /// <summary>
    /// The bound of friction, which follows the normal impulse only in part where friction is large and what touches slips. Between a floor
    /// and a wall the push of the one is the friction of the other, so that sweeps multiply what is off by minus mu²; followed by 1 / (1 +
    /// mu²) of the way they multiply it by nothing.
    /// </summary>
    private static double Follow(ref SolverContact c, double square)
    {
        double most = c.Friction * c.Impulse;
        c.Bound = c.Bound == 0 || square <= most * most ? most : c.Bound + (c.Follows * (most - c.Bound));
        return c.Bound;
    }

    /// <summary>Rolling resistance: against rolling on each other, and as much against turning about the normal.</summary>
    private static double Resist(ref SolverContact c, ref SolverBody a, ref SolverBody b, bool isPair)
    {
        Vector3D turning = isPair ? a.Spin - b.Spin : a.Spin;
        Vector3D wanted = c.Turn - (turning * c.TurnMass);
        double most = c.Lever * c.Impulse;
        double pivot = Vector3D.Dot(wanted, c.Normal);
        Vector3D rolling = wanted - (c.Normal * pivot);
        double square = rolling.LengthSquared;
        rolling = square > most * most ? rolling * (most / Math.Sqrt(square)) : rolling;
        Vector3D turn = rolling + (c.Normal * Math.Min(most, Math.Max(-most, pivot)));
        Vector3D more = turn - c.Turn;
        c.Turn = turn;
        double speed = ImpactFriction.TurnPerImpulse * a.InverseMass / a.Radius;
        a.Spin += more * (speed / a.Radius);
        if (isPair)
        {
            double other = ImpactFriction.TurnPerImpulse * b.InverseMass / b.Radius;
            b.Spin -= more * (other / b.Radius);
            speed = Math.Max(speed, other);
        }

        return Math.Sqrt(more.LengthSquared) * speed;
    }

    private static void Apply(ContactProblem problem, in SolverContact c, in Vector3D push, in Vector3D across, in Vector3D turn)
    {
        ref SolverBody a = ref problem.Bodies[c.First];
        Vector3D turned = Vector3D.Cross(across, c.Normal) * ImpactFriction.TurnPerImpulse;
        a.Velocity += push * a.InverseMass;
        a.Spin += (turned * (a.InverseMass / a.Radius)) + (turn * (ImpactFriction.TurnPerImpulse * a.InverseMass / (a.Radius * a.Radius)));
        if (c.Second != ContactPoint.Static)
        {
            ref SolverBody b = ref problem.Bodies[c.Second];
            b.Velocity -= push * b.InverseMass;
            b.Spin += (turned * (b.InverseMass / b.Radius)) - (turn * (ImpactFriction.TurnPerImpulse * b.InverseMass / (b.Radius * b.Radius)));
        }
    }
}
