using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Contacts;

/// <content>The two halves of a step, and what is settled before them.</content>
internal sealed partial class IslandStep
{
    /// <summary>What closes, slips, or moves or turns on a surface slower than this, in m/s, is what rounding leaves of nothing.</summary>
    internal const double RoundingSpeed = 1e-10;

    /// <summary>So often at most the normals' turning is taken in anew; each time it is right to two orders more.</summary>
    private const int MostRefinements = 8;

    /// <summary>So often at most a force is asked anew for the velocity that it leaves: what is off gets half as large each time, or far less.</summary>
    private const int MostIterations = 64;

    /// <summary>What of a length in parts of what touches is rounding.</summary>
    private const double Rounding = 1e-13;

    /// <summary>
    /// So many turns the solver may take where it is asked who rests: a tower that leans is held by the rolling resistance of all its contacts together, which
    /// comes to light slowly, and what is left over moves it for ever.
    /// </summary>
    private const int RestTurns = 64;

    /// <summary>Stops what closes at the start by no more than so many m/s.</summary>
    private void Settle(double closing)
    {
        for (int b = 0; b < BodyCount; b++)
        {
            velocities[b] = members[b].StartVelocity;
            spins[b] = members[b].StartSpin;
        }

        bool closes = false;
        int count = 0;
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly Touch t = ref touches[i];
            ContactPoint point = new(t.First, t.Second, t.Surface, default) { Normal = Normal(t, atEnd: false) };
            double opening = ImpactSolver.Opening(point, velocities.AsSpan(0, BodyCount));
            if (opening >= -closing)
            {
                points[count] = point;
                rubs[count++] = new Rub { Friction = t.Friction };
                closes |= opening < -RoundingSpeed;
            }
        }

        if (!closes)
        {
            return;
        }

        Solve(count, LastingContactSolver.Start.Anew, isPatient: false);
        for (int b = 0; b < BodyCount; b++)
        {
            members[b].StartVelocity = velocities[b].WithoutNegativeZero();
            members[b].StartSpin = spins[b];
        }
    }

    /// <summary>The first half: impulses that keep the gaps open, and where they lead.</summary>
    private void Move(double h, bool fromRest)
    {
        for (int i = 0; i < ContactCount; i++)
        {
            ref Touch t = ref touches[i];
            t.Gap = Gap(t, atEnd: false);
            points[i] = new ContactPoint(t.First, t.Second, t.Surface, default) { Normal = Normal(t, atEnd: false) };
            rubs[i] = new Rub { Friction = t.Friction, Lever = t.Lever };
            t.Bend = 0;
        }

        for (int n = 0; n < MostRefinements; n++)
        {
            for (int b = 0; b < BodyCount; b++)
            {
                ref Member m = ref members[b];
                velocities[b] = m.Velocity + (m.Acceleration * (0.5 * h));
                spins[b] = m.StartSpin;
            }

            for (int i = 0; i < ContactCount; i++)
            {
                ref readonly Touch t = ref touches[i];
                points[i].Target = ((Math.Min(0, t.Gap) - t.Gap) / h) - t.Bend;
                points[i].Restored = points[i].Target;
            }

            Solve(ContactCount, n == 0 ? LastingContactSolver.Start.Anew : LastingContactSolver.Start.Again, isPatient: fromRest);
            for (int b = 0; b < BodyCount; b++)
            {
                ref Member m = ref members[b];
                m.Middle = velocities[b];
                m.MiddleSpin = spins[b];
                m.End = m.Start + (velocities[b] * h);
            }

            if (!AreBent(h))
            {
                break;
            }
        }

        for (int i = 0; i < ContactCount; i++)
        {
            touches[i].Push = points[i].Impulse;
        }
    }

    /// <summary>By how much the gaps open more than the normals at the start tell; whether that has changed by more than rounding.</summary>
    private bool AreBent(double h)
    {
        bool has = false;
        for (int i = 0; i < ContactCount; i++)
        {
            ref Touch t = ref touches[i];
            if (t.Second == ContactPoint.Static && t.Surface < scene.PlaneArray.Length)
            {
                continue;
            }

            double opened = ImpactSolver.Opening(points[i], velocities.AsSpan(0, BodyCount));
            double bend = ((Gap(t, atEnd: true) - t.Gap) / h) - opened;
            has |= Math.Abs(bend - t.Bend) * h > Rounding * Reach(t);
            t.Bend = bend;
        }

        return has;
    }

    /// <summary>
    /// The second half: impulses along the normals where the step has led, of contacts that have pushed or have no gap, so that they do not close.
    /// </summary>
    private void Kick(SimTime time, double h, bool fromRest)
    {
        for (int b = 0; b < BodyCount; b++)
        {
            ref Member m = ref members[b];
            Vector3D a = m.Spec.Forces.IsEmpty ? scene.Gravity : EndAcceleration(m, time, h);
            velocities[b] = m.Middle + (a * (0.5 * h));
            spins[b] = m.MiddleSpin;
        }

        int count = 0;
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly Touch t = ref touches[i];
            if (t.Push > 0 || Gap(t, atEnd: true) <= 0)
            {
                Vector3D normal = Normal(t, atEnd: true);
                points[count] = new ContactPoint(t.First, t.Second, t.Surface, default) { Normal = normal, Impulse = t.Push };
                rubs[count] = rubs[i];
                rubs[count].Push -= normal * Vector3D.Dot(normal, rubs[count].Push);
                closed[count++] = i;
            }
        }

        if (count > 0)
        {
            Solve(count, LastingContactSolver.Start.Near, isPatient: fromRest);
        }

        for (int k = 0; k < count; k++)
        {
            touches[closed[k]].Push += points[k].Impulse;
        }

        for (int b = 0; b < BodyCount; b++)
        {
            members[b].EndVelocity = velocities[b];
            members[b].EndSpin = spins[b];
        }

        StopTurning();
    }

    /// <summary>
    /// What forces do at the end of the step, at the velocity that they and the contacts leave there. The trapezoidal rule: under a magnetic force it makes and
    /// takes no speed, where the same at a velocity of one's own guess makes some with each step. Contacts are taken to do in this half what they did in the
    /// first: at the velocity that gravity alone would give, a force across the velocity would drive away what lies still.
    /// </summary>
    private Vector3D EndAcceleration(in Member m, SimTime time, double h)
    {
        Vector3D without = m.Middle + (m.Middle - m.Velocity) - (m.Acceleration * (0.5 * h));
        Vector3D velocity = without + (m.Acceleration * (0.5 * h));
        Vector3D a = forces.On(m.Id).At(m.Spec, time, h, m.End, velocity, m.MiddleSpin);
        double last = double.PositiveInfinity;
        for (int n = 0; n < MostIterations; n++)
        {
            Vector3D next = without + (a * (0.5 * h));
            double change = (next - velocity).Length;
            if (!(change < last) || change == 0)
            {
                break; // rounding, or a program's own force that jumps or is too stiff
            }

            (velocity, last) = (next, change);
            a = forces.On(m.Id).At(m.Spec, time, h, m.End, velocity, m.MiddleSpin);
        }

        return a;
    }

    /// <summary>
    /// What turns by no more than rounding, and by less than resistance takes in the step, turns no more, as on a plane by closed form: else what the solver
    /// leaves would be a part of what it was each time, down to the least of all numbers, and never nothing.
    /// </summary>
    private void StopTurning()
    {
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly Touch t = ref touches[i];
            double taken = t.Lever * t.Push;
            bool isPair = t.Second != ContactPoint.Static;
            if (taken > 0 && IsStopped(t.First, taken) && (!isPair || IsStopped(t.Second, taken)))
            {
                members[t.First].EndSpin = Vector3D.Zero;
                if (isPair)
                {
                    members[t.Second].EndSpin = Vector3D.Zero;
                }
            }
        }
    }

    private bool IsStopped(int body, double taken)
    {
        double spin = members[body].EndSpin.Length;
        return spin * radii[body] <= RoundingSpeed && spin * masses[body] * radii[body] * radii[body] <= ImpactFriction.TurnPerImpulse * taken;
    }

    private void Solve(int count, LastingContactSolver.Start start, bool isPatient) => solver.Solve(
        points.AsSpan(0, count), rubs.AsSpan(0, count), masses.AsSpan(0, BodyCount), radii.AsSpan(0, BodyCount), velocities.AsSpan(0, BodyCount),
        spins.AsSpan(0, BodyCount), start, isPatient ? RestTurns : LastingContactSolver.UsualTurns);
}
