using System;
using LagSim;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

namespace AirHockey;

/// <summary>The hand of a person or a bot: it takes the mallet, moves it within its half, and takes it again if it has lost it.</summary>
public sealed class Hand
{
    private const double GrabAgain = 1; // seconds
    private readonly int player;
    private readonly byte peer;
    private readonly HandSender sender;
    private SimTime last = SimTime.MinValue;
    private SimTime grabbed = SimTime.MinValue;
    private bool holds;

    /// <param name="player">Whose hand it is.</param>
    /// <param name="players">How many play.</param>
    /// <param name="peer">The peer that it acts at.</param>
    public Hand(int player, int players, byte peer)
    {
        (this.player, this.peer) = (player, peer);
        At = Table.HomeOf(player, players);
        sender = new HandSender(Table.MalletOf(player));
    }

    /// <summary>Where it is.</summary>
    public Vector3D At { get; private set; }

    /// <summary>A frame: the hand moves on towards a place.</summary>
    /// <param name="snapshot">The newest render snapshot.</param>
    /// <param name="now">The time, shared by all.</param>
    /// <param name="place">Where to.</param>
    /// <param name="speed">How fast at most, in m/s.</param>
    /// <param name="act">Does an action in the session.</param>
    public void Move(RenderSnapshot snapshot, SimTime now, Vector3D place, double speed, Action<PlayerAction> act)
    {
        BodyId mallet = Table.MalletOf(player);
        if (!snapshot.TryRead(mallet, now, out BodyState state) || now <= last)
        {
            return;
        }

        if (!snapshot.TryReadHold(mallet, now, out Hold hold) || hold.Peer != peer)
        {
            if (!holds || (now - grabbed).ToSeconds() > GrabAgain)
            {
                At = InReach(state.Position);
                act(PlayerAction.Grab(mallet));
                (holds, grabbed) = (true, now);
            }
        }

        double passed = last == SimTime.MinValue ? 0 : Math.Min((now - last).ToSeconds(), 0.1);
        last = now;
        Vector3D way = InReach(place) - At;
        double pace = Math.Min(way.Length / 0.05, speed);
        Vector3D velocity = way.Length < 1e-6 ? Vector3D.Zero : way * (pace / way.Length);
        At = InReach(At + (velocity * passed));
        if (sender.TrySample(now, At, velocity, out PlayerAction keyframe))
        {
            act(keyframe);
        }
    }

    private Vector3D InReach(Vector3D place) => InReach(player, place);

    /// <summary>The nearest place that is in the half of the player and within the walls.</summary>
    public static Vector3D InReach(int player, Vector3D place)
    {
        const double Margin = Table.MalletRadius + 0.005;
        const double FromLine = Table.MalletRadius + Table.PuckRadius; // two hands on either side of a puck leave it room
        bool isBeyond = (place.X > 0) != (Table.SideOf(player) == 1);
        double x = isBeyond ? FromLine : Math.Clamp(Math.Abs(place.X), FromLine, Table.HalfLength - Margin);
        double z = Math.Clamp(place.Z, -Table.HalfWidth + Margin, Table.HalfWidth - Margin);

        // In a corner, within the circle that its walls touch.
        (double inX, double inZ) = (x - (Table.HalfLength - Table.CornerRadius), Math.Abs(z) - (Table.HalfWidth - Table.CornerRadius));
        double out2 = Math.Sqrt((inX * inX) + (inZ * inZ));
        if (inX > 0 && inZ > 0 && out2 > Table.CornerRadius - Margin)
        {
            double shrink = (Table.CornerRadius - Margin) / out2;
            x = Table.HalfLength - Table.CornerRadius + (inX * shrink);
            z = Math.Sign(z) * (Table.HalfWidth - Table.CornerRadius + (inZ * shrink));
        }

        return new Vector3D(Table.SideOf(player) == 1 ? x : -x, 0, z);
    }
}
