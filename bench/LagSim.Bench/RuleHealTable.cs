using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Rules;
using LagSim.Scenes;

namespace LagSim.Bench;

/// <summary>What a late event costs in a world with rules: how many of their calls are made again, and the time beside the same world without.</summary>
internal static class RuleHealTable
{
    private const double Fraction = 0.2;
    private const double Late = 0.1;
    private const double History = 0.5;

    internal static void Print(bool brief)
    {
        int bodies = brief ? 100 : 1_000;
        int times = brief ? 100 : 2_000;
        new GasWorld(1_000, Fraction, HealingMode.CausalCone, History, new Counting(1, 16)).Bring(brief ? 5 : 1_000, Late, 0.002); // compiled
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"One event {Late * 1000:0} ms late among {bodies:N0} bodies, periodic box at volume fraction {Fraction}; {ThreadClock.Name} of the thread"));
        Console.WriteLine("| rules | calls in the 100 ms | made again, mean | events re-run, mean | time p50 / p99, us | p50, with : without |");
        Console.WriteLine("|---|---|---|---|---|---|");
        double without = 0;
        foreach ((string name, Counting? rules) in new (string, Counting?)[]
        {
            ("none", null),
            ("hear every contact, keep nothing", new Counting(1) { KeepsNothing = true }),
            ("count the contacts of one body", new Counting(bodies)),
            ("count every contact", new Counting(1)),
            ("count every contact, and at each sixteenth change a velocity", new Counting(1, 16)),
        })
        {
            GasWorld world = new(bodies, Fraction, HealingMode.CausalCone, History, rules);
            double calls = (rules?.Calls ?? 0) * Late; // of the second that it has run
            long before = rules?.Calls ?? 0;
            IReadOnlyList<GasWorld.Heal> heals = world.Bring(times, Late, 0);
            Percentiles time = Percentiles.Of(heals.Select(h => h.Microseconds));
            without = rules is null ? time.P50 : without;

            // Each event is retracted again, which is a heal too.
            double again = ((rules?.Calls ?? 0) - before) / (2.0 * times);
            Console.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"| {name} | {calls:0} | {again:0.0} | {heals.Average(h => (double)h.Events):0.0} | {time.P50:0} / {time.P99:0} | {time.P50 / without:0.00} |"));
        }
    }

    /// <summary>Counts contacts, of every body or of the first.</summary>
    private sealed class Counting : GameRules
    {
        private readonly int of; // of how many bodies one is heard
        private readonly int acts; // at every so manieth contact

        internal Counting(int of, int acts = 0)
            : base("counting", version: 1)
        {
            this.of = of;
            this.acts = acts;
            WithWorldState<long>();
        }

        /// <summary>How often they were called: of the table, not of the world.</summary>
        internal long Calls { get; private set; }

        internal bool KeepsNothing { get; init; }

        /// <inheritdoc/>
        public override bool HearsContact(BodyId first, BodyId second, int surface) => first.Index % of == 0 || second.Index % of == 0;

        /// <inheritdoc/>
        public override void OnContact(RuleWorld world, in RuleContact contact)
        {
            Calls++;
            if (KeepsNothing)
            {
                return;
            }

            long count = ++world.State<long>();
            if (acts > 0 && count % acts == 0)
            {
                world.SetVelocity(contact.First, new Vector3D(0.5, 0, 0));
            }
        }
    }
}
