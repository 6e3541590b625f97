using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Compare;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Compare;

public sealed class PlayerPlanTests
{
    public static TheoryData<string> Scenes => new(BuiltInScenes.Names);

    [Theory]
    [MemberData(nameof(Scenes))]
    public void Draw_OnEveryBuiltInScene_IsTheSameForTheSameSeedOnly(string name)
    {
        BuiltInScenes.TryGet(name, out Scene? scene);
        IReadOnlyList<PlannedDeed> plan = PlayerPlan.Draw(scene!, 4, 7);
        Assert.Equal(plan, PlayerPlan.Draw(scene!, 4, 7));
        Assert.NotEqual(plan, PlayerPlan.Draw(scene!, 4, 8));
        Assert.Equal(12, plan.Count);
        Assert.Equal(plan.OrderBy(deed => deed.Time), plan);
        Assert.All(plan, deed => Assert.InRange(deed.Time.ToSeconds(), 1, 6));
        Assert.All(plan, deed => Assert.InRange(deed.Peer, 0, 3));
        Assert.All(plan, deed => Assert.True(deed.Kind == EventKind.Teleport || deed.Velocity.Length > 0));
        Assert.Contains(plan, deed => deed.Kind == EventKind.Impulse);
        Assert.Contains(plan, deed => deed.Kind == EventKind.SetVelocity);
        Assert.True(plan.Select(deed => deed.Peer).Distinct().Count() > 1);
        Assert.Equal(plan.Count(deed => deed.Kind == EventKind.Spawn), plan.Where(deed => deed.Kind == EventKind.Spawn).Select(deed => deed.Body).Distinct().Count());
    }

    [Theory]
    [MemberData(nameof(Scenes))]
    public void Draw_OverManySeeds_HasEveryKind(string name)
    {
        BuiltInScenes.TryGet(name, out Scene? scene);
        EventKind[] kinds = Enumerable.Range(1, 5).SelectMany(seed => PlayerPlan.Draw(scene!, 3, (ulong)seed)).Select(deed => deed.Kind).Distinct().Order().ToArray();
        Assert.Equal(new[] { EventKind.Spawn, EventKind.Teleport, EventKind.SetVelocity, EventKind.Impulse }.Order(), kinds);
    }

    [Fact]
    public void Draw_OnATable_LeavesBallsOnIt()
    {
        IReadOnlyList<PlannedDeed> plan = PlayerPlan.Draw(BuiltInScenes.Billiards(), 4, 1);
        Assert.All(plan, deed => Assert.Equal(0, deed.Velocity.Y));
        Assert.All(plan.Where(deed => deed.Kind is EventKind.Spawn or EventKind.Teleport), deed => Assert.Equal(0.028575, deed.Position.Y));
    }

    [Fact]
    public void Draw_WithRights_HasNobodyDoWhatIsNotHis()
    {
        Scene scene = new SceneBuilder("rights").WithSpawners(PeerSet.Of(2))
            .AddBody("anybody's", Ball(), V(0)).AddBody("one's", Ball(), V(3), players: PeerSet.Of(1)).AddBody("nobody's", Ball(), V(6), players: PeerSet.Nobody).Build();
        PlannedDeed[] plan = Enumerable.Range(1, 40).SelectMany(seed => PlayerPlan.Draw(scene, 3, (ulong)seed)).ToArray();
        Assert.All(plan.Where(deed => deed.Kind == EventKind.Spawn), deed => Assert.Equal(2, deed.Peer));
        Assert.All(plan.Where(deed => deed.Kind != EventKind.Spawn && deed.Body == Second), deed => Assert.Equal(1, deed.Peer));
        Assert.DoesNotContain(plan, deed => deed.Kind != EventKind.Spawn && deed.Body == Third);
        Assert.Contains(plan, deed => deed.Kind == EventKind.Spawn);
        Assert.Contains(plan, deed => deed.Body == Second);
        Assert.Equal(3, plan.Where(deed => deed.Body == First).Select(deed => deed.Peer).Distinct().Count());
    }

    [Fact]
    public void Draw_WhereNobodyMaySpawn_HasImpulsesInstead()
    {
        Scene scene = new SceneBuilder("no spawners").WithSpawners(PeerSet.Nobody).AddBody("ball", Ball(), V(0)).Build();
        IReadOnlyList<PlannedDeed> plan = PlayerPlan.Draw(scene, 3, 1);
        Assert.Equal(12, plan.Count);
        Assert.DoesNotContain(plan, deed => deed.Kind == EventKind.Spawn);
    }

    [Fact]
    public void Draw_WhereNobodyMayDoAnything_IsRefused()
    {
        Scene scene = new SceneBuilder("museum").AddBody("vase", Ball(), V(0), players: PeerSet.Of(5)).Build();
        SceneException refused = Assert.Throws<SceneException>(() => PlayerPlan.Draw(scene, 3, 1));
        Assert.Contains("'museum'", refused.Message, StringComparison.Ordinal);
        Assert.NotEmpty(PlayerPlan.Draw(scene, 6, 1)); // the control: with six peers there is one who may
    }
}
