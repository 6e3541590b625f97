using System;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Budgets;

/// <summary>
/// A host that gets little time, in virtual time: its thread waits for its core again and again in the middle of its work. Honest players stay.
/// </summary>
public sealed class StarvedLedgerTests(ITestOutputHelper output)
{
    private const double Seconds = 3, Rate = 15;
    private const int Clients = 3;

    /// <summary>
    /// Honest players push the balls of a heap, twice with the same host that is starved alike. The control is the rule of before for a world that
    /// is late, a ledger that charges what the clock says, up to 20 ms for an event, against half the budget: what they do is refused, from where on
    /// that rule sent them away.
    /// </summary>
    [Theory]
    [InlineData(0.1, 1)]
    [InlineData(0.06, 1)]
    public void Play_WithAStarvedHost_RefusesNobodyUnlessTheClockCharges(double share, int seed)
    {
        (long refused, double late, double most) = Play(seed, share, null);
        (long refusedByClock, _, double mostByClock) = Play(seed, share, static (counted, took) => 2 * Math.Max(counted, Math.Min(took, 20_000)));
        output.WriteLine(FormattableString.Invariant($"late {late:0.000} s, {most:0.000} of the budget, {refused} refused; by the clock {mostByClock:0.00}, {refusedByClock} refused"));
        Assert.True(late > 0, $"{late} s"); // it was starved
        Assert.Equal(0, refused);
        Assert.InRange(most, 0.0001, 0.1);
        Assert.True(refusedByClock > 0 && mostByClock > 0.5, $"{mostByClock}");
    }

    private static (long Refused, double Late, double Most) Play(int seed, double share, Func<double, double, double>? rule)
    {
        SceneBuilder scene = new SceneBuilder("heap").AddPlane("floor", Vector3D.Up, V(0), 0.3, friction: 0.3)
            .AddPlane("west", V(1), V(-0.26), 0.3).AddPlane("east", V(-1), V(1.27), 0.3)
            .AddPlane("north", V(0, 0, 1), V(0, 0, -0.26), 0.3).AddPlane("south", V(0, 0, -1), V(0, 0, 0.77), 0.3);
        int bodies = 6 + (2 * (seed % 2));
        for (int n = 0; n < bodies; n++)
        {
            scene.AddBody($"ball {n}", new BodySpec(0.25, 1, 0.3, friction: 0.3), V(0.501 * (n % 3), 0.251 + (0.501 * (n / 6)), 0.501 * (n / 3 % 2)));
        }

        SessionGroup group = new SessionGroup(scene.Build(), Clients + 1, LinkProfiles.PureDelay(50), (ulong)seed).Connect();
        group.Host.World!.Work = new WorkLedger(new StarvedClock(group.Clock, share, new Random(seed))) { ChargeRule = rule };
        group.BusyMilliseconds = 20;
        Random random = new(seed);
        double[] next = [.. Enumerable.Range(0, Clients).Select(_ => random.NextDouble() / Rate)];
        for (double at = 0; at < Seconds; at += 0.01)
        {
            for (int who = 0; who < Clients; who++)
            {
                if (at >= next[who])
                {
                    next[who] += (0.5 + random.NextDouble()) / Rate;
                    group.Do(who + 1, PlayerAction.Impulse(BodyId.OfScene(random.Next(bodies)), V(random.NextDouble() - 0.5, 2 * random.NextDouble(), random.NextDouble() - 0.5)));
                }
            }

            group.Run(0.01);
        }

        return (group.Host.Counters.EventsRefused, group.Host.World.MaxLateness.ToSeconds(), group.Host.Costs.Max(cost => cost.PeakWork) / PlayerBudget.Default.WorkAtOnce);
    }

    /// <summary>
    /// The clock of a thread that runs for up to 3 ms, and then waits until it has had its share: each reading, which is one for each event,
    /// comes 20 us of its own time after the last.
    /// </summary>
    private sealed class StarvedClock(IClock real, double share, Random random) : IClock
    {
        private const double Each = 20e-6;
        private double ran, slice, lost;

        public SimTime Now
        {
            get
            {
                ran += Each;
                lost += Each;
                if (ran > slice)
                {
                    lost += slice * ((1 / share) - 1);
                    (ran, slice) = (0, 0.001 + (0.002 * random.NextDouble()));
                }

                return real.Now + SimDuration.FromSeconds(lost);
            }
        }
    }
}
