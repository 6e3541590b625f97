using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.SceneFiles.Runs;

/// <summary>
/// The energy of a world: kinetic, rotational (2/5 m r² of a solid sphere), in uniform gravity, in springs and in central pulls. Also
/// describes which of the scene's forces have no potential, so that they change the sum.
/// </summary>
public static class SceneEnergy
{
    /// <summary>
    /// Returns the energy in joules. In uniform gravity it is zero at the origin's height, in a spring at its anchor, 1/2 k |x - a|²; in a
    /// central pull of power p it is m s r^(p + 1) / (p + 1), for p = -1 m s ln(r / 1 m), so zero far away for gravity of a fixed body.
    /// Bodies that do not exist count nothing.
    /// </summary>
    public static double Of(Simulation simulation, SimTime time)
    {
        ArgumentNullException.ThrowIfNull(simulation);
        double energy = 0;
        for (int n = 0; n < simulation.BodyCount; n++)
        {
            BodyId body = simulation.BodyAt(n);
            if (simulation.TryRead(body, time, out BodyState state))
            {
                BodySpec spec = simulation.SpecOf(body);
                energy += spec.Mass * ((0.5 * state.Velocity.LengthSquared) - Vector3D.Dot(simulation.Scene.Gravity, state.Position));
                energy += 0.2 * spec.Mass * spec.Radius * spec.Radius * state.Spin.LengthSquared;
                energy += Acting(simulation.Scene, spec.Forces).Sum(force => Potential(force, spec.Mass, state.Position));
            }
        }

        return energy;
    }

    /// <summary>
    /// Returns the forces that add or remove energy not in <see cref="Of"/>, a clause for each that acts on a body; null if there is none.
    /// </summary>
    public static string? WithoutPotential(Scene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        ForceSet all = scene.Bodies.Aggregate(ForceSet.None, (set, body) => set | body.Spec.Forces);
        string[] clauses = [.. Acting(scene, all).Select(Clause).OfType<string>()];
        return clauses.Length == 0 ? null : string.Join("; ", clauses);
    }

    private static IEnumerable<Force> Acting(Scene scene, ForceSet forces) => scene.Forces.Where((_, n) => forces.Contains(n));

    private static double Potential(Force force, double mass, in Vector3D position)
    {
        double squared = (position - force.Vector).LengthSquared;
        return force.Kind switch
        {
            ForceKind.Spring => 0.5 * force.Strength * squared,
            ForceKind.Central when force.Power == -1 => mass * force.Strength * 0.5 * Math.Log(squared),
            ForceKind.Central => mass * force.Strength * Math.Pow(squared, 0.5 * (force.Power + 1)) / (force.Power + 1),
            _ => 0,
        };
    }

    private static string? Clause(Force force) => force.Kind switch
    {
        ForceKind.LinearDrag or ForceKind.QuadraticDrag when force.Strength != 0 && force.Vector != Vector3D.Zero => $"drag '{force.Name}' takes energy, and its wind gives some",
        ForceKind.LinearDrag or ForceKind.QuadraticDrag when force.Strength != 0 => $"drag '{force.Name}' takes energy",
        ForceKind.Spring when force.Damping != 0 => $"the damper of spring '{force.Name}' takes energy",
        ForceKind.Magnetic => $"magnetic field '{force.Name}' does no work",
        ForceKind.Magnus => $"Magnus force '{force.Name}' does no work",
        ForceKind.Supplied => $"what '{force.Name}', a program's own force, does is not in the sum",
        _ => null,
    };
}
