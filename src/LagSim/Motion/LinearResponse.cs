using System;

namespace LagSim.Motion;

/// <summary>
/// The exact solution of x'' = -lambda x' - kappa x + f from a state after a time t: x(t) = x + S v + Q f, v(t) = E v + S f, with f the
/// acceleration of the body at rest where it starts.
/// </summary>
/// <remarks>
/// <para>S is the response to a kick, E = S' and Q is the integral of S; exponentials, sines and cosines of lambda and kappa all in one.
/// They are summed as power series over a part of t so short that every term is far smaller than the one before, and doubled from there by
/// S(2t) = S (E + 1 - kappa Q), E(2t) = E² - kappa S², Q(2t) = 2 Q + S² - kappa Q², which are stable at the limits that a damped motion
/// has. No platform function is used, there are no separate cases (under-damped, critical, over-damped, none), and decaying terms go to
/// zero however long t is.</para>
/// <para>Lambda is complex: its imaginary part turns velocities, as a magnetic field does. Error: E, S and Q of an undamped motion are good
/// to 4 + 8 (|lambda| + sqrt(kappa)) t units in the last place of their largest values, 1, 1 / sqrt(kappa) and 1 / kappa; of drag alone E
/// is good to 4 + 4 lambda t units and S to 8, however large lambda t is (tests).</para>
/// </remarks>
internal readonly struct LinearResponse
{
    private const double ShortEnough = 0.25;

    private static readonly Rotor One = new(1, 0);

    private LinearResponse(in Rotor s, in Rotor e, in Rotor q)
    {
        S = s;
        E = e;
        Q = q;
    }

    /// <summary>The position that a velocity of 1 leads to, in s.</summary>
    internal Rotor S { get; }

    /// <summary>The remainder of a velocity of 1.</summary>
    internal Rotor E { get; }

    /// <summary>The position that an acceleration of 1 leads to, in s².</summary>
    internal Rotor Q { get; }

    /// <summary>The response after a time.</summary>
    /// <param name="lambda">In 1/s; the real part at least zero.</param>
    /// <param name="kappa">In 1/s², at least zero.</param>
    /// <param name="seconds">At least zero.</param>
    internal static LinearResponse After(in Rotor lambda, double kappa, double seconds)
    {
        double size = (Math.Abs(lambda.Real) + Math.Abs(lambda.Imaginary) + Math.Sqrt(kappa)) * seconds;
        int doublings = 0;
        while (size > ShortEnough)
        {
            size *= 0.5;
            seconds *= 0.5;
            doublings++;
        }

        LinearResponse response = Series(lambda, kappa, seconds);
        for (int i = 0; i < doublings; i++)
        {
            response = response.Doubled(kappa);
        }

        return response;
    }

    /// <summary>
    /// The terms of Q by (n + 2)(n + 1) q[n + 2] = -lambda (n + 1) q[n + 1] - kappa q[n] from q[2] = 1/2 on; S and E are its derivatives.
    /// From the fifteenth on a term is below 0.25^13 / 15!, which is nothing.
    /// </summary>
    private static LinearResponse Series(in Rotor lambda, double kappa, double t)
    {
        Rotor minus = lambda * -t;
        double spring = kappa * t * t;
        Rotor before = default; // q[n] t^n
        Rotor term = new(0.5 * t * t, 0); // q[n + 1] t^(n + 1)
        Rotor q = term;
        Rotor s = term * 2;
        Rotor e = term * 2;
        for (int n = 1; n < 14; n++)
        {
            Rotor next = ((minus * term) * (1.0 / (n + 2))) - (before * (spring / ((n + 1) * (n + 2))));
            before = term;
            term = next;
            q += term;
            s += term * (n + 2);
            e += term * ((n + 2) * (n + 1));
        }

        return new LinearResponse(s * (1 / t), e * (1 / (t * t)), q);
    }

    private LinearResponse Doubled(double kappa)
    {
        Rotor square = S * S;
        Rotor place = One - (Q * kappa); // what is left of a position of 1
        return new LinearResponse(S * (E + place), (E * E) - (square * kappa), (Q * (One + place)) + square);
    }
}
