using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Contacts;

/// <content>How long a step is: so that no normal turns far, no force changes much, and nothing gets deep.</content>
internal sealed partial class IslandStep
{
    /// <summary>No step is shorter than 2^-20 s, whatever asks for it.</summary>
    private const long Shortest = 1L << 20;

    /// <summary>By how much, in radians, the line between two centres may turn in a step.</summary>
    private const double MostTurn = 1.0 / 128;

    /// <summary>So far, in lengths of what touches, an acceleration may carry within a step; and so far a force's own rate.</summary>
    private const double MostFall = 1.0 / 1024;

    private const double MostRateTimesStep = 1.0 / 16;

    /// <summary>
    /// The largest product of rate and step of the shortest steps: half a kick then takes no more than half a speed, so none turns round, and what the velocity
    /// at the end is off by is halved each time that it is asked for anew. The method itself is stable up to 2, as Verlet's is.
    /// </summary>
    private const double StableRateTimesStep = 1;

    /// <summary>
    /// So many of the scene's resolutions deep at most what lasts may get on the way, 100 nm by default: else the step is taken anew, half as long.
    /// </summary>
    private const double MostDepth = 100;

    /// <summary>A power of two of ticks, so short that in the step no normal turns far and no force changes much.</summary>
    private long Ticks()
    {
        double seconds = Longest.ToSeconds();
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly Touch t = ref touches[i];
            if (t.Second == ContactPoint.Static && t.Surface < scene.PlaneArray.Length)
            {
                continue; // its normal never turns
            }

            Vector3D other = t.Second == ContactPoint.Static ? Vector3D.Zero : members[t.Second].Velocity;
            double speed = (members[t.First].Velocity - other).Length;
            double pull = members[t.First].Acceleration.Length + (t.Second == ContactPoint.Static ? 0 : members[t.Second].Acceleration.Length);
            double reach = Reach(t);
            seconds = speed > 0 ? Math.Min(seconds, MostTurn * reach / speed) : seconds;
            seconds = pull > 0 ? Math.Min(seconds, Math.Sqrt(MostFall * reach / pull)) : seconds;
        }

        for (int b = 0; b < BodyCount; b++)
        {
            ref readonly Member m = ref members[b];
            double rate = Rate(m, m.Start, m.Velocity, m.StartSpin);
            seconds = rate > 0 ? Math.Min(seconds, MostRateTimesStep / rate) : seconds;
        }

        long ticks = Longest.Ticks;
        while (ticks > Shortest && ticks > seconds * SimDuration.TicksPerSecond)
        {
            ticks >>= 1;
        }

        return ticks;
    }

    /// <summary>At which rate, in 1/s, the forces on a body act.</summary>
    private double Rate(in Member m, in Vector3D place, in Vector3D velocity, in Vector3D spin) =>
        m.Spec.Forces.IsEmpty ? 0 : forces.FixedStepRateAt(m.Spec, place, velocity, spin);

    /// <summary>Whether at either end of the step forces act on a body at a rate that it does not follow, or without a number.</summary>
    private bool IsTooStiff(int body, out double rate)
    {
        ref readonly Member m = ref members[body];
        rate = 0;
        if (m.Spec.Forces.IsEmpty)
        {
            return false;
        }

        rate = Math.Max(Rate(m, m.Start, m.Velocity, m.StartSpin), Rate(m, m.End, m.EndVelocity, m.EndSpin));
        return !(rate * Length.ToSeconds() <= StableRateTimesStep); // what is not a number is too stiff
    }

    private bool IsTooStiff()
    {
        bool isTooStiff = false;
        for (int b = 0; b < BodyCount && !isTooStiff; b++)
        {
            isTooStiff = IsTooStiff(b, out _);
        }

        return isTooStiff;
    }

    /// <summary>
    /// How much deeper in each other than at the start two get between the two ends, at most, of those that last: nobody looks for an impact of theirs. Where a
    /// contact is closed at both ends, but opens at the later one, for what pressed it has ceased to, the cubic has it closed on the way: by 4/27 of that speed
    /// times the step, at 2/3 of it. From the start on none of them closes any more.
    /// </summary>
    private double Depth(double closing)
    {
        double most = 0;
        for (int i = 0; i < ContactCount; i++)
        {
            ref readonly Touch t = ref touches[i];
            Vector3D other = t.Second == ContactPoint.Static ? Vector3D.Zero : members[t.Second].Velocity;
            double opening = Vector3D.Dot(Normal(t, atEnd: false), members[t.First].Velocity - other);
            if (Math.Abs(opening) <= closing)
            {
                most = Math.Max(most, Math.Min(0, t.Gap) - Gap(t, 2.0 / 3));
            }
        }

        return most;
    }
}
