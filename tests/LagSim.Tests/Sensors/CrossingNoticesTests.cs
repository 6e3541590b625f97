using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Determinism;
using LagSim.Tests.Hosting;
using LagSim.Tests.Sessions;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sensors;

/// <summary>Crossings as a game hears of them: predicted, and then either confirmed or retracted, each once.</summary>
public sealed class CrossingNoticesTests
{
    [Theory]
    [InlineData(HealingMode.CausalCone)]
    [InlineData(HealingMode.FullRollback)]
    public void Notices_OfRandomWorldsWithLateEvents_ConfirmEachCrossingOnceInOrderAndNoOther(HealingMode mode)
    {
        int confirmed = 0;
        int moved = 0;
        for (int seed = 0; seed < 60; seed++)
        {
            RandomWorld world = new(seed, sensors: true);
            IReadOnlyList<Crossing> happened = world.OnTime().Crossings(At(0), At(RandomWorld.End));
            Ledger late = new();
            Simulation simulation = new(world.Scene, new SimulationOptions(history: SimDuration.MaxValue, healing: mode).WithCrossingObserver(late.Notices));
            simulation.Healed += _ => late.Notices.Tell(simulation);
            Random arrivals = new(seed);
            foreach ((SimTime heard, ExternalEvent one) in world.Events
                .Select(e => (SimTime.Min(At(RandomWorld.End), e.Time + SimDuration.FromSeconds(arrivals.NextDouble())), e)).OrderBy(e => e.Item1))
            {
                simulation.AdvanceTo(SimTime.Max(heard, simulation.SimulatedTo));
                simulation.Submit(one);
            }

            simulation.AdvanceTo(At(RandomWorld.End));
            simulation.DropHistoryBefore(simulation.SimulatedTo);
            late.Notices.Tell(simulation);
            Assert.Equal(happened.Where(c => c.Time < At(RandomWorld.End)), late.Confirmed);
            Assert.Equal(late.Predicted - late.Retracted, late.Count + late.Notices.Pending);
            confirmed += late.Count;
            moved += late.Moved;
        }

        Assert.True(confirmed > 1000 && moved > 50, $"{confirmed} confirmed, {moved} moved");
    }

    [Theory]
    [InlineData("awful", 1)]
    [InlineData("delay-500ms", 3)]
    public void Notices_OfASessionOnABadLink_AreTheSameOnAllPeers(string link, int seed)
    {
        Assert.True(LinkProfiles.TryGet(link, out LinkProfile? profile, out _));
        Ledger[] ledgers = [.. Enumerable.Range(0, 3).Select(_ => new Ledger())];
        Scene box = ScriptedActions.Box();
        Scene scene = new(
            box.Name, box.Gravity, box.RestitutionThreshold, box.ContactTolerance, box.PlaneArray, box.SphereArray, box.BodyArray, box.ForceArray, box.SmallestRadius,
            box.Spawners, box.Box, [.. new SceneBuilder("s").AddSensorPlane("half", V(1), 0.0).AddSensorSphere("middle", V(0, 1), 1, SensorCoverage.Part).Build().Sensors], box.Rules, box.Seed);
        SessionGroup group = new SessionGroup(
            scene, 3, profile, (ulong)seed, peer => new HostOptions { Window = new(SimDuration.FromSeconds(3)), Crossings = ledgers[peer].Notices }).Connect();
        new ScriptedActions(seed, maxSpawns: 4).DoIn(group, 24, 0.2);
        group.Run(12);
        int count = ledgers.Min(l => l.Count);
        Assert.True(count > 10, $"{count}");
        Assert.All(ledgers, l => Assert.Equal(ledgers[0].Confirmed.Take(count), l.Confirmed.Take(count)));
        Assert.All(ledgers, l => Assert.Equal(l.Predicted - l.Retracted, l.Count + l.Notices.Pending));
    }

    [Fact]
    public void Notices_OfALiveWorld_AreConfirmedWhenNothingCanChangeThem()
    {
        Scene scene = new SceneBuilder("fall").AddBody("ball", Ball(0.5), V(0, 10)).AddSensorPlane("deep", Vector3D.Up, 9.0).Build();
        CrossingNotices notices = new(16);
        LiveWorld world = new(scene, new SimulationOptions(history: SimDuration.FromSeconds(1)), crossings: notices);
        Assert.Same(notices, world.Crossings);
        SimTime due = At(0);
        for (int steps = 0; due != SimTime.MaxValue; steps++)
        {
            Assert.True(steps < 1000);
            due = world.Step(due);
        }

        Assert.True(notices.TryRead(out CrossingNotice predicted));
        Assert.True(notices.TryRead(out CrossingNotice confirmed));
        Assert.Equal((NoticeKind.Predicted, NoticeKind.Confirmed), (predicted.Kind, confirmed.Kind));
        Assert.True(predicted.Crossing == confirmed.Crossing && confirmed.Entered && confirmed is { Sensor: 0, Number: 2 } && confirmed.Body == First);
        Assert.False(notices.TryRead(out _));
        Assert.Contains("Confirmed: body 0.0.0 enters sensor 0", confirmed.ToString(), StringComparison.Ordinal);
        Assert.Throws<InvalidOperationException>(() => new LiveWorld(scene, new SimulationOptions(), crossings: notices));
        Assert.Throws<ArgumentOutOfRangeException>(() => new CrossingNotices(3));
    }

    private sealed class Ledger
    {
        private readonly NoticeCourses<CrossingNotice> courses = new(n => new NoticeStamp(n.Kind, n.Number, n.Id, n.MovedFrom));

        internal Ledger() => Notices.Noticed += notice =>
        {
            courses.Take(notice);
            Assert.Null(courses.Broken);
        };

        internal CrossingNotices Notices { get; } = new();

        internal IEnumerable<Crossing> Confirmed => courses.Confirmed.Select(notice => notice.Crossing);

        internal int Count => courses.Confirmed.Count;

        internal int Predicted => courses.Predicted;

        internal int Moved => courses.Moved;

        internal int Retracted => courses.Retracted;
    }
}
