using System;
using AirHockey;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Display;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Play;

/// <summary>One player of air hockey: it moves the mallet of its peer by keys, a pointer or a bot.</summary>
/// <remarks>
/// <para>For a peer of any session of the game, simulated or not: it needs the session, and a way to act. Each frame calls
/// <see cref="Move"/>, then <see cref="ShowHand"/>. What it sees is an <see cref="AirHockeyBoard"/>.</para>
/// <para>Points are seen from above, in metres: x to the right, y up. Not thread-safe.</para>
/// </remarks>
internal sealed class AirHockeyPlayer
{
    /// <summary>How fast a key moves the mallet, in metres a second of the world, whatever the direction.</summary>
    internal const double KeySpeed = 1.5;

    /// <summary>How fast the mallet follows a pointer at most, in metres a second of the world.</summary>
    internal const double PointerSpeed = 5;

    private const double BeforeTheHand = 0.06; // seconds: a hand slows down only where it is closer to its aim than 0.05

    private readonly Session session;
    private readonly Action<PlayerAction> act;
    private readonly Hand hand;
    private readonly Bot bot;
    private (double X, double Y) way; // of keys, of length 1 or 0
    private Vector3D? aim; // of a pointer

    /// <summary>Begins to play.</summary>
    /// <param name="session">The session, which runs.</param>
    /// <param name="act">Does an action in the session; what the session refuses is lost.</param>
    /// <param name="seed">What a bot's luck begins with.</param>
    /// <exception cref="ArgumentException">The peer has no mallet.</exception>
    internal AirHockeyPlayer(Session session, Action<PlayerAction> act, ulong seed = 1)
    {
        (this.session, this.act) = (session, act);
        int players = Table.PlayersOf(session.Scene!);
        Number = AirHockeyGame.PlayerAt(session.Scene!, session.Peer)
            ?? throw new ArgumentException($"Peer {session.Peer} has no mallet at a table of {players}.", nameof(session));
        hand = new Hand(Number, players, session.Peer);
        bot = new Bot(Number, players, (int)(seed % (1 << 24)));
    }

    /// <summary>Its number, from 0. Even ones have the left side.</summary>
    internal int Number { get; }

    /// <summary>Whether a bot moves the mallet. Who takes a key or the pointer takes over.</summary>
    internal bool IsBot { get; set; }

    /// <summary>Keys are down that move the mallet this way, each -1, 0 or 1; both 0 for none.</summary>
    /// <exception cref="ArgumentOutOfRangeException">A part of the way is beyond -1 to 1.</exception>
    internal void Steer(double x, double y)
    {
        if (!(Math.Abs(x) <= 1 && Math.Abs(y) <= 1))
        {
            throw new ArgumentOutOfRangeException(nameof(x), $"The way ({x}, {y}) must have parts from -1 to 1.");
        }

        double length = Math.Sqrt((x * x) + (y * y));
        way = length > 0 ? (x / length, y / length) : (0, 0);
        IsBot &= length == 0;
    }

    /// <summary>A pointer is down at a point: the mallet follows it, within its own half.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The point is not finite.</exception>
    internal void Aim(double x, double y)
    {
        if (!(double.IsFinite(x) && double.IsFinite(y)))
        {
            throw new ArgumentOutOfRangeException(nameof(x), $"The point ({x}, {y}) must be finite.");
        }

        aim = AirHockeyGame.FromView(x, y);
        IsBot = false;
    }

    /// <summary>The pointer is up: the mallet stays where it is.</summary>
    internal void EndAim() => aim = null;

    /// <summary>Asks for another match once this one is over.</summary>
    internal void PlayAgain() => act(PlayerAction.Command(new GameCommand(AirHockeyRules.Again)));

    /// <summary>A frame: the mallet moves on, in the time that the peers share.</summary>
    internal void Move()
    {
        if (session.World is not LiveWorld world)
        {
            return;
        }

        RenderSnapshot snapshot = world.RenderSnapshots.Latest();
        SimTime now = session.SharedTime.Now;
        (Vector3D place, double speed) = aim is Vector3D point ? (point, PointerSpeed)
            : way != default ? (hand.At + (AirHockeyGame.FromView(way.X, way.Y) * (KeySpeed * BeforeTheHand)), KeySpeed)
            : IsBot ? bot.Think(snapshot, now, hand.At)
            : (hand.At, 0);
        hand.Move(snapshot, now, place, speed, act);
    }

    /// <summary>A frame: has the own mallet drawn exactly where the hand is.</summary>
    /// <param name="display">Where bodies are drawn.</param>
    internal void ShowHand(DisplayOffsets display) => display.SetHand(Table.MalletOf(Number), session.Peer, hand.At);
}
