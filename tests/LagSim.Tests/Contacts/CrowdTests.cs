using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Contacts;

/// <summary>Bodies put into one place: what a step of them costs grows with their number, not with that of their pairs.</summary>
public sealed class CrowdTests
{
    private const double Tolerance = 1e-3; // in m/s
    private const int Most = 7; // contacts a body keeps
    private static readonly Vector3D Down = new(0, -9.81, 0);

    [Theory]
    [InlineData(32, 0)]
    [InlineData(32, 0.1)]
    [InlineData(128, 0)]
    [InlineData(128, 0.1)]
    public void Contacts_OfBodiesInOnePlace_AreAsManyAsOfAHeapInCanonicalOrder(int bodies, double spread)
    {
        ContactStep step = Solved(bodies, spread, SolverRules.Usual);
        Assert.InRange(step.Problem.ContactCount, bodies - 1, Most * bodies);
        for (int i = 1; i < step.Problem.ContactCount; i++)
        {
            ref readonly SolverContact before = ref step.Problem.Contacts[i - 1];
            ref readonly SolverContact c = ref step.Problem.Contacts[i];
            Assert.True(before.First < c.First || (before.First == c.First && before.Second < c.Second));
        }
    }

    /// <summary>The control: without the limit all pairs are solved.</summary>
    [Fact]
    public void Contacts_OfACrowdWithoutTheLimit_AreSeenToBeAllPairs() =>
        Assert.Equal(128 * 127 / 2, Solved(128, 0.1, new FaultySolverRules { SolvesCrowds = true }).Problem.ContactCount);

    /// <summary>What lies side by side is solved as ever: no contact of a close packing is left out, and it has six a ball at most.</summary>
    [Fact]
    public void Contacts_OfAClosePacking_AreAllSolved()
    {
        ContactStep step = new(Scene(), new ContactScale(1e-3, Down, default));
        ContactStep all = new(Scene(), new ContactScale(1e-3, Down, default), new FaultySolverRules { SolvesCrowds = true });
        for (int n = 0; n < 512; n++)
        {
            int x = n % 8, y = n / 8 % 8, z = n / 64;
            if ((x + y + z) % 2 == 0)
            {
                Add(step, new Vector3D(x, y, z) * (0.1998 / Math.Sqrt(2)));
                Add(all, new Vector3D(x, y, z) * (0.1998 / Math.Sqrt(2)));
            }
        }

        Solve(step);
        Solve(all);
        Assert.True(step.Problem.ContactCount > 4 * step.Problem.BodyCount);
        Assert.Equal(all.Problem.ContactCount, step.Problem.ContactCount);
        for (int b = 0; b < step.Problem.BodyCount; b++)
        {
            Assert.Equal(all.Problem.Bodies[b].Velocity, step.Problem.Bodies[b].Velocity);
        }
    }

    /// <summary>
    /// n bodies spawned at one point: what the worst event is of work for the solver, and what is carried, grows no faster than n log n.
    /// Counted, not timed; the tests of pairs for contact, which grow with the square, are not in it.
    /// </summary>
    [Theory]
    [InlineData(0)]
    [InlineData(0.2)]
    public void Work_OfBodiesSpawnedInOnePlace_GrowsNoFasterThanTheirNumberTimesItsLogarithm(double spread)
    {
        (double few, int carriedByFew) = Spawned(32, spread, SolverRules.Usual);
        (double many, int carriedByMany) = Spawned(128, spread, SolverRules.Usual);
        double most = 128 * Math.Log(128) / (32 * Math.Log(32));
        Assert.InRange(many / few, 0, most);
        Assert.InRange(carriedByMany, 128, 2 * (Most + 1) * 128); // both of a pair carry it
        Assert.InRange((double)carriedByMany / carriedByFew, 0, most);
    }

    /// <summary>The control: all pairs are carried, and their work grows with them.</summary>
    [Fact]
    public void Work_OfACrowdWithoutTheLimit_IsSeenToGrowWithItsPairs()
    {
        FaultySolverRules all = new() { SolvesCrowds = true };
        (double few, int carriedByFew) = Spawned(32, 0.2, all);
        (double many, int carriedByMany) = Spawned(128, 0.2, all);
        Assert.True(many / few > 10, $"{many / few}");
        Assert.True((double)carriedByMany / carriedByFew > 12, $"{carriedByMany} and {carriedByFew}");
    }

    /// <summary>The crowd is parted all the same: after ten seconds nothing is deeper than the tolerance, and all still are
    /// there.</summary>
    [Theory]
    [InlineData(16, 0)]
    [InlineData(48, 0.2)]
    public void Overlap_OfBodiesSpawnedInOnePlace_Ends(int bodies, double spread)
    {
        Simulation world = World(bodies, spread, SolverRules.Usual);
        world.AdvanceTo(At(0.1));
        Assert.True(MinGap(world, At(0.1)) < -0.1);
        world.AdvanceTo(At(10));
        Assert.True(MinGap(world, At(10)) >= -world.Scene.ContactTolerance, $"{MinGap(world, At(10))}");
        Assert.All(Bodies(world), body => Assert.True(Read(world, body, 10).Position.Y > 0.19));
    }

    /// <summary>The most work for the solver of an event in the first steps, in units of about a microsecond, and how many contacts bodies carry after
    /// the first.</summary>
    private static (double Work, int Carried) Spawned(int bodies, double spread, SolverRules rules)
    {
        Simulation world = World(bodies, spread, rules);
        MostWork most = new(world.Engine.Meter.Work);
        world.Work = most;
        world.AdvanceTo(At(0.1) + SimDuration.FromTicks(world.Engine.Step.Scale.Step.Ticks));
        int carried = 0;
        foreach (BodySnapshot body in world.Snapshot(world.SimulatedTo).Bodies)
        {
            carried += body.Contacts.Length;
        }

        world.AdvanceTo(At(0.15));
        return (most.Amount, carried);
    }

    private static Simulation World(int bodies, double spread, SolverRules rules)
    {
        Scene scene = new SceneBuilder("a floor").AddPlane("floor", Vector3D.Up, 0).WithSmallestRadius(0.1).Build();
        Simulation world = new(scene, new SimulationOptions().WithParts(new FaultyEngineParts { Rules = rules }));
        Random random = new(1);
        for (uint n = 1; n <= bodies; n++)
        {
            Vector3D apart = V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5) * spread;
            world.Submit(PlayerAction.Spawn(new BodySpec(0.2, 1, 0.5), V(0, 1, 0) + apart).Stamp(At(0.1), 1, n));
        }

        return world;
    }

    private sealed class MostWork(EventWork work) : IWorkObserver
    {
        internal double Amount { get; private set; }

        public WorkVerdict OnWork(in EventKey key, Span<int> bodies, double amount, bool isAgain, BodyTable table)
        {
            Amount = Math.Max(Amount, work.Solved + (2 * bodies.Length));
            return WorkVerdict.GoOn;
        }

        public WorkVerdict OnCall(in EventKey key, Span<int> bodies, double amount, bool isAgain, BodyTable table) => WorkVerdict.GoOn;
    }

    private static ContactStep Solved(int bodies, double spread, SolverRules rules)
    {
        ContactStep step = new(Scene(), new ContactScale(1e-3, Down, default), rules);
        Random random = new(1);
        for (int n = 0; n < bodies; n++)
        {
            Add(step, new Vector3D(random.NextDouble() - 0.5, 5 + random.NextDouble(), random.NextDouble() - 0.5) * spread);
        }

        Solve(step);
        return step;
    }

    private static void Add(ContactStep step, Vector3D place) =>
        step.AddBody(new BodySpec(0.1, 1, 0.2), place, Vector3D.Zero, Vector3D.Zero, Vector3D.Zero, isHeld: false);

    private static void Solve(ContactStep step)
    {
        double seconds = step.Scale.Step.ToSeconds();
        step.FindContacts(seconds);
        step.Solve(seconds, Tolerance);
    }

    private static Scene Scene() => new SceneBuilder("empty").WithSmallestRadius(0.1).WithContactTolerance(1e-3).Build();
}
