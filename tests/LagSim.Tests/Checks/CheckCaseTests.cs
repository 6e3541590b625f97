using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Verification.Check;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Checks;

/// <summary>What <c>check</c> draws: every sort of scene, link and action, and what is rare.</summary>
public sealed class CheckCaseTests
{
    private static readonly CheckCase[] Cases = [.. Enumerable.Range(1, 150).Select(seed => new CheckCase((ulong)seed, new CheckOptions()))];

    [Fact]
    public void Draw_ManySeeds_EverySortOfSceneLinkAndAction()
    {
        CheckCase[] cases = Cases[..60];
        Assert.All(cases, c => Assert.InRange(c.Scene.Bodies.Count, 8, 12));
        Assert.All(cases, c => Assert.True(c.Actions.Count >= 20));
        Assert.All(cases, c => Assert.True(c.Actions.Zip(c.Actions.Skip(1)).All(pair => pair.First.AtSeconds <= pair.Second.AtSeconds)));
        Assert.Equal(2, cases.Select(c => c.Scene.Gravity == Vector3D.Zero).Distinct().Count());
        Assert.Contains(cases, c => c.Scene.StaticSpheres.Count > 0);
        MotionLaw[] flights = [.. cases.SelectMany(c => c.Scene.Bodies).Select(b => b.Spec.Flight).Distinct()];
        Assert.Superset(new HashSet<MotionLaw> { MotionLaw.Ballistic, MotionLaw.RungeKutta4, MotionLaw.ClosedForm, MotionLaw.DormandPrince54 }, flights.ToHashSet());
        Assert.Contains(cases, c => c.Scene.Bodies.Any(b => b.Spec.Friction > 0 && b.Spin != Vector3D.Zero));
        Assert.All(Enumerable.Range(0, 7), n => Assert.Contains(Cases, c => c.Scene.Forces.Count == 7 && c.Scene.Bodies.Any(b => b.Spec.Forces.Contains(n))));
        Assert.Contains(cases, c => c.Scene.Bodies.Any(b => b.Spec.Restitution == 0));
        Assert.Equal(10, cases.SelectMany(c => c.Actions).Select(d => d.Kind).Distinct().Count());
        Assert.Contains(cases.SelectMany(c => c.Actions), d => d.Kind == EventKind.Spawn && d.Spin != Vector3D.Zero && d.Spec.Friction > 0);
        HashSet<string> links = [.. Cases.SelectMany(c => c.Players.Skip(1)).Select(p => p.Link.Name)];
        Assert.Superset(LinkProfiles.All.Where(p => !p.Name.StartsWith("delay-", StringComparison.Ordinal)).Select(p => p.Name).ToHashSet(), links);
        Assert.Contains(cases.SelectMany(c => c.Players), p => p.Link.RoundTripMilliseconds > 3_000);
        Assert.Contains(cases.SelectMany(c => c.Players), p => p.IsKilled && p.LeavesAtSeconds is not null);
        Assert.All(cases, c => Assert.True(c.History <= SimDuration.FromSeconds(5)));
    }

    [Fact]
    public void Draw_ManySeeds_WhatIsRareToo()
    {
        CheckCase[] cases = Cases;
        Assert.Contains(cases, c => c.Scene.Bodies.Max(b => b.Spec.Mass) >= 1e6 * c.Scene.Bodies.Min(b => b.Spec.Mass));
        CheckCase[] boxes = [.. cases.Where(c => c.Scene.Box.Exists)];
        Assert.InRange(boxes.Length, 2, 15);
        Assert.Contains(boxes, c => c.Actions.Any(d => d.Kind == EventKind.Spawn));
        CheckCase[] orbits = [.. cases.Where(c => c.Scene.Forces.Any(f => f.Kind == ForceKind.Central && f.Power == -2))];
        Assert.InRange(orbits.Length, 3, 20);
        Assert.All(orbits, c => Assert.Contains(c.Scene.Bodies, b => b.Spec.Flight == MotionLaw.ClosedForm)); // of Kepler's problem: no gravity, one pull
        Assert.Contains(orbits, c => c.Scene.Bodies.Any(b => b.Spec.Flight == MotionLaw.DormandPrince54));
        Assert.Contains(orbits, c => c.Scene.Bodies.Any(b => b.Spec.RollingResistance > 0) && c.Scene.StaticSpheres.Count > 0);
        CheckCase[] heaps = [.. cases.Where(c => c.Scene.Planes.Count == 1)];
        Assert.InRange(heaps.Length, 4, 20);
        CheckCase[] pits = [.. cases.Where(c => c.Scene.ContactTolerance is 1e-2 or 1e-4)]; // half of them
        Assert.InRange(pits.Length, 10, 40);
        Assert.All(heaps.Concat(pits), c => Assert.Contains(c.Actions, d => d.Kind == EventKind.Grab));
        Assert.Contains(heaps, c => c.Scene.StaticSpheres.Count > 0);

        // Under gravity, among walls.
        SceneBody[] falling = [.. cases.Except(pits).Where(c => c.Scene.Planes.Count == 6 && c.Scene.Gravity != Vector3D.Zero).SelectMany(c => c.Scene.Bodies)];
        Assert.All(Enumerable.Range(1, 6), n => Assert.Contains(falling, b => b.Spec.Forces.Contains(n)));
        Assert.Contains(falling, b => !b.Spec.Forces.IsEmpty && b.Spec.RollingResistance > 0);
        Assert.Contains(cases.SelectMany(c => c.Scene.Bodies), b => b.Spec.Flight == MotionLaw.DormandPrince54 && b.Spec.Tolerance == 0);
        Assert.All([ForceKind.LinearDrag, ForceKind.QuadraticDrag], kind => Assert.Equal(
            2, cases.SelectMany(c => c.Scene.Forces).Where(f => f.Kind == kind).Select(f => f.Vector == Vector3D.Zero).Distinct().Count()));
    }

    [Fact]
    public void Draw_Hands_TakeMoveAndLetGoAndAreAfterTheSameBody()
    {
        CheckCase[] cases = Cases[..60];
        EventKind[] ofHands = [EventKind.Grab, EventKind.HoldKeyframe, EventKind.Release];
        CheckAction[][] hands = [.. cases.Select(c => c.Actions.Where(d => ofHands.Contains(d.Kind)).ToArray())];
        Assert.True(hands.Count(h => h.Length > 0) > 30);
        Assert.Contains(hands, h => h.Where(d => d.Kind == EventKind.Grab).GroupBy(d => (d.Body, d.Spawn)).Any(g => g.Select(d => d.Peer).Distinct().Skip(1).Any()));
        Assert.All(cases, c => Assert.All(c.Actions, d => Assert.True(
            d.Spawn < 0 || (c.Actions[d.Spawn].Kind == EventKind.Spawn && c.Actions[d.Spawn].AtSeconds <= d.AtSeconds))));
    }

    /// <summary>
    /// Where rules hear of players, these leave with and without their places and come back as who they were or as strangers; with the same
    /// actions. The control: where they hear of none nobody comes back, and what is drawn is what would be without rules that could.
    /// </summary>
    [Fact]
    public void Draw_RulesThatHearPlayers_PlayersLeaveAndComeBack()
    {
        CheckCase[] ruled = [.. Enumerable.Range(1, 24).Select(seed => new CheckCase((ulong)seed, new CheckOptions { Rules = RulesOfSessions.All }))];
        CheckCase[] heard = [.. ruled.Where(c => c.Scene.Rules!.HearsPlayers)];
        Assert.InRange(heard.Length, 8, 16);
        CheckPlayer[] back = [.. heard.SelectMany(c => c.Players).Where(p => p.Returns is not null)];
        Assert.True(back.Length > 6, $"{back.Length}");
        Assert.All(heard, c => Assert.All(c.Players, p => Assert.True(p.Returns is not int former || c.Players[former].LeavesAtSeconds < p.AsksAtSeconds)));
        Assert.Equal(2, back.Select(p => p.HasPass).Distinct().Count());
        Assert.Equal(2, back.Select(p => p.KeepsPlace).Distinct().Count());
        Assert.Equal(2, back.Select(p => p.IsKilled).Distinct().Count());
        CheckPlayer[] clients = [.. heard.SelectMany(c => c.Players.Skip(1))];
        Assert.Equal([PeerRole.Player, PeerRole.Bot], clients.Select(p => p.Role).Distinct().Order());
        Assert.Contains(clients, p => p.Name.Length == 0);
        Assert.Contains(clients, p => p.Name.Any(letter => letter > 0x7F));
        Assert.Equal(2, heard.Select(c => c.Visits.Timeout).Distinct().Count());
        Assert.All(heard.SelectMany(c => c.Actions.Select(a => (c, a))), pair => Assert.Null(pair.c.Players[pair.a.Peer].Returns));

        foreach (CheckCase deaf in ruled.Except(heard))
        {
            Assert.All(deaf.Players, p => Assert.True(p is { Returns: null, KeepsPlace: false, Name: "", Role: PeerRole.Player }));
            Assert.Equal((SimDuration.FromSeconds(20), new HostOptions().RejoinTime), (deaf.Visits.Timeout, deaf.Visits.RejoinTime));
        }

        CheckCase none = ruled.Except(heard).First();
        Assert.Equal(new CheckCase(none.Seed, new CheckOptions { Rules = RulesOfSessions.None }).Players.Select(p => p.ToString()), none.Players.Select(p => p.ToString()));
    }
}
