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
        IReadOnlyList<PlannedAction> plan = PlayerPlan.Draw(scene!, 4, 7);
        Assert.Equal(plan, PlayerPlan.Draw(scene!, 4, 7));
        Assert.NotEqual(plan, PlayerPlan.Draw(scene!, 4, 8));
        Assert.Equal(12, plan.Count);
        Assert.Equal(plan.OrderBy(scripted => scripted.Time), plan);
        Assert.All(plan, scripted => Assert.InRange(scripted.Time.ToSeconds(), 1, 6));
        Assert.All(plan, scripted => Assert.InRange(scripted.Peer, 0, 3));
        Assert.All(plan, scripted => Assert.True(scripted.Kind == EventKind.Teleport || scripted.Velocity.Length > 0));
        Assert.Contains(plan, scripted => scripted.Kind == EventKind.Impulse);
        Assert.Contains(plan, scripted => scripted.Kind == EventKind.SetVelocity);
        Assert.True(plan.Select(scripted => scripted.Peer).Distinct().Count() > 1);
        Assert.Equal(plan.Count(scripted => scripted.Kind == EventKind.Spawn), plan.Where(scripted => scripted.Kind == EventKind.Spawn).Select(scripted => scripted.Body).Distinct().Count());
    }

    [Theory]
    [MemberData(nameof(Scenes))]
    public void Draw_OverManySeeds_HasEveryKind(string name)
    {
        BuiltInScenes.TryGet(name, out Scene? scene);
        EventKind[] kinds = Enumerable.Range(1, 5).SelectMany(seed => PlayerPlan.Draw(scene!, 3, (ulong)seed)).Select(scripted => scripted.Kind).Distinct().Order().ToArray();
        Assert.Equal(new[] { EventKind.Spawn, EventKind.Teleport, EventKind.SetVelocity, EventKind.Impulse }.Order(), kinds);
    }

    [Fact]
    public void Draw_OnATable_LeavesBallsOnIt()
    {
        IReadOnlyList<PlannedAction> plan = PlayerPlan.Draw(BuiltInScenes.Billiards(), 4, 1);
        Assert.All(plan, scripted => Assert.Equal(0, scripted.Velocity.Y));
        Assert.All(plan.Where(scripted => scripted.Kind is EventKind.Spawn or EventKind.Teleport), scripted => Assert.Equal(0.028575, scripted.Position.Y));
    }

    [Fact]
    public void Draw_WithRights_HasNobodyDoWhatIsNotHis()
    {
        Scene scene = new SceneBuilder("rights").WithSpawners(PeerSet.Of(2))
            .AddBody("anybody's", Ball(), V(0)).AddBody("one's", Ball(), V(3), players: PeerSet.Of(1)).AddBody("nobody's", Ball(), V(6), players: PeerSet.Nobody).Build();
        PlannedAction[] plan = Enumerable.Range(1, 40).SelectMany(seed => PlayerPlan.Draw(scene, 3, (ulong)seed)).ToArray();
        Assert.All(plan.Where(scripted => scripted.Kind == EventKind.Spawn), scripted => Assert.Equal(2, scripted.Peer));
        Assert.All(plan.Where(scripted => scripted.Kind != EventKind.Spawn && scripted.Body == Second), scripted => Assert.Equal(1, scripted.Peer));
        Assert.DoesNotContain(plan, scripted => scripted.Kind != EventKind.Spawn && scripted.Body == Third);
        Assert.Contains(plan, scripted => scripted.Kind == EventKind.Spawn);
        Assert.Contains(plan, scripted => scripted.Body == Second);
        Assert.Equal(3, plan.Where(scripted => scripted.Body == First).Select(scripted => scripted.Peer).Distinct().Count());
    }

    [Fact]
    public void Draw_WhereNobodyMaySpawn_HasImpulsesInstead()
    {
        Scene scene = new SceneBuilder("no spawners").WithSpawners(PeerSet.Nobody).AddBody("ball", Ball(), V(0)).Build();
        IReadOnlyList<PlannedAction> plan = PlayerPlan.Draw(scene, 3, 1);
        Assert.Equal(12, plan.Count);
        Assert.DoesNotContain(plan, scripted => scripted.Kind == EventKind.Spawn);
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
