using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>
/// The acceleration of a free body: uniform gravity, and the scene's forces that the body names. Time is counted from the scene's start.
/// </summary>
internal readonly struct Forces
{
    private readonly Scene scene;
    private readonly SimTime start;
    private readonly BodyId body;

    internal Forces(Scene scene, SimTime start)
        : this(scene, start, default)
    {
    }

    private Forces(Scene scene, SimTime start, BodyId body)
    {
        this.scene = scene;
        this.start = start;
        this.body = body;
    }

    /// <summary>The same forces, of which an error names this body.</summary>
    internal Forces On(BodyId whom) => new(scene, start, whom);

    /// <summary>The acceleration in m/s², so many seconds after an epoch. Forces are added in the scene's order.</summary>
    internal Vector3D At(in BodySpec spec, SimTime epoch, double seconds, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        Vector3D sum = scene.Gravity;
        foreach (Force force in spec.Forces.Among(scene.ForceArray))
        {
            double at = epoch.SecondsSince(start) + seconds;
            sum += force.Kind == ForceKind.Supplied
                ? Supplied(force, at, epoch, seconds, position, velocity)
                : force.At(spec.Mass, at, position, velocity, spin);
        }

        return sum;
    }

    /// <summary>The acceleration by a program's own force; what it throws is reported as such.</summary>
    /// <exception cref="SimulationException">The program's code threw.</exception>
    private Vector3D Supplied(Force force, double at, SimTime epoch, double seconds, in Vector3D position, in Vector3D velocity)
    {
        try
        {
            return force.Acceleration!.At(at, position, velocity);
        }
        catch (Exception failure)
        {
            throw new SimulationException(
                $"At {(epoch + SimDuration.FromSeconds(seconds)).ToShortString()}, {Limits.Short(at)} s after the scene's start, force '{force.Name}', version"
                + $" {force.Acceleration!.Version}, which the program supplies, threw for {scene.Describe(body)}, at {Limits.Short(position)} m and"
                + $" {Limits.Short(velocity)} m/s: {failure.GetType().Name}: {failure.Message}",
                failure);
        }
    }

    /// <summary>
    /// How fast, in 1/s, a deviation changes at a state, as far as it is known: no less than the largest of the forces' own rates, no more
    /// than their sum.
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

    /// <summary>
    /// The same, and how fast the forces change because the body moves: what steps without an estimate of their error have to follow.
    /// </summary>
    internal double FixedStepRateAt(in BodySpec spec, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        double sum = 0;
        foreach (Force force in spec.Forces.Among(scene.ForceArray))
        {
            sum += Math.Max(force.RateAt(spec.Mass, position, velocity, spin), force.PassingRateAt(position, velocity));
        }

        return sum;
    }

    /// <summary>
    /// How fast, in 1/s, the forces change a deviation, as far as it shows where a body is and where it will be so many seconds later: for a
    /// program's own forces, whose rate is not known. A medium that gets thick on the way is seen before the body is in it.
    /// </summary>
    internal double EstimatedRate(in BodySpec spec, SimTime epoch, in Vector3D position, in Vector3D velocity, in Vector3D spin, double ahead)
    {
        Vector3D later = position + (velocity * ahead);
        Vector3D here = At(spec, epoch, 0, position, velocity, spin);
        Vector3D changed = velocity + (here * ShortProbe);
        Vector3D hereChanged = At(spec, epoch, 0, position, changed, spin);
        Vector3D there = At(spec, epoch, 0, later, velocity, spin);
        Vector3D thereChanged = At(spec, epoch, 0, later, changed, spin);
        double rate = Stiffness.Rate(position, later, velocity, changed, here, hereChanged, thereChanged);
        return Math.Max(rate, Stiffness.Rate(later, position, velocity, changed, there, thereChanged, hereChanged));
    }

    /// <summary>
    /// How long, in seconds, a force acts to make the small change of speed that shows its rate: 2^-20, in which the fastest that is
    /// followed changes a speed by all of it, and one of 1/s still ten thousand times what counts as rounding.
    /// </summary>
    private const double ShortProbe = 1.0 / (1 << 20);

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
