using System;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Healing;

/// <summary>Impacts of one round are one instant, also where a heal has met the first of them and still finds another.</summary>
public sealed class RoundTests
{
    private static readonly BodyId Pushed = BodyId.OfScene(4);

    /// <summary>
    /// A late command has a timer push a ball into two that strike each other in that very instant. The call for their impact, which is
    /// there already, has the ball looked at again: it is to meet them before that impact, not after it.
    /// </summary>
    [Theory]
    [InlineData(HealingFault.None, true)]
    [InlineData(HealingFault.ForgetsTheRound, false)]
    internal void LateCommand_ThatBringsAnotherIntoARound_HasTheSameBits(HealingFault fault, bool isSame)
    {
        Scene scene = Row();
        ExternalEvent late = PlayerAction.Command(new GameCommand(7, [])).Stamp(SimTime.FromTicks(367_165_475_637), 1, 2);
        Simulation onTime = new(scene, KeepAll);
        onTime.Submit(late);
        onTime.AdvanceTo(At(0.5));
        Simulation healed = new(scene, KeepAll.WithParts(new FaultyEngineParts { Healing = fault }));
        healed.AdvanceTo(At(0.5));
        healed.Submit(late);
        healed.AdvanceTo(At(0.5));
        Assert.Equal(isSame, (onTime.StateHash(At(0.5)), onTime.EventHash(At(0.5))) == (healed.StateHash(At(0.5)), healed.EventHash(At(0.5))));
    }

    /// <summary>
    /// Two acts at one tick are taken back, one after the other: a spawned ball lies in two others, and the three meet in one impact, as they
    /// do where the acts never were. There are no rules; which of the three is looked at first follows from what was taken back.
    /// </summary>
    [Theory]
    [InlineData(HealingFault.None, true)]
    [InlineData(HealingFault.ForgetsTheRound, false)]
    internal void Retractions_AtTheTickOfAnImpactOfThree_LeaveItOne(HealingFault fault, bool isSame)
    {
        BodySpec ball = new(0.25, 1, 0.8);
        Scene scene = new SceneBuilder("three").WithGravity(Vector3D.Zero).WithSmallestRadius(0.05)
            .AddBody("a", ball, V(0, 0.25, 0.5)).AddBody("b", ball, V(0.5, 0.25, 0)).AddBody("c", ball, V(0.5, 0.25, 0.5)).Build();
        Random random = new(1);
        bool allSame = true;
        for (int n = 0; n < 100; n++)
        {
            ExternalEvent spawn = PlayerAction.Spawn(ball, V(0.2, 0.25, 0.6) + Draw(random, 0.3, 0.1, 0.2)).Stamp(At(0.25), 3, 1);
            ExternalEvent hit = PlayerAction.SetVelocity(BodyId.OfScene(2), V(-3, -3, -3) + Draw(random, 6, 6, 6)).Stamp(At(0.25), 2, 2);
            ExternalEvent push = PlayerAction.Impulse(BodyId.OfScene(1), V(-1, -1, -1) + Draw(random, 2, 2, 2)).Stamp(At(0.25), 1, 3);
            Simulation never = new(scene, KeepAll);
            never.Submit(spawn);
            never.AdvanceTo(At(0.7));
            Simulation healed = new(scene, KeepAll.WithParts(new FaultyEngineParts { Healing = fault }));
            healed.Submit(spawn);
            healed.Submit(push);
            healed.Submit(hit);
            healed.AdvanceTo(At(0.3));
            healed.Retract(hit);
            healed.Retract(push);
            healed.AdvanceTo(At(0.7));
            allSame &= never.EventHash(At(0.7)) == healed.EventHash(At(0.7)) && never.StateHash(At(0.7)) == healed.StateHash(At(0.7));
        }

        Assert.Equal(isSame, allSame);
    }

    private static Vector3D Draw(Random random, double x, double y, double z) =>
        new(x * random.NextDouble(), y * random.NextDouble(), z * random.NextDouble());

    private static Scene Row()
    {
        (double Mass, double Restitution, Vector3D Position, Vector3D Velocity)[] balls =
        [
            (3.726783053620319, 0.5, V(0, 0.25), V(0)), (12.179789890514142, 1, V(0, 0.75), V(0)),
            (0.6473723230784856, 0.5, V(0.5, 0.25), V(0)), (4.02410644985574, 1, V(0.5, 0.75), V(0)),
            (14.020153799257455, 0, V(-0.75, 0.25), V(1)), (0.12307100948502375, 1, V(1.25, 0.25), V(-1)),
            (4.378584990967529, 0.5, V(0.25, 1.5), V(0, -1)),
        ];
        SceneBuilder builder = new SceneBuilder("row").WithGravity(Vector3D.Zero).WithSmallestRadius(0.05).WithContactTolerance(1e-5)
            .AddPlane("floor", Vector3D.Up, 0, 0);
        for (int n = 0; n < balls.Length; n++)
        {
            builder.AddBody($"{n}", new BodySpec(0.25, balls[n].Mass, balls[n].Restitution), balls[n].Position, balls[n].Velocity);
        }

        return builder.WithRules(new Pushing()).Build();
    }

    private struct Told
    {
        public long IsOn;
    }

    private sealed class Pushing : GameRules
    {
        internal Pushing()
            : base("pushing", 1) => WithWorldState<Told>();

        public override bool HearsContact(BodyId first, BodyId second, int surface) => surface < 0;

        public override void OnCommand(RuleWorld world, byte player, GameCommand command)
        {
            world.State<Told>().IsOn = 1;
            world.SetTimer(1, SimDuration.OneTick);
        }

        public override void OnTimer(RuleWorld world, int timer) => world.Impulse(Pushed, new Vector3D(2, 2, 0) * world.SpecOf(Pushed).Mass);

        public override void OnContact(RuleWorld world, in RuleContact contact)
        {
            if (world.State<Told>().IsOn == 1 && contact.First == BodyId.OfScene(0) && contact.Second == BodyId.OfScene(1))
            {
                world.SetVelocity(Pushed, default);
            }
        }
    }
}
