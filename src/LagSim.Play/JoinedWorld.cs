using System;
using System.Collections.Generic;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Display;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Play;

/// <summary>One peer of a real session, as the person at its page sees it.</summary>
/// <remarks>It has no thread: the caller steps it, at the latest when <see cref="Step"/> said, and asks for a frame when one is drawn. Not
/// thread-safe, and nothing in it blocks.</remarks>
internal sealed class JoinedWorld : IDisposable
{
    /// <summary>How many committed states wait to be taken; older ones are lost.</summary>
    internal const int MaxCommits = 1024;

    private readonly IDatagramPort port;
    private readonly RuleNotices notices = new();
    private readonly Queue<(double Seconds, CommittedState State)> commits = new();
    private readonly List<JoinedBody> bodies = [];
    private readonly RewrittenGlow glow = new();
    private HandOfPerson? hand;
    private DisplayOffsets? display;
    private LiveWorld? watched;
    private HealTotals healed;
    private double shownSeconds;

    /// <summary>Asks to be let in, from the first step on.</summary>
    /// <param name="port">The carrier, which is disposed with it.</param>
    /// <param name="host">The host's address.</param>
    /// <param name="options">How to take part; the game's rules and notices are added.</param>
    /// <param name="clock">This machine's clock.</param>
    internal JoinedWorld(IDatagramPort port, PeerAddress host, ClientOptions options, IClock clock)
    {
        this.port = port;
        options = options with { Rules = AirHockeyGame.AllRules(), RuleNotices = notices };
        Session = new ClientSession(null, port, clock, options, host, Net.Sessions.Session.DrawNumber());
        Session.StateCommitted += Keep;
    }

    /// <summary>The peer.</summary>
    internal ClientSession Session { get; }

    /// <summary>Whether the host did not let it in because it asks for another key.</summary>
    internal bool IsKeyWrong => Session.RefusedFor == RefusalReason.WrongKey;

    /// <summary>What a step threw, which no session does but by a mistake in its code; null if none did. It is not stepped any more
    /// then.</summary>
    internal Exception? Failure { get; private set; }

    /// <summary>Whether it is over: its session has ended, or it failed.</summary>
    internal bool HasEnded => Failure is not null || Session.State == SessionState.Ended;

    /// <summary>Why it is over, as a sentence; null while it goes on.</summary>
    internal string? EndReason =>
        Failure is Exception thrown ? $"This peer cannot go on, by a mistake in its code. {thrown.Message}" : Session.EndReason;

    /// <summary>What is drawn; null until the host has sent its scene.</summary>
    internal PlayScene? View => hand?.Scene;

    /// <summary>Its player, in a game of air hockey; null in any other scene, and for who only looks on.</summary>
    internal AirHockeyPlayer? Player { get; private set; }

    /// <summary>What it sees of the match, in a game of air hockey, whether it plays or only looks on; null in any other scene.</summary>
    internal AirHockeyBoard? Board { get; private set; }

    /// <summary>The number that its player and its hand act by; 0 before there are any. See <see cref="HandOfPerson.Peer"/>.</summary>
    internal byte Peer => hand?.Peer ?? 0;

    /// <summary>The bodies that there are (in a game of air hockey those of the table alone; the board has the rest), where they are drawn,
    /// in their canonical order.</summary>
    internal IReadOnlyList<JoinedBody> Bodies => bodies;

    /// <summary>How many events heals have simulated again.</summary>
    internal long EventsRerun => healed.Events;

    /// <summary>How many bodies heals have predicted again.</summary>
    internal long BodiesRewound => healed.Bodies;

    /// <summary>Counts how often there were other bodies than before.</summary>
    internal int BodiesVersion { get; private set; }

    /// <summary>Whether a person holds a body here.</summary>
    internal bool IsHolding => hand?.IsHolding == true;

    /// <summary>Seconds since the world began; 0 before.</summary>
    internal double Seconds => Session.World is LiveWorld world ? (Session.SharedTime.Now - world.Simulation.Start).ToSeconds() : 0;

    /// <summary>Does what is due.</summary>
    /// <returns>How long until something is due again, unless a datagram or the person comes first.</returns>
    /// <remarks>Nothing is thrown: its callers are timers and sockets, where nobody would see it. See <see cref="Failure"/>.</remarks>
    internal SimDuration Step()
    {
        try
        {
            return HasEnded ? SimDuration.FromSeconds(1) : Session.Step();
        }
        catch (Exception thrown) when (thrown is not OutOfMemoryException)
        {
            Failure = thrown;
            return SimDuration.FromSeconds(1);
        }
    }

    /// <summary>Finds what is drawn now.</summary>
    /// <param name="seconds">How much real time has passed since the last frame.</param>
    internal void Draw(double seconds)
    {
        long before = Identity();
        bodies.Clear();
        shownSeconds += seconds;
        if (Session.World is not LiveWorld world || world.RenderSnapshots.Latest() is not RenderSnapshot snapshot)
        {
            return;
        }

        Watch(world);
        PlayScene view = View!;
        Player?.Move();
        display!.Update(snapshot, Session.DisplayTime);
        Player?.ShowHand(display);
        Board?.Look(display);
        for (int n = 0; n < snapshot.BodyCount; n++)
        {
            BodyId body = snapshot.BodyAt(n);
            if ((view.IsAirHockey && body.Sequence > 0) || !display.TryRead(body, out DrawnBody drawn))
            {
                continue;
            }

            double shine = glow.Of(body, drawn.Jump > 0, shownSeconds);
            bodies.Add(new JoinedBody(body, view.ToView(drawn.Position), snapshot.RadiusOf(body), shine, drawn.IsInHand));
        }

        BodiesVersion += Identity() == before ? 0 : 1;
    }

    /// <summary>The person takes the body that is drawn at a point, or close by.</summary>
    /// <param name="x">The point, in metres of the view.</param>
    /// <param name="y">The point, in metres of the view.</param>
    /// <param name="reach">How far beside a body still counts, in metres.</param>
    /// <returns>Whether it is in the hand now.</returns>
    internal bool Grab(double x, double y, double reach)
    {
        JoinedBody? nearest = null;
        double least = reach;
        foreach (JoinedBody body in bodies)
        {
            double dx = body.Place.X - x, dy = body.Place.Y - y;
            double gap = Math.Sqrt((dx * dx) + (dy * dy)) - body.Radius;
            (nearest, least) = gap <= least ? (body, gap) : (nearest, least);
        }

        return nearest is JoinedBody found && hand?.Take(found.Body) is not null;
    }

    /// <summary>The hand moves; see <see cref="HandOfPerson.Move"/>.</summary>
    internal void MoveHand(double x, double y, double velocityX, double velocityY) => hand?.Move(display!, x, y, velocityX, velocityY);

    /// <summary>The hand lets go; see <see cref="HandOfPerson.Release"/>.</summary>
    internal void Release(double velocityX, double velocityY) => hand?.Release(display!, velocityX, velocityY);

    /// <summary>The oldest committed state that was not taken yet, with its time in seconds since its world began.</summary>
    internal bool TryTakeCommit(out double seconds, out CommittedState state)
    {
        bool any = commits.TryDequeue(out (double Seconds, CommittedState State) oldest);
        (seconds, state) = oldest;
        return any;
    }

    /// <summary>Leaves, and closes the port.</summary>
    public void Dispose()
    {
        Session.Leave();
        port.Dispose();
    }

    private long Identity()
    {
        HashCode all = new();
        foreach (JoinedBody body in bodies)
        {
            all.Add(body.Body);
        }

        return all.ToHashCode();
    }

    private void Keep(CommittedState state)
    {
        // By the world that it is of: when it is taken, another session may have begun.
        commits.Enqueue(((state.Time - Session.World!.Simulation.Start).ToSeconds(), state));
        if (commits.Count > MaxCommits)
        {
            commits.Dequeue();
        }
    }

    /// <summary>The peer has a number, its first or another than before: makes its hand and its player for that number.</summary>
    private void TakeNumber()
    {
        HandOfPerson hand = new(Session, PlayScene.Of(Session.Scene!), () => Step());
        this.hand = hand;
        bool plays = hand.Scene.IsAirHockey && AirHockeyGame.PlayerAt(Session.Scene!, Peer) is not null;
        Player = plays ? new AirHockeyPlayer(Session, action => hand.Do(action)) : null;
        BodiesVersion++;
    }

    /// <summary>A peer that has got a fresh copy has another world.</summary>
    private void Watch(LiveWorld world)
    {
        if (ReferenceEquals(watched, world))
        {
            return;
        }

        // A host that was started again has a time and perhaps a scene of its own.
        bool isOtherSession = watched?.Simulation.Start != world.Simulation.Start;
        if (isOtherSession || Peer != Session.Peer)
        {
            TakeNumber();
        }

        if (isOtherSession)
        {
            Board = View!.IsAirHockey ? new AirHockeyBoard(Session, notices) : null;
        }

        watched = world;
        display = new DisplayOffsets(Session.Scene!);
        glow.Clear();
        world.Simulation.Healed += heal => healed = healed.And(heal);
    }
}

/// <summary>A body of a joined world, as it is drawn.</summary>
/// <param name="Body">The body.</param>
/// <param name="Place">Where its centre is drawn, in metres of the view.</param>
/// <param name="Radius">Its radius, in metres.</param>
/// <param name="Glow">How much it glows because its path was rewritten, 0 to 1.</param>
/// <param name="IsInHand">Whether it is drawn in the hand of a person.</param>
internal readonly record struct JoinedBody(BodyId Body, (double X, double Y) Place, double Radius, double Glow, bool IsInHand);
