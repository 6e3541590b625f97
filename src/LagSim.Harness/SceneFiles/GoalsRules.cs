using System.Collections.Generic;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.SceneFiles;

/// <summary>The rules of the built-in scene <c>goals</c>: a count-down, goals, power-ups at random places, commands, a whistle.</summary>
/// <remarks>Sensor 0 of the scene is the goal on the left, 1 that on the right. All bodies of the scene are balls.</remarks>
public sealed class GoalsRules : ShownRules
{
    /// <summary>The command by which a player cheers; it carries nothing.</summary>
    public const int Cheer = 1;

    /// <summary>The command by which a player has a ball kicked; it carries one byte, the number of the ball.</summary>
    public const int Kick = 2;

    /// <summary>What is told of a goal: its value is the side that has it, 0 for left, and 1 for right.</summary>
    public const int GoalTold = 1;

    private const int CountDown = 1;
    private const int PowerUp = 2;
    private const int Whistle = 3;
    private const int FirstServe = 10; // a timer for each ball
    private const double Speed = 4;
    internal const double PowerUpRadius = 0.15;

    private static readonly SimDuration HalfSecond = SimDuration.FromSeconds(0.5);
    private static readonly BodySpec PowerUpSpec = new(PowerUpRadius, mass: 0.05, restitution: 0.5);

    /// <summary>The rules, of version 1.</summary>
    public GoalsRules()
        : base("goals", version: 1)
    {
        WithWorldState<GoalsState>();
        WithBodyState<GoalsBall>();
    }

    /// <inheritdoc/>
    public override bool HearsCrossing(BodyId body, int sensor) => sensor < 2 && body.Sequence == 0;

    /// <inheritdoc/>
    public override bool HearsContact(BodyId first, BodyId second, int surface) => surface < 0 && second.Peer == Peer;

    /// <inheritdoc/>
    public override void OnStart(RuleWorld world)
    {
        world.State<GoalsState>().CountDown = 2;
        world.SetTimer(CountDown, HalfSecond);
        world.SetTimer(Whistle, SimDuration.FromSeconds(60));
    }

    /// <inheritdoc/>
    public override void OnTimer(RuleWorld world, int timer)
    {
        ref GoalsState state = ref world.State<GoalsState>();
        switch (timer)
        {
            case CountDown when --state.CountDown > 0:
                world.SetTimer(CountDown, HalfSecond);
                break;
            case CountDown:
                for (int ball = 0; ball < world.Scene.Bodies.Count; ball++)
                {
                    KickOff(world, BodyId.OfScene(ball));
                }

                world.SetTimer(PowerUp, HalfSecond);
                break;
            case PowerUp when state.PowerUp == 0:
                Vector3D place = new((4 * world.RandomFraction()) - 2, PowerUpRadius, (4 * world.RandomFraction()) - 2);
                state.PowerUp = world.Spawn(PowerUpSpec, place, players: PeerSet.Nobody, whenOccupied: WhenOccupied.Beside).Packed;
                break;
            case Whistle:
                state.IsOver = 1;
                break;
            case >= FirstServe when timer - FirstServe < world.Scene.Bodies.Count:
                KickOff(world, BodyId.OfScene(timer - FirstServe));
                break;
        }
    }

    /// <inheritdoc/>
    public override void OnCrossing(RuleWorld world, in Crossing crossing)
    {
        ref GoalsState state = ref world.State<GoalsState>();
        if (!crossing.Entered || state.IsOver == 1)
        {
            return;
        }

        ref GoalsBall ball = ref world.State<GoalsBall>(crossing.Body);
        int worth = 1 + ball.IsDouble;
        ball.Goals += worth;
        ball.IsDouble = 0;
        state.Left += crossing.Sensor == 1 ? worth : 0;
        state.Right += crossing.Sensor == 0 ? worth : 0;
        state.LastGoalTicks = world.Elapsed.Ticks;
        world.Tell(GoalTold, 1 - crossing.Sensor, key: crossing.Sensor);
        Vector3D start = world.Scene.Bodies[crossing.Body.Index].Position;
        world.Teleport(crossing.Body, start, default, WhenOccupied.Beside);
        world.SetTimer(FirstServe + crossing.Body.Index, HalfSecond);
    }

    /// <inheritdoc/>
    public override void OnContact(RuleWorld world, in RuleContact contact)
    {
        ref GoalsState state = ref world.State<GoalsState>();
        if (contact.Second.Packed == state.PowerUp && contact.First.Sequence == 0)
        {
            world.State<GoalsBall>(contact.First).IsDouble = 1;
            state.PowerUp = 0;
            state.PowerUpsTaken++;
            world.Remove(contact.Second);
            world.SetTimer(PowerUp, SimDuration.FromMilliseconds(500 + world.Random(1000)));
        }
    }

    /// <inheritdoc/>
    public override void OnCommand(RuleWorld world, byte player, GameCommand command)
    {
        ref GoalsState state = ref world.State<GoalsState>();
        bool isCheer = command is { Number: Cheer, Length: 0 };
        bool isKick = command is { Number: Kick, Length: 1 } && command.Data[0] < world.Scene.Bodies.Count;
        if (state.IsOver == 1 || (!isCheer && !isKick))
        {
            state.Ignored++;
            return;
        }

        state.LastCommandTicks = world.Elapsed.Ticks;
        state.Cheers += isCheer ? 1 : 0;
        state.Kicks += isKick ? 1 : 0;
        if (isKick)
        {
            KickOff(world, BodyId.OfScene(command.Data[0]));
        }
    }

    /// <inheritdoc/>
    public override IReadOnlyList<KeyValuePair<string, double>> Show(Simulation world, SimTime time)
    {
        world.TryReadRules(time, out GoalsState state);
        return
        [
            new("left", state.Left), new("right", state.Right), new("count_down", state.CountDown), new("is_over", state.IsOver),
            new("power_up", state.PowerUp == 0 ? 0 : 1), new("power_ups_taken", state.PowerUpsTaken), new("cheers", state.Cheers),
            new("kicks", state.Kicks), new("ignored", state.Ignored), new("last_goal_s", SimDuration.FromTicks(state.LastGoalTicks).ToSeconds()),
            new("last_command_s", SimDuration.FromTicks(state.LastCommandTicks).ToSeconds()),
        ];
    }

    private static void KickOff(RuleWorld world, BodyId ball) => world.SetVelocity(
        ball, new Vector3D((world.Random(2) == 0 ? 1 : -1) * Speed, 0, (2 * Speed * world.RandomFraction()) - Speed));
}
