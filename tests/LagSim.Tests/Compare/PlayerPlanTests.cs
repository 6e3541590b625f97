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
        Assert.Equal(plan.OrderBy(action => action.Time), plan);
        Assert.All(plan, action => Assert.InRange(action.Time.ToSeconds(), 1, 6));
        Assert.All(plan, action => Assert.InRange(action.Peer, 0, 3));
        Assert.All(plan, action => Assert.True(action.Kind == EventKind.Teleport || action.Velocity.Length > 0));
        Assert.Contains(plan, action => action.Kind == EventKind.Impulse);
        Assert.Contains(plan, action => action.Kind == EventKind.SetVelocity);
        Assert.True(plan.Select(action => action.Peer).Distinct().Count() > 1);
        PlannedAction[] spawns = plan.Where(action => action.Kind == EventKind.Spawn).ToArray();
        Assert.Equal(spawns.Length, spawns.Select(action => action.Body).Distinct().Count());
    }

    [Theory]
    [MemberData(nameof(Scenes))]
    public void Draw_OverManySeeds_HasEveryKind(string name)
    {
        BuiltInScenes.TryGet(name, out Scene? scene);
        EventKind[] kinds = Enumerable.Range(1, 5).SelectMany(seed => PlayerPlan.Draw(scene!, 3, (ulong)seed))
            .Select(action => action.Kind).Distinct().Order().ToArray();
        Assert.Equal(new[] { EventKind.Spawn, EventKind.Teleport, EventKind.SetVelocity, EventKind.Impulse }.Order(), kinds);
    }

    [Fact]
    public void Draw_OnATable_LeavesBallsOnIt()
    {
        IReadOnlyList<PlannedAction> plan = PlayerPlan.Draw(BuiltInScenes.Billiards(), 4, 1);
        Assert.All(plan, action => Assert.Equal(0, action.Velocity.Y));
        Assert.All(
            plan.Where(action => action.Kind is EventKind.Spawn or EventKind.Teleport),
            action => Assert.Equal(0.028575, action.Position.Y));
    }

    [Fact]
    public void Draw_WithRights_HasNobodyDoWhatIsNotHis()
    {
        Scene scene = new SceneBuilder("rights").WithSpawners(PeerSet.Of(2))
            .AddBody("anybody's", Ball(), V(0)).AddBody("one's", Ball(), V(3), players: PeerSet.Of(1)).AddBody("nobody's", Ball(), V(6), players: PeerSet.Nobody).Build();
        PlannedAction[] plan = Enumerable.Range(1, 40).SelectMany(seed => PlayerPlan.Draw(scene, 3, (ulong)seed)).ToArray();
        Assert.All(plan.Where(action => action.Kind == EventKind.Spawn), action => Assert.Equal(2, action.Peer));
        Assert.All(plan.Where(action => action.Kind != EventKind.Spawn && action.Body == Second), action => Assert.Equal(1, action.Peer));
        Assert.DoesNotContain(plan, action => action.Kind != EventKind.Spawn && action.Body == Third);
        Assert.Contains(plan, action => action.Kind == EventKind.Spawn);
        Assert.Contains(plan, action => action.Body == Second);
        Assert.Equal(3, plan.Where(action => action.Body == First).Select(action => action.Peer).Distinct().Count());
    }

    [Fact]
    public void Draw_WhereNobodyMaySpawn_HasImpulsesInstead()
    {
        Scene scene = new SceneBuilder("no spawners").WithSpawners(PeerSet.Nobody).AddBody("ball", Ball(), V(0)).Build();
        IReadOnlyList<PlannedAction> plan = PlayerPlan.Draw(scene, 3, 1);
        Assert.Equal(12, plan.Count);
        Assert.DoesNotContain(plan, action => action.Kind == EventKind.Spawn);
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
