using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>The acceleration of a free body: uniform gravity, and the scene's forces that the body names. Time is counted from the scene's start.</summary>
internal readonly struct Forces
{
    private readonly Scene scene;
    private readonly SimTime start;

    internal Forces(Scene scene, SimTime start)
    {
        this.scene = scene;
        this.start = start;
    }

    /// <summary>The acceleration in m/s², so many seconds after an epoch. Forces are added in the scene's order.</summary>
    internal Vector3D At(in BodySpec spec, SimTime epoch, double seconds, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        Vector3D sum = scene.Gravity;
        foreach (Force force in spec.Forces.Among(scene.ForceArray))
        {
            sum += force.At(spec.Mass, epoch.SecondsSince(start) + seconds, position, velocity, spin);
        }

        return sum;
    }

    /// <summary>
    /// How fast, in 1/s, a deviation changes at a state, as far as it is known: no less than the largest of the forces' own rates, no more than their sum.
    /// </summary>
    internal double RateAt(in BodySpec spec, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        double sum = 0;
        foreach (Force force in spec.Forces.Among(scene.ForceArray))
        {
            sum += force.RateAt(spec.Mass, position, velocity, spin);
        }

        return sum;
    }

    /// <summary>The same, and how fast the forces change because the body moves: what steps without an estimate of their error have to follow.</summary>
    internal double FixedStepRateAt(in BodySpec spec, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        double sum = 0;
        foreach (Force force in spec.Forces.Among(scene.ForceArray))
        {
            sum += Math.Max(force.RateAt(spec.Mass, position, velocity, spin), force.PassingRateAt(position, velocity));
        }

        return sum;
    }

    /// <summary>Whether a force that the body names is a program's own, whose rate is not known.</summary>
    internal bool HasSupplied(in BodySpec spec)
    {
        foreach (Force force in spec.Forces.Among(scene.ForceArray))
        {
            if (force.Kind == ForceKind.Supplied)
            {
                return true;
            }
        }

        return false;
    }
}
