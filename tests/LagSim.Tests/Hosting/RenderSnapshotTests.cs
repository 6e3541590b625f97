using System;
using LagSim.Events;
using LagSim.Harness.Verification.Check;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Hosting;

/// <summary>What a render snapshot tells besides where bodies are.</summary>
public sealed class RenderSnapshotTests
{
    [Fact]
    public void TryReadSuddenChange_Bounce_IsWhatItDidToTheVelocity()
    {
        // Falls 5 m to the floor, 1.0096 s, and keeps 0.8 of its speed.
        RenderSnapshot snapshot = Shown(Run(Drop(5, 0.8, MotionLaw.RungeKutta4), 1.5));
        Assert.Equal(1.8 * Math.Sqrt(2 * Gravity * 5), Change(snapshot, 1, 1.02), 1e-6);
        Assert.InRange(Change(snapshot, 0.2, 1), 0, 1e-9); // 160 steps of the integrator are no strokes
        Assert.Equal(0, Change(snapshot, 1.02, 1.02));
    }

    [Fact]
    public void TryReadSuddenChange_BetweenTheInstantsAlone_Counts()
    {
        Simulation simulation = Run(Drop(50, 0.8), 0.5);
        simulation.Submit(PlayerAction.Impulse(First, V(3)).Stamp(At(0.25), 1, 1));
        simulation.Submit(PlayerAction.Impulse(First, V(0, 0, 4)).Stamp(At(0.3), 1, 2));
        simulation.AdvanceTo(At(0.5));
        RenderSnapshot snapshot = Shown(simulation);
        Assert.Equal(0, Change(snapshot, 0.25, 0.29));
        Assert.Equal(3, Change(snapshot, 0.24, 0.25), 1e-12);
        Assert.Equal(4, Change(snapshot, 0.24, 0.31), 1e-12);
    }

    [Fact]
    public void TryReadSuddenChange_PutElsewhereComeOrGone_IsInfinite()
    {
        BodyId late = new(1, 2, 0);
        Simulation simulation = Run(Drop(50, 0.8), 0.5);
        simulation.Submit(PlayerAction.Teleport(First, V(0, 60)).Stamp(At(0.2), 1, 1));
        simulation.Submit(PlayerAction.Spawn(Ball(), V(9, 60)).Stamp(At(0.2), 1, 2));
        simulation.Submit(PlayerAction.Remove(late).Stamp(At(0.4), 1, 3));
        simulation.AdvanceTo(At(0.5));
        RenderSnapshot snapshot = Shown(simulation);
        Assert.Equal(double.PositiveInfinity, Change(snapshot, 0.19, 0.21));
        foreach ((double after, double upTo, double change) in new[] { (0.1, 0.2, double.PositiveInfinity), (0.2, 0.39, 0), (0.39, 0.4, double.PositiveInfinity), (0.4, 0.5, 0) })
        {
            Assert.True(snapshot.TryReadSuddenChange(late, At(after), At(upTo), out double read));
            Assert.Equal(change, read);
        }

        Assert.False(snapshot.TryReadSuddenChange(First, At(-1), At(0.3), out _));
        Assert.False(snapshot.TryReadSuddenChange(Second, At(0.1), At(0.3), out _));
    }

    [Fact]
    public void RadiusOf_KnownAndUnknown_IsTheSpecsOrZero()
    {
        Simulation simulation = Run(Drop(50, 0.8), 0.5);
        simulation.Submit(PlayerAction.Spawn(Ball(0.75), V(9, 60)).Stamp(At(0.2), 1, 2));
        simulation.AdvanceTo(At(0.5));
        RenderSnapshot snapshot = Shown(simulation);
        Assert.Equal((0.5, 0.75, 0), (snapshot.RadiusOf(First), snapshot.RadiusOf(new BodyId(1, 2, 0)), snapshot.RadiusOf(Second)));
    }

    /// <summary>What the rules' state is in a render snapshot is what it is in the world, also after a late event, and also in the buffer that
    /// showed something else before.</summary>
    [Fact]
    public void TryReadRules_AtAnyInstant_IsTheStateOfTheWorld()
    {
        RandomWorld drawn = new(5, rules: true);
        Simulation world = new(drawn.Scene, KeepAll);
        RenderTripleBuffer exchange = new();
        int changes = 0, ofBodies = 0;
        SimTime shown = world.Start;
        foreach (ExternalEvent external in drawn.Events)
        {
            shown = SimTime.Max(shown + SimDuration.FromSeconds(0.1), world.SimulatedTo);
            world.AdvanceTo(shown);
            world.Submit(external);
            world.AdvanceTo(shown);
            SimTime from = world.Start + SimDuration.FromSeconds(0.05);
            exchange.Publish(world, from);
            RenderSnapshot snapshot = exchange.Latest();
            DrawnRules.Total before = default;
            for (SimTime time = from; time <= world.SimulatedTo; time += SimDuration.FromSeconds(0.003))
            {
                Assert.True(snapshot.TryReadRules(time, out DrawnRules.Total inSnapshot) && world.TryReadRules(time, out DrawnRules.Total total) && total.Equals(inSnapshot));
                Assert.Equal(world.TryReadRules(First, time, out DrawnRules.OfBody body), snapshot.TryReadRules(First, time, out DrawnRules.OfBody bodyInSnapshot));
                Assert.Equal(body, bodyInSnapshot);
                ofBodies += body.Equals(default) ? 0 : 1;
                changes += inSnapshot.Equals(before) ? 0 : 1;
                before = inSnapshot;
            }

            Assert.False(snapshot.TryReadRules(from - SimDuration.OneTick, out DrawnRules.Total _));
            Assert.Throws<InvalidOperationException>(() => snapshot.TryReadRules(from, out long _));
            Assert.Throws<InvalidOperationException>(() => snapshot.TryReadRules(First, from, out long _));
        }

        Assert.True(changes > 50 && ofBodies > 50, $"{changes} states seen, {ofBodies} of bodies");
        Assert.False(Shown(Run(Drop(5, 0.8), 0.5)).TryReadRules(At(0.25), out DrawnRules.Total _)); // a scene without
    }

    private static double Change(RenderSnapshot snapshot, double after, double upTo)
    {
        Assert.True(snapshot.TryReadSuddenChange(First, At(after), At(upTo), out double speed));
        return speed;
    }

    private static RenderSnapshot Shown(Simulation simulation)
    {
        RenderTripleBuffer exchange = new();
        exchange.Publish(simulation, SimTime.Zero);
        return exchange.Latest();
    }
}
