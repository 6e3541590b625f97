using System;
using LagSim.Tests.Determinism;
using Xunit;

namespace LagSim.Tests.Healing;

public sealed class ScratchTests
{
    [Fact]
    public void Many()
    {
        int from = int.Parse(Environment.GetEnvironmentVariable("FROM") ?? "0");
        int count = int.Parse(Environment.GetEnvironmentVariable("COUNT") ?? "300");
        int failures = 0;
        for (int seed = from; seed < from + count; seed++)
        {
            RandomWorld world = new(seed);
            Simulation onTime = world.OnTime();
            try
            {
                Simulation late = world.Shuffled(seed * 7, inPieces: Environment.GetEnvironmentVariable("PIECES") == "1");
                string? d = RandomWorld.Difference(onTime, late);
                if (d != null)
                {
                    failures++;
                    TestContext.Current.SendDiagnosticMessage($"seed {seed}: {d}");
                    Console.WriteLine($"seed {seed}: {d} {First(onTime, late)}");
                }
            }
            catch (Exception e) when (e is not OperationCanceledException)
            {
                failures++;
                Console.WriteLine($"seed {seed}: {e.GetType().Name} {e.Message} {e.StackTrace?.Split('\n')[0]}");
            }
        }

        Assert.Equal(0, failures);
    }

    private static string First(Simulation a, Simulation b)
    {
        string best = "";
        LagSim.Events.EventKey? least = null;
        for (int n = 0; n < a.BodyCount; n++)
        {
            var x = a.Timeline(a.BodyAt(n));
            var y = b.Timeline(a.BodyAt(n));
            for (int i = 0; i < Math.Max(x.Count, y.Count); i++)
            {
                bool same = i < x.Count && i < y.Count && x[i].Key == y[i].Key && x[i].State.Position == y[i].State.Position && x[i].State.Velocity == y[i].State.Velocity;
                if (!same)
                {
                    LagSim.Events.EventKey k = i >= x.Count ? y[i].Key : i >= y.Count ? x[i].Key : x[i].Key < y[i].Key ? x[i].Key : y[i].Key;
                    if (least is null || k < least)
                    {
                        least = k;
                        best = $"body {a.BodyAt(n)} expected {(i < x.Count ? x[i].Key + " " + x[i].State.Velocity : "none")} got {(i < y.Count ? y[i].Key + " " + y[i].State.Velocity : "none")}";
                    }

                    break;
                }
            }
        }

        return best;
    }
}
