using System;
using System.Linq;
using System.Threading.Tasks;
using LagSim.Harness.Verification.Fuzz;
using LagSim.Play;
using Xunit;

namespace LagSim.Tests.Play;

/// <summary>What four worlds side by side keep while balls are thrown for twelve minutes of their time. The page itself is looked at by the
/// test of the same name in <c>tests/LagSim.Browser</c>.</summary>
[Collection("alone")]
public sealed class KeptMemoryTests
{
    private const int Minutes = 12;
    private const double Furthest = 1.5; // metres that a hand goes each way
    private const int FramesPerMinute = 3600, FramesPerThrow = 36, FramesInHand = 15;

    /// <summary>How much more than in its first third may be kept in its last, by four runs together. What is kept has the room of the liveliest
    /// moment of each pool, so single runs vary: 0.95 to 1.17 times as much with six seeds, and 1.05 all together, now as before the last changes of
    /// contact.</summary>
    private const double Slack = 1.1;

    /// <summary>A leak that is seen: some lines of a report kept for each heal.</summary>
    private const int LeakedBytesPerHeal = 200;

    [Fact]
    public void Room_OfTwelveMinutes_DoesNotGrow()
    {
        double[] kept = new double[Minutes], leaking = new double[Minutes];
        double before = LiveMemory.Read(); // of other tests
        (Playground Playground, Random Random)[] runs =
            [.. new[] { 5, 6, 7, 8 }.Select(seed => (new Playground(PlaySetup.Parse("scene=room&panes=healing,healing,healing,healing&delay=100")), new Random(seed)))];
        for (int minute = 0; minute < Minutes; minute++)
        {
            // No other test runs beside this one, so it takes the cores. What is kept is looked at while all stand still.
            Parallel.ForEach(runs, run => Play(run.Playground, run.Random));
            kept[minute] = LiveMemory.Read() - before;
            leaking[minute] = kept[minute] + (LeakedBytesPerHeal * runs.Sum(run => run.Playground.Panes.Sum(pane => pane.Heals)));
        }

        Assert.All(runs, run => Assert.True(run.Playground.Panes.Sum(pane => pane.Heals) > 20_000));
        Assert.True(Growth(kept) < Slack, $"It grew to the {Growth(kept):F2}-fold: {string.Join(", ", kept.Select(bytes => $"{bytes / 1e6:F1}"))} MB.");
        Assert.True(Growth(leaking) > Slack, $"What a leak would be is not seen: {Growth(leaking):F2}.");
    }

    /// <summary>The median of the last third over that of the first.</summary>
    private static double Growth(double[] kept) => Median(kept[^(kept.Length / 3)..]) / Median(kept[..(kept.Length / 3)]);

    private static double Median(double[] values) => values.Order().ElementAt(values.Length / 2);

    /// <summary>A minute: in turn each pane takes a ball and throws it.</summary>
    private static void Play(Playground playground, Random random)
    {
        (int pane, double x, double y, double dx, double dy) = (0, 0, 0, 0, 0);
        for (int frame = 0; frame < FramesPerMinute; frame++)
        {
            int n = frame / FramesPerThrow, k = frame % FramesPerThrow;
            if (k == 0)
            {
                pane = n % playground.Panes.Count;
                (x, y) = playground.Panes[pane].Places[n * 5 % playground.Panes[pane].Places.Length].Drawn;
                (dx, dy) = (Furthest * ((2 * random.NextDouble()) - 1), Furthest * ((2 * random.NextDouble()) - 1));
                playground.Grab(pane, x, y, 0.3); // if it can be taken
            }
            else if (k <= FramesInHand)
            {
                double part = k / (double)FramesInHand;
                playground.MoveHand(pane, x + (dx * part), y + (dy * part), dx * 60 / FramesInHand, dy * 60 / FramesInHand);
            }
            else if (k == FramesInHand + 1)
            {
                playground.Release(pane, dx * 60 / FramesInHand, dy * 60 / FramesInHand);
            }

            playground.Advance(1 / 60.0, 1 / 60.0);
        }
    }
}
