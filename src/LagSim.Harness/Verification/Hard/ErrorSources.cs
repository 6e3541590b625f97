using System;
using System.Collections.Generic;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// How errors of a body that flies along a line and bounces off a floor are passed on, to first order, each source by itself; their sizes
/// are added only at the end.
/// </summary>
/// <remarks>
/// Of v' = f(v) a flight multiplies an error of the speed by f(v1)/f(v0) and moves the place by (v1 - v0)/f(v0) of it. A contact passes it
/// on by its saltation matrix (Leine and Nijmeijer 2004): who is dx too high is late by dt = -dx/v, and speed and place right after, at the
/// same time, are off by -e dv - (e a + a') dt and -e dx.
/// </remarks>
internal sealed class ErrorSources
{
    private readonly List<(double Place, double Speed)> sources = [];

    /// <summary>One more source, of either sign.</summary>
    internal void Add(double place, double speed) => sources.Add((place, speed));

    /// <summary>A flight from one speed and acceleration to others.</summary>
    internal void Fly(double from, double accelerationFrom, double to, double accelerationTo)
    {
        for (int n = 0; n < sources.Count; n++)
        {
            (double place, double speed) = sources[n];
            sources[n] = (place + (speed * (to - from) / accelerationFrom), speed * accelerationTo / accelerationFrom);
        }
    }

    /// <summary>A contact with the floor, with the velocity and acceleration before it and the acceleration after it.</summary>
    internal void Bounce(double e, double velocity, double acceleration, double accelerationAfter)
    {
        for (int n = 0; n < sources.Count; n++)
        {
            (double place, double speed) = sources[n];
            double late = -place / velocity;
            sources[n] = (-e * place, (-e * speed) - (((e * acceleration) + accelerationAfter) * late));
        }
    }

    /// <summary>By how much a contact at that speed is off in time, at most.</summary>
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
