using System;

namespace LagSim.Harness.Verification.References;

/// <summary>The closed form of x'' = -kappa x - gamma x', whichever of its three cases it is.</summary>
/// <param name="gamma">The damping, per second.</param>
/// <param name="kappa">The stiffness over the mass, per second squared.</param>
internal sealed class DampedOscillator(double gamma, double kappa)
{
    /// <summary>Returns the position at a time after a given position and velocity.</summary>
    internal double Place(double x, double v, double seconds)
    {
        double half = gamma / 2, square = (half * half) - kappa;
        if (square == 0)
        {
            return Math.Exp(-half * seconds) * (x + ((v + (half * x)) * seconds));
        }

        if (square < 0)
        {
            double omega = Math.Sqrt(-square);
            return Math.Exp(-half * seconds) * ((x * Math.Cos(omega * seconds)) + ((v + (half * x)) / omega * Math.Sin(omega * seconds)));
        }

        double fast = half + Math.Sqrt(square), slow = kappa / fast; // their product is kappa
        return (((v + (fast * x)) * Math.Exp(-slow * seconds)) - ((v + (slow * x)) * Math.Exp(-fast * seconds))) / (fast - slow);
    }
}
