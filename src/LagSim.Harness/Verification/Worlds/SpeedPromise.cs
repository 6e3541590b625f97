using System;
using System.Linq;
using LagSim.Events;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>No body is faster than all energy that can have been given would make it, times ten for hands and rules that give again and
/// again.</summary>
/// <remarks>
/// The one bound that holds where energy itself is not judged: under hands, rules and winds. If everything, of mass M, moved at the
/// greatest
/// speed v that anything was given, one body of mass m could have v sqrt(M / m).
/// </remarks>
internal sealed class SpeedPromise : WorldPromise
{
    private const double Again = 10;

    private readonly WorldScene world;
    private double given, mass;

    internal SpeedPromise(WorldScene world)
    {
        this.world = world;
        given = world.Scene.Bodies.Select(b => b.Velocity.Length + (b.Spin.Length * b.Spec.Radius)).Append(1).Max();
        mass = world.Scene.Bodies.Sum(b => b.Spec.Mass);
    }

    internal override string Name => "speed";

    internal override void Look(WorldMoment moment)
    {
        foreach (ExternalEvent act in moment.Acts)
        {
            double ofBody = moment.Simulation.SpecOf(act.Body).Mass;
            double speed = act.Kind switch
            {
                EventKind.Impulse => ofBody > 0 ? given + (act.Velocity.Length / ofBody) : 0,
                EventKind.HoldKeyframe => act.Velocity.Length + (1 / 0.05), // a hand moves what it holds to its place within 50 ms
                _ => act.Velocity.Length,
            };
            given = Math.Max(given, speed);
            mass += act.Kind == EventKind.Spawn ? act.Spec.Mass : 0;
        }

        double most = given + world.FieldSpeed + (moment.Scene.Gravity.Length * world.Seconds);
        double all = Math.Max(mass, moment.Bodies.Sum(b => b.Spec.Mass)); // rules spawn too
        foreach (WorldBody body in moment.Bodies)
        {
            double bound = Again * most * Math.Sqrt(all / body.Spec.Mass);
            if (!(body.Speed <= bound))
            {
                Break(moment, string.Create(Invariant,
                    $"{body.Id} moves at {body.Speed:G6} m/s; what was given makes {bound:G4} m/s at most."));
            }
        }
    }
}
