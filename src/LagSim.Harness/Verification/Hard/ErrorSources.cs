using System;
using System.Collections.Generic;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// The propagation of errors of a body that flies along a line and bounces off a floor, to first order. Each source is propagated by
/// itself, and sizes are added only at the end.
/// </summary>
/// <remarks>
/// For v' = f(v), a flight multiplies an error of the speed by f(v1)/f(v0) and moves the position by (v1 - v0)/f(v0) of it. A contact
/// propagates it by its saltation matrix (Leine and Nijmeijer 2004): a body that is dx too high is late by dt = -dx/v, and its speed and
/// position right after, at the same time, are off by -e dv - (e a + a') dt and -e dx.
/// </remarks>
internal sealed class ErrorSources
{
    private readonly List<(double Place, double Speed)> sources = [];

    /// <summary>Adds a source, of either sign.</summary>
    internal void Add(double place, double speed) => sources.Add((place, speed));

    /// <summary>Propagates through a flight from one speed and acceleration to others.</summary>
    internal void Fly(double from, double accelerationFrom, double to, double accelerationTo)
    {
        for (int n = 0; n < sources.Count; n++)
        {
            (double place, double speed) = sources[n];
            sources[n] = (place + (speed * (to - from) / accelerationFrom), speed * accelerationTo / accelerationFrom);
        }
    }

    /// <summary>
    /// Propagates through a contact with the floor, with the velocity and acceleration before it and the acceleration after it.
    /// </summary>
    internal void Bounce(double e, double velocity, double acceleration, double accelerationAfter)
    {
        for (int n = 0; n < sources.Count; n++)
        {
            (double place, double speed) = sources[n];
            double late = -place / velocity;
            sources[n] = (-e * place, (-e * speed) - (((e * acceleration) + accelerationAfter) * late));
        }
    }

    /// <summary>Returns the largest error in time of a contact at a speed.</summary>
    internal double Delay(double speed)
    {
        double sum = 0;
        foreach ((double place, _) in sources)
        {
            sum += Math.Abs(place);
        }

        return sum / Math.Abs(speed);
    }
}
