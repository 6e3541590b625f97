using System;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Wire;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>A command that the rules fail in ends the world, or counts as none, as they say; the second is told to all.</summary>
public sealed class FailedCommandTests
{
    private static readonly ExternalEvent Good = PlayerAction.Command(new GameCommand(1)).Stamp(At(0.4), 2, 1);
    private static readonly ExternalEvent Bad = PlayerAction.Command(new GameCommand(7)).Stamp(At(0.5), 2, 2);

    [Fact]
    public void FailedCommand_ThatIsSkipped_ChangesNothingAndIsToldWithItsSender()
    {
        Simulation world = Run(Scene(new Skips()), 1, [Good, Bad]);
        Assert.True(world.TryReadRules(At(1), out GivenState state));
        Assert.Equal((1, 0.5), (state.Count, Math.Round(state.Height, 9))); // the timer is still that of the command before
        Assert.Equal(V(1), Read(world, First, 1).Velocity);
        Assert.Equal(1, world.BodyCount);
        RuleNotice[] told = [.. RuleEvents.Of(world).Select(one => one.Notice)];
        Assert.Equal([1, RuleNotice.CommandFailed], told.Select(one => one.Code)); // and not what it told before it failed
        Assert.True(told[1].TryReadFailedCommand(out byte player, out int number));
        Assert.Equal((2, 7), (player, number));
        Assert.Equal(
            "The rules 'skips 1' failed at 0.5s, round 0, in OnCommand for command 7 of peer 2: No such command. The command counts as none.", told[1].Sentence);
        Assert.Equal(told[1].Sentence, told[1].ToString());
        Assert.False(told[0].TryReadFailedCommand(out _, out _));
    }

    [Fact]
    public void FailedCommand_OfRulesThatDoNotSaySo_EndsTheWorld() => Assert.EndsWith(
        ": No such command.", Assert.Throws<SimulationException>(() => Run(Scene(new Skips(skips: false)), 1, [Good, Bad])).Message, StringComparison.Ordinal);

    [Fact]
    public void SkipsFailedCommands_IsPartOfTheScenesHash() => Assert.NotEqual(Scene(new Skips()).Hash, Scene(new Skips(skips: false)).Hash);

    /// <summary>A scene travels with it: a peer whose rules say otherwise is refused.</summary>
    [Theory]
    [InlineData(true, true, null)]
    [InlineData(false, false, null)]
    [InlineData(true, false, "By the scene's rules 'skips' a command that fails counts as none; here it ends the world.")]
    [InlineData(false, true, "By the scene's rules 'skips' a command that fails ends the world; here it counts as none.")]
    public void Scene_OfRulesThatSaySo_IsReadOnlyWhereTheyDo(bool there, bool here, string? refusal)
    {
        bool isRead = SceneFormat.TryDecode(SceneFormat.Encode(Scene(new Skips(there))), new SceneCode(null, [new Skips(here)]), out Scene? scene, out string? error);
        Assert.Equal((refusal is null, refusal), (isRead, error));
        Assert.True(!isRead || scene!.Hash == Scene(new Skips(there)).Hash);
    }

    /// <summary>A late command has the later one succeed: it counts again, and what was told is in doubt, comes back as the same, and is retracted in the end.</summary>
    [Theory]
    [InlineData(RuleFault.None, true)]
    [InlineData(RuleFault.KeepsFailed, false)]
    internal void FailedCommand_AmongLateOnes_IsHealed(RuleFault fault, bool isRight)
    {
        Scene scene = Scene(new Skips());
        ExternalEvent allows = PlayerAction.Command(new GameCommand(2)).Stamp(At(0.2), 1, 1);
        RuleEvents heard = new();
        Simulation late = new(scene, KeepAll.WithParts(new FaultyRules(fault)));
        late.Engine.Rules!.Listen();
        late.Submit(Bad);
        late.Submit(Good);
        Advance();
        Assert.Equal(isRight, Run(scene, 1, [Good, Bad]).StateHash(At(1)) == late.StateHash(At(1)));
        late.Submit(allows);
        Advance();
        Assert.Equal(Run(scene, 1, [allows, Good, Bad]).StateHash(At(1)), late.StateHash(At(1)));
        Assert.True(late.TryReadRules(At(1), out GivenState state) && state.Count == 2);
        late.Retract(allows);
        Advance();
        Assert.Equal(isRight, Run(scene, 1, [Good, Bad]).StateHash(At(1)) == late.StateHash(At(1)));
        late.Submit(PlayerAction.Command(new GameCommand(2)).Stamp(At(0.2), 1, 2));
        Advance();
        late.DropHistoryBefore(At(1)); // nothing that comes now can have it fail again less than half a second away
        Advance(1.1);
        late.DropHistoryBefore(At(1.1));
        Advance(1.1);
        RuleEvent[] failed = [.. heard.All.Where(one => one.Notice.Code == RuleNotice.CommandFailed)];
        NoticeKind[] course = [NoticeKind.Predicted, NoticeKind.InDoubt, NoticeKind.Moved, NoticeKind.InDoubt, NoticeKind.Retracted];
        Assert.Equal(isRight ? course : [], failed.Select(one => one.Kind));
        Assert.True(failed.All(one => one.Id == failed[0].Id && one.Time == Bad.Time));

        void Advance(double to = 1)
        {
            late.AdvanceTo(At(to));
            heard.Notices.Tell(late);
        }
    }

    /// <summary>Machines differ in what memory they have, and a call that is given up is another matter.</summary>
    [Theory]
    [InlineData(typeof(OutOfMemoryException))]
    [InlineData(typeof(InsufficientExecutionStackException))]
    public void FailedCommand_OfTheMachine_EndsTheWorld(Type failure) =>
        Assert.Throws<SimulationException>(() => Run(Scene(new Skips(failure: () => (Exception)Activator.CreateInstance(failure)!)), 1, [Bad]));

    /// <summary>Anybody can throw what the world throws: who throws it in a command ends the world no more than with any other.</summary>
    [Theory]
    [InlineData(typeof(SimulationException))]
    [InlineData(typeof(TimelinesFullException))]
    [InlineData(typeof(RuleException))]
    [InlineData(typeof(OperationCanceledException))]
    public void FailedCommand_WithAnExceptionOfTheWorldsOwnKind_IsSkipped(Type failure)
    {
        Simulation world = Run(Scene(new Skips(failure: () => (Exception)Activator.CreateInstance(failure)!)), 1, [Good, Bad]);
        Assert.Equal(Run(Scene(new Skips()), 1, [Good, Bad]).StateHash(At(1)), world.StateHash(At(1)));
        Assert.Equal([1, RuleNotice.CommandFailed], RuleEvents.Of(world).Select(one => one.Notice.Code));
    }

    /// <summary>Whatever a command throws once it is given up, the world is over.</summary>
    [Fact]
    public void FailedCommand_ThatIsGivenUp_EndsTheWorld()
    {
        RunningRuleCall running = new(SimDuration.FromSeconds(1));
        Simulation world = new(Scene(new Skips(failure: () =>
        {
            Assert.True(running.TryGiveUp(running.Number));
            return new InvalidOperationException("No such command.");
        })), KeepAll.WithRunningRuleCall(running));
        world.Submit(Bad);
        Assert.EndsWith("and was given up.", Assert.Throws<SimulationException>(() => world.AdvanceTo(At(1))).Message, StringComparison.Ordinal);
        Assert.Empty(RuleEvents.Of(world));
    }

    [Theory]
    [InlineData(RuleNotice.CommandFailed)]
    [InlineData(RuleNotice.ChainEnded)]
    public void Tell_WithACodeOfTheWorldsOwn_IsRefused(int code)
    {
        GivenRules rules = new() { Start = w => w.Tell(code) };
        Assert.Contains(
            "stands for what the world tells itself", Assert.Throws<SimulationException>(() => new Simulation(Scene(rules), KeepAll)).Message, StringComparison.Ordinal);
    }

    private static Scene Scene(GameRules rules) =>
        new SceneBuilder("commands").WithGravity(Floating).WithSmallestRadius(0.1).AddBody("ball", Ball(), V(0)).WithRules(rules).Build();

    /// <summary>A command does several things, and then fails unless it is allowed.</summary>
    private sealed class Skips : GameRules
    {
        private readonly Func<Exception>? failure;

        internal Skips(bool skips = true, Func<Exception>? failure = null)
            : base("skips", 1)
        {
            this.failure = failure;
            WithWorldState<GivenState>();
            if (skips)
            {
                WithFailedCommandsSkipped();
            }
        }

        public override void OnCommand(RuleWorld world, byte player, GameCommand command)
        {
            ref GivenState state = ref world.State<GivenState>();
            if (command.Number == 2)
            {
                state.Draw = 1;
                return;
            }

            state.Count++;
            world.SetVelocity(First, V(state.Count));
            world.SetTimer(3, SimDuration.FromSeconds(0.1));
            world.Tell(command.Number);
            if (command.Number == 7 && state.Draw == 0)
            {
                world.Spawn(Ball(0.1), V(5));
                throw failure?.Invoke() ?? new InvalidOperationException("No such command.");
            }
        }

        public override void OnTimer(RuleWorld world, int timer) => world.State<GivenState>().Height = world.Elapsed.ToSeconds();
    }
}
