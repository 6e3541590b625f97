using System;
using LagSim;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;

namespace AirHockey;

/// <summary>A player that is no person. It sees what a screen would show, and moves a hand.</summary>
public sealed class Bot
{
    private const double Reach = 0.25; // how far behind the puck it gets before it strikes
    private readonly int player;
    private readonly int players;
    private readonly Random luck;
    private double aim; // where in the other's goal
    private double until;

    public Bot(int player, int players, int seed)
    {
        this.player = player;
        this.players = players;
        luck = new Random(seed * 16 + player); // one of a fixed seed is the same on every machine
    }

    private double Towards => Table.SideOf(player) == 0 ? 1 : -1;

    /// <summary>Where the hand should go now.</summary>
    /// <param name="snapshot">The newest render snapshot.</param>
    /// <param name="now">The time that a frame shows.</param>
    /// <param name="hand">Where the hand is.</param>
    /// <returns>The place, and how fast the hand should be there at most, in m/s.</returns>
    public (Vector3D Place, double Speed) Think(RenderSnapshot snapshot, SimTime now, Vector3D hand)
    {
        Vector3D home = Table.HomeOf(player, players);
        if (!TryFindPuck(snapshot, now, out BodyState puck))
        {
            return (home, 1);
        }

        if (now.ToSeconds() > until)
        {
            until = now.ToSeconds() + 0.5 + luck.NextDouble();
            aim = (luck.NextDouble() - 0.5) * 3 * Table.HalfMouth;
        }

        Vector3D at = puck.Position + (puck.Velocity * 0.08);
        bool isMine = at.X * Towards < 0.02 && IsNearest(snapshot, now, at, hand);
        if (!isMine || puck.Velocity.X * Towards < -1.5)
        {
            // Between the puck and the goal.
            double z = Math.Clamp(at.Z, -Table.HalfMouth, Table.HalfMouth) * 0.8;
            return (new Vector3D(home.X * 1.05, 0, Table.HomeOf(player, players).Z == 0 ? z : (z + home.Z) / 2), 2);
        }

        Vector3D goal = new(Towards * Table.HalfLength, 0, aim);
        Vector3D course = (goal - at) / (goal - at).Length;
        Vector3D behind = at - (course * Reach);
        double aside = Math.Abs(Vector3D.Cross(course, at - hand).Y);
        bool isBehind = (at - hand).X * Towards > Table.MalletRadius * 0.5 && aside < Table.MalletRadius;
        return isBehind ? (at + (course * 0.1), 2.2) : (Around(behind, at, hand), 1.8);
    }

    // Not through the puck, which it would drive into its own goal.
    private Vector3D Around(Vector3D behind, Vector3D puck, Vector3D hand)
    {
        bool isInFront = (hand.X - puck.X) * Towards > -Table.MalletRadius;
        double side = hand.Z > puck.Z ? 1 : -1;
        return isInFront ? new Vector3D(behind.X, 0, puck.Z + (side * 0.2)) : behind;
    }

    private bool TryFindPuck(RenderSnapshot snapshot, SimTime now, out BodyState nearest)
    {
        nearest = default;
        double least = double.PositiveInfinity;
        for (int n = 0; n < snapshot.BodyCount; n++)
        {
            BodyId body = snapshot.BodyAt(n);
            bool isPuck = snapshot.TagOf(body) == Table.PuckTag;
            if (isPuck && snapshot.TryRead(body, now, out BodyState state) && state.Position.X * Towards < least)
            {
                (least, nearest) = (state.Position.X * Towards, state);
            }
        }

        return least < double.PositiveInfinity;
    }

    private bool IsNearest(RenderSnapshot snapshot, SimTime now, Vector3D puck, Vector3D hand)
    {
        double mine = (hand - puck).Length;
        for (int mate = Table.SideOf(player); mate < players; mate += 2)
        {
            if (mate != player && snapshot.TryRead(Table.MalletOf(mate), now, out BodyState other) && (other.Position - puck).Length < mine)
            {
                return false;
            }
        }

        return true;
    }
}
