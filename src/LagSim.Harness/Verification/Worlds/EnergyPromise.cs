using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>
/// Energy does not grow from one act to the next by more than the wind gives, and by the act itself by no more than it gives.
/// </summary>
/// <remarks>
/// <para>The bound is a millionth, for integrators; and where bodies are in contact steps, of which velocities read are those of their
/// middles, the error of that: with the capture speed c = sqrt(2 a d) it is m (v c + 4 c²) of each body (docs/CONTACT.md, rule 1).</para>
/// <para>Not judged while a hand holds something, while bodies are in one another because players put them there, and where rules act.
/// After each of these, and after a body has left the world, it is compared with what there is then.</para>
/// </remarks>
internal sealed class EnergyPromise : WorldPromise
{
    private const double Relative = 1e-6;

    private readonly bool isJudged;
    private readonly Overlaps overlaps;
    private double? before; // of the last act, or since it is judged again
    private double beforeSlack, windPower;
    private SimTime since;
    private WorldMoment? last;

    internal EnergyPromise(WorldScene world)
    {
        isJudged = world.Scene.Rules is null && world.Scene.Forces.All(f => f.Kind != ForceKind.Supplied);
        overlaps = new Overlaps(world);
    }

    internal override string Name => "energy";

    internal override void Look(WorldMoment moment)
    {
        overlaps.Look(moment);
        bool isSameBodies = last is null || moment.Bodies.Count == last.Bodies.Count;
        if (!isJudged || moment.HasHands || overlaps.ArePutIn)
        {
            (before, last) = (null, moment);
            return;
        }

        double now = SceneEnergy.Of(moment.Simulation, moment.Time), slack = Slack(moment);
        bool isPlain = isSameBodies && moment.Acts.All(a => a.Kind is EventKind.SetVelocity or EventKind.Impulse);
        if (before is double energy && isPlain)
        {
            double given = (windPower * (moment.Time - since).ToSeconds()) + moment.Acts
                .Select(a => a.Body).Distinct().Sum(b => Gift(b, moment));
            double bound = energy + given + beforeSlack + slack;
            if (!(now <= bound))
            {
                Break(moment, string.Create(Invariant,
                    $"{now:G9} J, and at {(since - moment.Simulation.Start).ToSeconds():0.######} s it was {energy:G9} J; {given:G4} J were given"
                    + $" since, and {beforeSlack + slack:G3} J is what reading may be off by."));
            }
        }

        if (before is null || moment.Acts.Count > 0 || !isSameBodies)
        {
            (before, beforeSlack, since) = (now, slack, moment.Time);
            windPower = moment.Bodies.Sum(b => WindPower(moment.Scene, b.Spec));
        }

        last = moment;
    }

    /// <summary>The most kinetic energy that throws and pushes of this tick give a body.</summary>
    private double Gift(BodyId body, WorldMoment moment)
    {
        BodySpec spec = moment.Simulation.SpecOf(body);
        double old = last!.Bodies.FirstOrDefault(b => b.Id == body)?.Speed ?? 0, fastest = old;
        foreach (ExternalEvent act in moment.Acts.Where(a => a.Body == body && a.Kind == EventKind.SetVelocity))
        {
            fastest = Math.Max(fastest, act.Velocity.Length);
        }

        fastest += moment.Acts.Where(a => a.Body == body && a.Kind == EventKind.Impulse).Sum(a => a.Velocity.Length) / spec.Mass;
        return !(spec.Mass > 0) ? 0 : 0.5 * spec.Mass * ((fastest * fastest) - (old * old));
    }

    private double Slack(WorldMoment moment)
    {
        double sum = 0;
        foreach (WorldBody body in moment.Bodies)
        {
            double kinetic = 0.5 * body.Spec.Mass * body.State.Velocity.LengthSquared;
            double pull = Math.Max(1, moment.Scene.Gravity.Length);
            foreach (Force force in Acting(moment.Scene, body.Spec))
            {
                pull += force.At(body.Spec.Mass, moment.Seconds, body.State.Position, body.State.Velocity, body.State.Spin).Length;
            }

            double capture = Math.Sqrt(2 * pull * moment.Scene.ContactTolerance);
            sum += Relative * (kinetic + (body.Spec.Mass * pull * (1 + body.State.Position.Length)));
            sum += overlaps.HasSteps ? body.Spec.Mass * ((body.Speed * capture) + (4 * capture * capture)) : 0;
        }

        return sum;
    }

    /// <summary>The greatest power that a moving medium gives a body: of F · v, c w² / 4 in linear drag, 4/27 k w³ in quadratic
    /// drag.</summary>
    private static double WindPower(Scene scene, BodySpec spec) => Acting(scene, spec).Sum(f => f.Kind switch
    {
        ForceKind.LinearDrag => f.Strength * f.Vector.LengthSquared / 4,
        ForceKind.QuadraticDrag => 4.0 / 27 * f.Strength * f.Vector.Length * f.Vector.LengthSquared,
        _ => 0,
    });

    private static IEnumerable<Force> Acting(Scene scene, BodySpec spec) => scene.Forces.Where((_, n) => spec.Forces.Contains(n));
}
