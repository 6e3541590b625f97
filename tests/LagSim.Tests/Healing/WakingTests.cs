using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Healing;

/// <summary>What is done to a body wakes those that sleep on it, also where a heal puts them to sleep again that something else had woken.</summary>
public sealed class WakingTests
{
    /// <summary>
    /// The ball in the middle of a stack is woken by a push on the top, and a change of the ball below, a moment later, finds it awake. The
    /// push is taken back: now the change has to wake it.
    /// </summary>
    [Theory]
    [InlineData(HealingFault.None, 0, true)]
    [InlineData(HealingFault.None, 1e-4, true)]
    [InlineData(HealingFault.LeavesWhatWakes, 0, false)]
    [InlineData(HealingFault.LeavesWhatWakes, 1e-4, false)]
    internal void Retraction_OfWhatWokeABall_HasTheNextActWakeIt(HealingFault fault, double later, bool isSame)
    {
        BodySpec ball = new(0.25, 1, 0.5, friction: 0.5);
        Scene scene = new SceneBuilder("stack").AddPlane("floor", Vector3D.Up, 0)
            .AddBody("below", ball, V(0, 0.25)).AddBody("middle", ball, V(0, 0.75)).AddBody("top", ball, V(0, 1.25)).Build();
        ExternalEvent push = PlayerAction.SetVelocity(BodyId.OfScene(2), V(1)).Stamp(At(2.001), 1, 1);
        ExternalEvent change = PlayerAction.SetFilter(BodyId.OfScene(0), new CollisionFilter(2, 1)).Stamp(At(2.001 + later), 2, 1);
        Simulation never = new(scene, KeepAll);
        never.AdvanceTo(At(2));
        Assert.True(never.TryRead(BodyId.OfScene(1), At(2), out BodyState middle));
        Assert.Equal(MotionLaw.Resting, middle.Motion);
        never.Submit(change);
        never.AdvanceTo(At(3));
        Simulation healed = new(scene, KeepAll.WithParts(new FaultyEngineParts { Healing = fault }));
        healed.Submit(push);
        healed.Submit(change);
        healed.AdvanceTo(At(3));
        healed.Retract(push);
        healed.AdvanceTo(At(3));
        Assert.Equal(isSame, (never.StateHash(At(3)), never.EventHash(At(3))) == (healed.StateHash(At(3)), healed.EventHash(At(3))));
    }
}
