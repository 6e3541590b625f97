using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.SceneFiles;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>
/// A gas in a periodic box, run until it has forgotten its lattice. It gets late events and retracts them, so it stays the gas it was.
/// </summary>
internal sealed class GasWorld
{
    private static readonly SimDuration Half = SimDuration.FromSeconds(0.5); // a second to settle, of which the second half is counted

    private readonly Random random = new(1);
    private readonly int bodies;
    private HealReport report;
    private uint sequence;

    /// <summary>So many balls at a volume fraction, and the seconds kept of their past.</summary>
    internal GasWorld(int bodies, double fraction, HealingMode mode, double history, GameRules? rules = null)
    {
        this.bodies = bodies;
        Scene scene = BuiltInScenes.Gas(bodies, fraction);
        Simulation = new Simulation(rules is null ? scene : scene.With(rules, 1), new SimulationOptions(default, SimDuration.FromSeconds(history), healing: mode));
        Simulation.Healed += healed => report = healed;
        Simulation.AdvanceTo(Simulation.Start + Half);
        long before = Simulation.ImpactsProcessed;
        Simulation.AdvanceTo(Simulation.Start + (Half * 2));
        ContactsPerSecond = (Simulation.ImpactsProcessed - before) * 2 / (bodies * Half.ToSeconds()); // each has two bodies
    }

    internal Simulation Simulation { get; }

    /// <summary>Contacts a second of each body.</summary>
    internal double ContactsPerSecond { get; }

    /// <summary>Brings in so many events one by one, each so late, on bodies drawn at random, some simulated time apart.</summary>
    /// <exception cref="InvalidOperationException">A heal did not leave what it should.</exception>
    internal IReadOnlyList<Heal> Bring(int count, double late, double apart)
    {
        List<Heal> heals = new();
        for (int i = 0; i < count; i++)
        {
            Simulation.AdvanceTo(Simulation.SimulatedTo + SimDuration.FromSeconds(apart));
            SimTime now = Simulation.SimulatedTo;
            ulong events = Simulation.Engine.Timelines.EventHash;
            BodyId body = BodyId.OfScene(random.Next(bodies));
            ExternalEvent external = ExternalEvent.Impulse(Simulation.SimulatedTo - SimDuration.FromSeconds(late), 1, ++sequence, body, new Vector3D(0.1, 0.05, 0));
            long impacts = Simulation.ImpactsProcessed;
            double began = ThreadClock.Microseconds;
            Simulation.Submit(external);
            Simulation.AdvanceTo(now);
            double took = ThreadClock.Microseconds - began;
            heals.Add(new Heal(report.Events, Simulation.ImpactsProcessed - impacts, report.Bodies, took));
            bool changed = Simulation.Engine.Timelines.EventHash != events;
            Simulation.Retract(external);
            Simulation.AdvanceTo(now);
            if (!changed || Simulation.Engine.Timelines.EventHash != events)
            {
                throw new InvalidOperationException(
                    $"A late event of {external.Time} {(changed ? "was retracted and left something behind" : "changed nothing")}.");
            }
        }

        return heals;
    }

    /// <summary>
    /// Submits so many events at once, up to so late and at least nine tenths of that, in any order of their stamps; then retracts them.
    /// </summary>
    /// <exception cref="InvalidOperationException">The heal did not leave what it should.</exception>
    internal Heal BringTogether(int count, double late)
    {
        SimTime now = Simulation.SimulatedTo + SimDuration.FromSeconds(0.125);
        Simulation.AdvanceTo(now);
        ulong events = Simulation.Engine.Timelines.EventHash;
        ExternalEvent[] lateEvents = new ExternalEvent[count];
        for (int i = 0; i < count; i++)
        {
            SimTime stamp = now - SimDuration.FromSeconds(late * (0.9 + (0.1 * random.NextDouble())));
            lateEvents[i] = ExternalEvent.Impulse(stamp, 1, ++sequence, BodyId.OfScene(random.Next(bodies)), new Vector3D(0.1, 0.05, 0));
        }

        long impacts = Simulation.ImpactsProcessed;
        double began = ThreadClock.Microseconds;
        Together(external => Simulation.Submit(external));
        double took = ThreadClock.Microseconds - began;
        Heal heal = new(report.Events, Simulation.ImpactsProcessed - impacts, report.Bodies, took);
        bool changed = Simulation.Engine.Timelines.EventHash != events;
        Together(external => Simulation.Retract(external));
        return changed && Simulation.Engine.Timelines.EventHash == events
            ? heal
            : throw new InvalidOperationException(
                $"{count} late events {(changed ? "were retracted and left something behind" : "changed nothing")}.");

        void Together(Action<ExternalEvent> bring)
        {
            Array.ForEach(lateEvents, bring);
            Simulation.AdvanceTo(now);
        }
    }

    /// <summary>What one late event cost.</summary>
    /// <param name="Events">Events run again, and the late one.</param>
    /// <param name="Impacts">The impacts among them.</param>
    /// <param name="Bodies">How many bodies were predicted anew.</param>
    /// <param name="Microseconds">How long it took.</param>
    internal readonly record struct Heal(long Events, long Impacts, int Bodies, double Microseconds)
    {
        internal static Heal Sum(IReadOnlyList<Heal> heals) => new(heals.Sum(h => h.Events), heals.Sum(h => h.Impacts), heals.Sum(h => h.Bodies), heals.Sum(h => h.Microseconds));

        internal static double MeanEvents(IReadOnlyList<Heal> heals) => heals.Average(h => (double)h.Events);
    }
}
