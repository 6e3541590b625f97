using System;
using System.Threading;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Hosting;

/// <summary>Whole render snapshots from one thread to another without a lock.</summary>
public sealed class RenderTripleBufferTests
{
    private const int Publications = 20_000;

    [Fact]
    public void Latest_WhileAnotherThreadPublishes_IsAlwaysOneWholeSnapshotAndNeverAnOlderOne()
    {
        (long seen, string? fault) = Stress(exchange => exchange.Latest());
        Assert.Null(fault);
        Assert.True(seen > 1);
    }

    [Fact]
    public void Stress_OfAWorldThatDoesNotKeepItsPromise_IsSeenToFail()
    {
        // The control: bodies that do not move together stand for a torn render snapshot.
        Simulation simulation = Pair();
        simulation.Submit(ExternalEvent.SetVelocity(At(1), 1, 1, First, V(3)));
        simulation.AdvanceTo(At(2));
        RenderTripleBuffer exchange = new();
        exchange.Publish(simulation, At(0));
        Assert.NotNull(Inconsistency(exchange.Latest(), At(1.5)));
        Assert.Null(Inconsistency(exchange.Latest(), At(0.5)));
    }

    [Fact]
    public void Latest_NothingNew_IsTheSameSnapshot()
    {
        RenderTripleBuffer exchange = new();
        Assert.Equal(0, exchange.Latest().Number);
        Simulation simulation = Pair();
        exchange.Publish(simulation, At(0));
        exchange.Publish(simulation, At(0));
        RenderSnapshot snapshot = exchange.Latest();
        Assert.Equal(2, snapshot.Number);
        Assert.Same(snapshot, exchange.Latest());
        exchange.Publish(simulation, At(0));
        Assert.Equal(2, snapshot.Number); // what the reader holds does not change
        Assert.Equal(3, exchange.Latest().Number);
    }

    [Fact]
    public void Publish_BackToBeforeWhatWasShownLast_ShowsItAgain()
    {
        Simulation simulation = Pair();
        simulation.Submit(ExternalEvent.SetVelocity(At(1.8), 1, 1, First, V(3)));
        simulation.AdvanceTo(At(2));
        RenderTripleBuffer exchange = new();
        foreach (double from in new[] { 1.9, 1.9, 1.6, 1.6 })
        {
            exchange.Publish(simulation, At(from)); // while nobody reads, two of the three buffers take turns
        }

        RenderSnapshot snapshot = exchange.Latest();
        foreach (double time in new[] { 1.6, 1.7, 1.95 })
        {
            Assert.True(simulation.TryRead(First, At(time), out BodyState expected));
            Assert.True(snapshot.TryRead(First, At(time), out BodyState actual), $"{time}");
            Assert.True(expected.IsSameBits(actual));
        }
    }

    [Fact]
    public void Publish_BodiesOnlyHeardOf_CostLittleMemory()
    {
        // Anybody can name bodies that nobody spawned. While nobody reads, two of the three buffers take turns.
        const int bodies = 4096, buffers = 2;
        Simulation simulation = Pair();
        for (uint i = 1; i <= bodies; i++)
        {
            simulation.Submit(ExternalEvent.SetVelocity(At(0.1), 1, i, new BodyId(1, i, 0), V(1)));
        }

        RenderTripleBuffer exchange = new();
        long before = GC.GetAllocatedBytesForCurrentThread();
        for (int i = 0; i < buffers; i++)
        {
            exchange.Publish(simulation, At(0));
        }

        long each = (GC.GetAllocatedBytesForCurrentThread() - before) / (bodies * buffers);
        Assert.True(each <= 64, $"{each} bytes a body and buffer");
        Assert.Equal(bodies + 2, exchange.Latest().BodyCount);
    }

    [Fact]
    public void Latest_BodySpawnedLongAfterItWasHeardOf_ShowsItFromThenOn()
    {
        Simulation simulation = Pair();
        BodyId late = new(1, 2, 0);
        simulation.Submit(ExternalEvent.SetVelocity(At(0.1), 1, 1, late, V(1)));
        simulation.AdvanceTo(At(1));
        RenderTripleBuffer exchange = new();
        exchange.Publish(simulation, At(0.9));
        Assert.False(exchange.Latest().TryRead(late, At(1), out _));

        simulation.Submit(ExternalEvent.Spawn(At(0.95), 1, 2, Ball(0.1), V(0, 0, 50)));
        simulation.AdvanceTo(At(1));
        exchange.Publish(simulation, At(0.9));
        Assert.False(exchange.Latest().TryRead(late, At(0.94), out _));
        Assert.True(exchange.Latest().TryRead(late, At(1), out _));

        simulation.Submit(ExternalEvent.Remove(At(0.98), 1, 3, late));
        simulation.AdvanceTo(At(1));
        exchange.Publish(simulation, At(0.9));
        Assert.True(exchange.Latest().TryRead(late, At(0.97), out _));
        Assert.False(exchange.Latest().TryRead(late, At(1), out _));
    }

    /// <summary>
    /// Two bodies always set to one and the same velocity, by two events at one tick: in a whole render snapshot they agree at every instant. The
    /// writer publishes again and again, rolls back, and spawns; the reader checks each render snapshot it gets.
    /// </summary>
    private static (long Seen, string? Fault) Stress(Func<RenderTripleBuffer, RenderSnapshot> read)
    {
        RenderTripleBuffer exchange = new();
        string? fault = null;
        bool done = false;
        Exception? failure = null;
        Thread writer = new(() =>
        {
            try
            {
                Write(exchange);
            }
            catch (Exception e)
            {
                failure = e;
            }

            Volatile.Write(ref done, true);
        });
        writer.Start();
        long last = 0, seen = 0;
        bool ended = false;
        while (!ended && fault is null)
        {
            ended = Volatile.Read(ref done);
            RenderSnapshot snapshot = read(exchange);
            if (snapshot.Number < last)
            {
                fault = $"snapshot {snapshot.Number} after {last}";
            }

            seen += snapshot.Number > last ? 1 : 0;
            last = snapshot.Number;
            if (last > 0)
            {
                SimTime middle = snapshot.From + ((SimTime.Min(snapshot.To, At(1_000_000)) - snapshot.From) / 2);
                fault ??= Inconsistency(snapshot, snapshot.From) ?? Inconsistency(snapshot, middle) ?? Inconsistency(snapshot, SimTime.Min(snapshot.To, At(1_000_000)));
            }
        }

        writer.Join();
        return failure is not null ? (seen, failure.ToString()) : (seen, fault ?? (last == Publications ? null : $"the last seen was {last}"));
    }

    private static void Write(RenderTripleBuffer exchange)
    {
        Random random = new(3);
        Simulation simulation = Pair();
        for (uint i = 1; i <= Publications; i++)
        {
            simulation.AdvanceTo(At(i / 1000.0));
            SimTime when = SimTime.Max(At((i - random.Next(3)) / 1000.0), At(0)); // often late
            Vector3D v = V(random.Next(-9, 10), random.Next(-9, 10));
            simulation.Submit(ExternalEvent.SetVelocity(when, 1, i, First, v));
            simulation.Submit(ExternalEvent.SetVelocity(when, 1, i, Second, v));
            if (i % 1000 == 0)
            {
                simulation.Submit(ExternalEvent.Spawn(when, 2, i, Ball(0.1), V(0, 0, 100 + i)));
            }

            exchange.Publish(simulation, SimTime.Max(At((i / 1000.0) - 0.05), simulation.HistoryEdge));
        }
    }

    private static Simulation Pair() => new(
        new SceneBuilder("pair").WithGravity(Floating).WithSmallestRadius(0.1).AddBody("a", Ball(), V(0)).AddBody("b", Ball(), V(0, 0, 10)).Build(),
        new SimulationOptions(default, SimDuration.FromSeconds(0.5)));

    private static string? Inconsistency(RenderSnapshot snapshot, SimTime time)
    {
        if (!snapshot.TryRead(First, time, out BodyState a) || !snapshot.TryRead(Second, time, out BodyState b))
        {
            return $"snapshot {snapshot.Number} lacks a body at {time}";
        }

        return a.Velocity == b.Velocity && a.Position + V(0, 0, 10) == b.Position ? null : $"snapshot {snapshot.Number} is torn at {time}";
    }
}
