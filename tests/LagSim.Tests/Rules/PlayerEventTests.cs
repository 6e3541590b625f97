using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>Rules hear of players in any world: in order, healed when late, refused where nobody hears it, on the account of the player.</summary>
public sealed class PlayerEventTests
{
    private const double End = 3;

    /// <summary>Who joins gets a ball, who is away has it stopped, who returns has it kicked, and it goes with its player.</summary>
    private static readonly GivenRules Hosts = new()
    {
        Player = (w, player) =>
        {
            ref GivenState state = ref w.State<GivenState>();
            state.Draw = (state.Draw * 31) + (player.Identity ^ ((ulong)player.Kind << 60) ^ player.Number) + (uint)player.Name.Length;
            state.Count++;
            BodyId own = BodyId.OfScene(player.Number % 3);
            switch (player.Kind)
            {
                case PlayerEventKind.Joined:
                    w.Spawn(Ball(0.3), V(player.Number - 2, 3 + w.RandomFraction()));
                    break;
                case PlayerEventKind.Away when w.TryRead(own, out _):
                    w.SetVelocity(own, V(0));
                    break;
                case PlayerEventKind.Returned when w.TryRead(own, out _):
                    w.Impulse(own, V(1, player.Number));
                    break;
                default:
                    w.SetTimer(player.Number, SimDuration.FromSeconds(0.1));
                    break;
            }
        },
        Timer = (w, timer) => w.Impulse(BodyId.OfScene(timer % 3), V(0, 2)),
        Command = (w, _, _) => w.State<GivenState>().Height += w.State<GivenState>().Count,
    };

    /// <summary>
    /// Drawn worlds hear of what players do, and of who comes and goes, in any order and with retractions: they are to the bit those that had
    /// all at once. The control: a world that misses one such event is another.
    /// </summary>
    [Theory]
    [InlineData(HealingMode.CausalCone)]
    [InlineData(HealingMode.FullRollback)]
    [InlineData(HealingMode.SyncTest)]
    public void OnPlayer_LateAndInAnyOrder_SameAsOnTime(HealingMode mode)
    {
        int healed = 0;
        for (int seed = 1; seed <= 25; seed++)
        {
            Random draws = new(seed);
            List<ExternalEvent> events = Drawn(draws);
            Simulation onTime = Run(Room(Hosts), End, events), late = new(Room(Hosts), new SimulationOptions(default, SimDuration.MaxValue, healing: mode));
            ExternalEvent[] order = [.. events];
            draws.Shuffle(order);
            for (int n = 0; n < order.Length; n++)
            {
                late.AdvanceTo(At(End * n / order.Length));
                healed += late.Submit(order[n]) == SubmitResult.RolledBack ? 1 : 0;
                if (draws.Next(4) == 0)
                {
                    Assert.True(late.Retract(order[n]));
                    late.AdvanceTo(At(End * (n + 0.5) / order.Length));
                    late.Submit(order[n]);
                }

                Assert.Equal(SubmitResult.Duplicate, late.Submit(order[n]));
            }

            late.AdvanceTo(At(End));
            Assert.Equal((onTime.StateHash(At(End)), onTime.EventHash(At(End))), (late.StateHash(At(End)), late.EventHash(At(End))));
            Assert.True(late.TryReadRules(At(End), out GivenState state));
            Assert.Equal(events.Count(e => e.Kind == EventKind.Player), state.Count);

            ExternalEvent missed = events.First(e => e.Kind == EventKind.Player);
            Assert.NotEqual(onTime.StateHash(At(End)), Run(Room(Hosts), End, events.Where(e => !e.Equals(missed))).StateHash(At(End)));
        }

        Assert.True(healed > 50, $"{healed}");
    }

    /// <summary>What is said of several at one tick is heard in the order in which it was said, and before what they do in it.</summary>
    [Fact]
    public void OnPlayer_AtOneTick_ComesInTheOrderOfTheHostAndBeforeCommands()
    {
        List<string> heard = [];
        GivenRules rules = new() { Start = _ => heard.Add("start"), Player = (_, player) => heard.Add(player.ToString()), Command = (_, player, _) => heard.Add($"command of {player}") };
        Run(Room(rules), 1, [
            PlayerAction.Command(new GameCommand(1)).Stamp(At(0), 5, 1),
            Said(PlayerEventKind.Joined, 5, 0, 2, "Zoë"), Said(PlayerEventKind.Left, 9, 0, 1), Said(PlayerEventKind.Joined, 0, 0, 3, role: PeerRole.Spectator)]);
        Assert.Equal(["start", "Left of player 9", "Joined of player 5 Zoë", "Joined of spectator 0", "command of 5"], heard);
    }

    [Fact]
    public void Submit_WhereNobodyHears_IsRefusedWithASentence()
    {
        ExternalEvent ann = Said(PlayerEventKind.Joined, 3, 1, 1, "Ann");
        Assert.Equal(
            "Joined of player 3 Ann at 1s by 0.1 is no event of this scene: it has no rules that could hear it.",
            Assert.Throws<SceneException>(() => Run(Drop(1, 1), 2, [ann])).Message);
        Assert.Equal(
            "Joined of player 3 Ann at 1s by 0.1 is no event of this scene: its rules 'given 1' do not hear of players (HearsPlayers).",
            Assert.Throws<SceneException>(() => Run(Room(new GivenRules()), 2, [ann])).Message);
        Assert.Equal(
            "The sequence number of Joined of player 3 Ann is 0; a peer counts its events from 1.",
            Assert.Throws<SceneException>(() => Run(Room(Hosts), 2, [Said(PlayerEventKind.Joined, 3, 1, 0, "Ann")])).Message);
    }

    [Fact]
    public void PlayerEvent_OfAValueThatIsNone_ThrowsWithIt()
    {
        Assert.Contains("0 is nobody's", Assert.Throws<ArgumentOutOfRangeException>(() => new PlayerEvent(PlayerEventKind.Joined, 1, 0)).Message, StringComparison.Ordinal);
        Assert.Contains("0 to 254", Assert.Throws<ArgumentOutOfRangeException>(() => new PlayerEvent(PlayerEventKind.Joined, 255, 1)).Message, StringComparison.Ordinal);
        Assert.Contains("1 to 4", Assert.Throws<ArgumentOutOfRangeException>(() => new PlayerEvent((PlayerEventKind)5, 1, 1)).Message, StringComparison.Ordinal);
        Assert.Contains("1 to 3", Assert.Throws<ArgumentOutOfRangeException>(() => new PlayerEvent(PlayerEventKind.Left, 1, 1, "", 0)).Message, StringComparison.Ordinal);
        Assert.Contains("takes 66", Assert.Throws<ArgumentException>(() => new PlayerEvent(PlayerEventKind.Left, 1, 1, new string('ä', 33))).Message, StringComparison.Ordinal);
        Assert.Contains("U+000A", Assert.Throws<ArgumentException>(() => new PlayerEvent(PlayerEventKind.Left, 1, 1, "a\nb")).Message, StringComparison.Ordinal);
        Assert.Contains("surrogate", Assert.Throws<ArgumentException>(() => new PlayerEvent(PlayerEventKind.Left, 1, 1, "a\ud800")).Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentNullException>(() => new PlayerEvent(PlayerEventKind.Left, 1, 1, null!));
        Assert.Equal(64, new PlayerEvent(PlayerEventKind.Left, 254, ulong.MaxValue, new string('ä', 32), PeerRole.Bot).Name.Length * 2); // the control
    }

    /// <summary>The call is on the account of whom it is about; an event that nobody causes is on none.</summary>
    [Theory]
    [InlineData(3)]
    [InlineData(20)]
    public void Calls_ForAPlayer_AreChargedToThatPlayer(byte number)
    {
        LiveWorld world = new(Room(new GivenRules { Player = (_, _) => { } }), new SimulationOptions()) { Work = new WorkLedger() };
        for (uint n = 1; n <= 100; n++)
        {
            world.Submit(Said(PlayerEventKind.Joined + (byte)(n % 4), number, 0.01 * n, n));
        }

        for (double t = 0.01; t < 1.5; t += 0.01)
        {
            world.Step(At(t));
        }

        Assert.Equal(500, world.Work.ChargedTo(number), 1);
        Assert.Equal(0, world.Work.ChargedTo(0));
    }

    private static List<ExternalEvent> Drawn(Random draws)
    {
        List<ExternalEvent> events = [];
        PlayerEventKind[] next = new PlayerEventKind[4];
        double time = 0;
        for (uint n = 1; n <= 14; n++)
        {
            time += draws.Next(4) * 0.1; // some at one tick
            byte number = (byte)draws.Next(4);
            PlayerEventKind kind = next[number] switch
            {
                0 or PlayerEventKind.Left => PlayerEventKind.Joined,
                PlayerEventKind.Away => draws.Next(2) == 0 ? PlayerEventKind.Returned : PlayerEventKind.Left,
                _ => draws.Next(2) == 0 ? PlayerEventKind.Away : PlayerEventKind.Left,
            };
            next[number] = kind;
            events.Add(Said(kind, number, Math.Min(time, End - 0.2), n, draws.Next(2) == 0 ? "" : "Ann"));
            events.Add(PlayerAction.Impulse(BodyId.OfScene(draws.Next(3)), V(draws.NextDouble() - 0.5, draws.Next(3))).Stamp(At(draws.NextDouble() * (End - 0.2)), 1, n));
            events.Add(PlayerAction.Command(new GameCommand(1)).Stamp(At(Math.Min(time, End - 0.2)), 2, n));
        }

        return events;
    }

    private static ExternalEvent Said(
        PlayerEventKind kind, byte number, double seconds, uint sequence, string name = "", PeerRole role = PeerRole.Player) =>
        new PlayerEvent(kind, number, 1000u + number, name, role).Stamp(At(seconds), sequence);

    private static Scene Room(GivenRules rules)
    {
        SceneBuilder builder = new SceneBuilder("room").WithSmallestRadius(0.3).AddPlane("floor", Vector3D.Up, V(0), 0.8);
        for (int n = 0; n < 3; n++)
        {
            builder.AddBody($"ball {n}", Ball(0.3, 1 + n, 0.8), V(n - 1, 1 + n));
        }

        return builder.WithRules(rules).WithSeed(5).Build();
    }
}
