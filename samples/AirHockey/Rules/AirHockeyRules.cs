using System;
using LagSim;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace AirHockey;

/// <summary>Air hockey. A goal counts when the whole puck is behind the line; five goals win, or more of them after a minute.</summary>
public class AirHockeyRules : GameRules
{
    public const int Chat = 1, Again = 2; // commands
    private const int CountTimer = 1, EndTimer = 2, ServeTimer = 3, PrizeTimer = 4;
    private static readonly SimDuration Second = SimDuration.FromSeconds(1);

    public AirHockeyRules()
        : base("air hockey", version: 1)
    {
        WithWorldState<Match>();
        WithBodyState<PuckState>();
    }

    public override bool HearsContact(BodyId first, BodyId second, int surface) =>
        surface < 0 && Table.IsMallet(first) != Table.IsMallet(second);

    public override bool HearsCrossing(BodyId body, int sensor) => Table.IsMallet(body) == (sensor == Table.RightHalf);

    public override void OnStart(RuleWorld world)
    {
        ref Match match = ref world.State<Match>();
        (match.Left, match.Right, match.Phase, match.Count) = (0, 0, Phase.CountDown, 3);
        world.SetTimer(CountTimer, Second);
        world.Teleport(Table.Puck, Vector3D.Zero);
        world.SetFilter(Table.Puck, Table.PuckThatWaits);
    }

    public override void OnCommand(RuleWorld world, byte player, GameCommand command)
    {
        ref Match match = ref world.State<Match>();
        if (command.Number == Chat && command.Length <= ChatLine.MaxBytes)
        {
            (match.Chat, match.ChatFrom, match.Chats) = (default, player, match.Chats + 1);
            command.Data.CopyTo(match.Chat);
        }
        else if (command.Number == Again && match.Phase == Phase.Over && player < Table.PlayersOf(world.Scene))
        {
            OnStart(world);
        }
    }

    public override void OnContact(RuleWorld world, in RuleContact contact)
    {
        (BodyId mallet, BodyId other) = Table.IsMallet(contact.First) ? (contact.First, contact.Second) : (contact.Second, contact.First);
        if (!Table.IsPrize(world.SpecOf(other)))
        {
            world.State<PuckState>(other)[Table.SideOf(Table.PlayerOf(mallet))] = 1 + Table.PlayerOf(mallet);
        }
        else if (other.Packed == world.State<Match>().Prize) // two may touch it at one tick
        {
            Take(world, Table.PlayerOf(mallet), other);
        }
    }

    public override void OnCrossing(RuleWorld world, in Crossing crossing)
    {
        BodyId body = crossing.Body;
        int side = crossing.Sensor & 1;
        switch (crossing.Sensor)
        {
            case Table.RightHalf:
                world.SetFilter(body, Table.FilterOf(mallet: body, isRight: crossing.Entered));
                break;
            case Table.Mouths or Table.Mouths + 1:
                world.SetFilter(body, crossing.Entered && world.State<Match>().IsOpen(side) ? Table.PuckInMouth : Table.PuckOnTable);
                break;
            case Table.Goals or Table.Goals + 1 when crossing.Entered:
                Score(world, body, scorer: 1 - side);
                break;
            case Table.Inside when !crossing.Entered && body == Table.Puck: // a hand has squeezed it out
                Centre(world, Second);
                break;
        }
    }

    public override void OnTimer(RuleWorld world, int timer)
    {
        ref Match match = ref world.State<Match>();
        switch (timer)
        {
            case CountTimer when --match.Count > 0:
                world.SetTimer(CountTimer, Second);
                break;
            case CountTimer:
                (match.Phase, match.Ends) = (Phase.Play, (world.Elapsed + Match.Length).Ticks);
                world.Tell((int)Told.Begins);
                world.SetTimer(EndTimer, Match.Length);
                world.SetTimer(PrizeTimer, Second * 5);
                world.SetFilter(Table.Puck, Table.PuckOnTable);
                Centre(world, SimDuration.Zero);
                break;
            case EndTimer when match.IsDecided(world.Elapsed): // else the next goal wins
                End(world);
                break;
            case ServeTimer:
                if (world.TryRead(Table.Puck, out BodyState puck) && puck.Velocity.Length < Table.Slow)
                {
                    world.SetVelocity(Table.Puck, new Vector3D(world.Random(2) - 0.5, 0, world.RandomFraction() - 0.5));
                }

                world.SetTimer(ServeTimer, Second * 2); // it may lie still where nobody reaches it
                break;
            case PrizeTimer:
                EndPrize(world); // what the last one gave lasts until the next one appears
                BodySpec prize = Table.Prize((PrizeKind)world.Random(3));
                Vector3D place = Table.Somewhere(world.RandomFraction(), world.RandomFraction());
                match.Prize = world.Spawn(prize, place, players: PeerSet.Nobody, whenOccupied: WhenOccupied.Skip).Packed;
                world.SetTimer(PrizeTimer, Second * 8);
                break;
        }
    }

    /// <summary>The puck is in the middle, at rest, at this very tick; a while later it is served.</summary>
    private static void Centre(RuleWorld world, SimDuration serve)
    {
        world.Teleport(Table.Puck, Vector3D.Zero);
        world.SetTimer(ServeTimer, serve);
    }

    private static void Score(RuleWorld world, BodyId puck, int scorer)
    {
        ref Match match = ref world.State<Match>();
        if (match.Phase == Phase.Play)
        {
            match.Left += 1 - scorer;
            match.Right += scorer;
            int player = world.State<PuckState>(puck)[scorer] - 1;
            world.Tell((int)Told.Goal, new Goal(scorer, player, match.Left, match.Right).ToValue(), key: scorer);
        }

        world.State<PuckState>(puck) = default;
        if (puck == Table.Puck)
        {
            Centre(world, Second);
        }
        else
        {
            world.Remove(puck);
        }

        if (match.Phase == Phase.Play && match.IsDecided(world.Elapsed))
        {
            End(world);
        }
    }

    private static void Take(RuleWorld world, int player, BodyId prize)
    {
        ref Match match = ref world.State<Match>();
        PrizeKind kind = Table.KindOf(world.SpecOf(prize));
        world.Tell((int)Told.Prize, (long)kind + (16 * player), key: (long)kind);
        EndPrize(world);
        if (kind == PrizeKind.SecondPuck)
        {
            match.SecondPuck = world.Spawn(Table.PuckSpec, Vector3D.Zero, new Vector3D(0, 0, 0.7), players: PeerSet.Nobody).Packed;
        }
        else if (kind == PrizeKind.FastPuck && world.TryRead(Table.Puck, out BodyState puck))
        {
            world.SetVelocity(Table.Puck, puck.Velocity * 2);
        }
        else
        {
            match.Shielded = 1 + Table.SideOf(player);
        }
    }

    private static void EndPrize(RuleWorld world)
    {
        ref Match match = ref world.State<Match>();
        foreach (ulong body in (ReadOnlySpan<ulong>)[match.Prize, match.SecondPuck])
        {
            if (body != 0)
            {
                world.Remove(BodyId.FromPacked(body)); // does nothing if it is gone
            }
        }

        (match.Prize, match.SecondPuck, match.Shielded) = (0, 0, 0);
    }

    private static void End(RuleWorld world)
    {
        ref Match match = ref world.State<Match>();
        match.Phase = Phase.Over;
        world.Tell((int)Told.Won, match.Left > match.Right ? 0 : 1);
        EndPrize(world);
        world.CancelTimer(EndTimer);
        world.CancelTimer(PrizeTimer);
    }
}
