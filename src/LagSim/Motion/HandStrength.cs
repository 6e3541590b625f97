using System;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>How hard a hand pushes what it meets: its greatest force and power, and what follows from them in a step and in a blow.</summary>
/// <remarks>
/// <para>A hand that says nothing of it is as strong as it has to be to make itself, which is some 1 kg, and what it holds as fast as a fast hand
/// within <see cref="HandPath.Settles"/>. So by default its force is 1000 N, and 1000 N more for each kg that it holds, and its power is its
/// force times 50 m/s.</para>
/// <para>In a contact step of h it gives at most h times its force, in all its contacts together; where it moves so fast that this would be
/// more than its power, at most h times its power divided by its speed. In impacts it gives as much in any time t as in t and a blow, which is
/// <see cref="HandPath.Settles"/> long, and what it cannot give it goes through.</para>
/// <para>Pure functions, safe on any thread.</para>
/// </remarks>
public static class HandStrength
{
    /// <summary>
    /// The speed of a fast hand, in m/s: 50. A pitched baseball, the head of a tennis racket and that of a hockey stick are within a fifth of it.
    /// </summary>
    public const double FastSpeed = 50;

    /// <summary>The acceleration with which a hand at rest is that fast within <see cref="HandPath.Settles"/>, in m/s².</summary>
    private const double Acceleration = FastSpeed / 0.05;

    /// <summary>The mass of a hand itself, in kg.</summary>
    private const double OwnMass = 1;

    /// <summary>The greatest force in N of a hand that says none and holds a body of this mass in kg: 1000 N, and 1000 N/kg.</summary>
    public static double DefaultForce(double mass) => (OwnMass + mass) * Acceleration;

    /// <summary>The greatest power in W of a hand with this greatest force in N that says none: what the force gives at the speed of a fast hand.</summary>
    public static double DefaultPower(double force) => force * FastSpeed;

    /// <summary>With how much force a hand pushes at most while it moves at this speed, in N.</summary>
    internal static double ForceAt(in Hold hold, double mass, double speed)
    {
        double force = hold.MaxForce > 0 ? hold.MaxForce : DefaultForce(mass);
        double power = hold.MaxPower > 0 ? hold.MaxPower : DefaultPower(force);
        return force * speed <= power ? force : power / speed;
    }

    /// <summary>For how long a hand may still push with all its force in a blow that it strikes now, in seconds.</summary>
    internal static double BlowLeft(in Hold hold, SimTime now)
    {
        SimTime busy = hold.BusyAt(now);
        return busy == default ? HandPath.Settles.ToSeconds() : Math.Max(0, (now + HandPath.Settles).SecondsSince(busy));
    }

    /// <summary>Until when a hand is busy once it has given one more impulse, in N s, with a force that it has then, in N.</summary>
    internal static SimTime BusyAfter(in Hold hold, SimTime now, double given, double force)
    {
        SimTime busy = hold.BusyAt(now);
        if (!(given > 0))
        {
            return busy;
        }

        double seconds = Math.Min(given / force, HandPath.Settles.ToSeconds()); // never more, but for rounding
        SimTime until = SimTime.Min((busy == default ? now : busy) + SimDuration.FromSeconds(seconds), now + HandPath.Settles);
        return until > now ? until : default; // an impulse of less than a tick is none
    }

    /// <summary>How much more than its normal impulse the whole impulse of a contact with this coefficient of friction is at most.</summary>
    internal static double WithFriction(double friction) => Math.Sqrt(1 + (friction * friction));
}
