using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Play;

/// <summary>
/// Two to four peers of one session side by side, joined by simulated links, in virtual time: the caller says how much of it passes.
/// </summary>
/// <remarks>
/// <para>The first pane is the host. A person takes, moves and throws bodies in any pane; what others show is what the link and their
/// strategy make of it.</para>
/// <para>Deterministic: the same set-up, the same deeds and the same steps of time give the same bits on every runtime. Not
/// thread-safe, and nothing in it blocks.</para>
/// </remarks>
internal sealed class Playground
{
    /// <summary>The grid of instants at which the panes' hashes are compared.</summary>
    internal static readonly SimDuration HashGrid = SimDuration.FromSeconds(0.25);

    /// <summary>How far behind the newest instant the hashes of air hockey are: hands never let go there, so something is always under
    /// way, and a history is three seconds.</summary>
    private static readonly SimDuration HashesOfHandsBehind = SimDuration.FromSeconds(2.5);

    private const double OriginSeconds = 7200; // more than any clock is behind
    private const double Timeout = 60;

    private readonly VirtualRun run;
    private readonly List<Pane> panes = [];
    private readonly Truth truth;

    /// <summary>Lets all peers in, and begins the world.</summary>
    /// <exception cref="InvalidOperationException">The link is so bad that not all got in within a minute.</exception>
    internal Playground(PlaySetup setup)
    {
        Setup = setup;
        Scene = PlayScene.Named(setup.Scene, setup.Strategies.Count, setup.Seed);
        run = new VirtualRun(OriginSeconds, setup.Seed, CancellationToken.None);
        LinkProfile link = setup.Link.ToProfile();
        RuleNotices[] notices = [.. setup.Strategies.Select(_ => new RuleNotices())];
        for (int n = 0; n < setup.Strategies.Count; n++)
        {
            Add(n, setup.Strategies[n], n == 0 ? null : link, notices[n]);
            Await(pane => pane.Session.State is SessionState.Waiting or SessionState.Running); // one after another: the host numbers them as they come
        }

        Session host = panes[0].Session;
        Await(pane => pane.Session is { State: SessionState.Running, World: not null });

        truth = new Truth(Scene.Scene, host.World!.Simulation.Start);
        host.Logged += truth.Hear;
        foreach (Pane pane in panes.Where(_ => Scene.IsAirHockey))
        {
            pane.Player = new AirHockeyPlayer(pane.Session, action => Note(pane.Do(action)), setup.Seed);
            pane.Board = new AirHockeyBoard(pane.Session, notices[pane.Number]);
        }

        AdvanceTo(host.World.Simulation.Start);
    }

    /// <summary>The set-up that it was made with, with the link as it is now.</summary>
    internal PlaySetup Setup { get; private set; }

    /// <summary>What is simulated and drawn.</summary>
    internal PlayScene Scene { get; }

    /// <summary>The panes, the host first.</summary>
    internal IReadOnlyList<Pane> Panes => panes;

    /// <summary>The moment, in the time that the peers share.</summary>
    internal SimTime Now => panes[0].Session.SharedTime.Now;

    /// <summary>Seconds since the world began.</summary>
    internal double Seconds => (Now - panes[0].Session.World!.Simulation.Start).ToSeconds();

    /// <summary>Lets time pass, and finds what all panes draw then.</summary>
    /// <param name="virtualSeconds">How much time passes in the worlds; none while they are paused.</param>
    /// <param name="realSeconds">How much has passed for the person who looks.</param>
    internal void Advance(double virtualSeconds, double realSeconds)
    {
        run.AdvanceTo(run.Clock.Now + SimDuration.FromSeconds(virtualSeconds));
        panes.ForEach(pane => pane.Player?.Move());
        truth.AdvanceTo(panes.Max(p => p.Session.SharedTime.Now)); // clocks differ by what measuring them costs
        foreach (Pane pane in panes)
        {
            pane.Draw(truth, realSeconds);
        }
    }

    /// <summary>From now on the links are these. What is under way arrives as it would have.</summary>
    internal void SetLink(LinkSettings link)
    {
        LinkProfile profile = link.ToProfile();
        for (int n = 1; n < panes.Count; n++)
        {
            run.Network.Connect(n, 0, profile);
        }

        Setup = Setup with { Link = link };
    }

    /// <summary>A person takes the body at a point of a pane.</summary>
    /// <param name="pane">The pane's number.</param>
    /// <param name="x">The point, in metres of the view.</param>
    /// <param name="y">The point, in metres of the view.</param>
    /// <param name="reach">How far beside a body still counts, in metres.</param>
    /// <returns>Whether it is in the hand now.</returns>
    internal bool Grab(int pane, double x, double y, double reach) => Note(panes[pane].Grab(x, y, reach)) && panes[pane].IsHolding;

    /// <summary>The hand of a pane moves.</summary>
    /// <param name="pane">The pane's number.</param>
    /// <param name="x">Where it is, in metres of the view.</param>
    /// <param name="y">Where it is, in metres of the view.</param>
    /// <param name="velocityX">How fast it moves, in metres a second of the worlds.</param>
    /// <param name="velocityY">How fast it moves, in metres a second of the worlds.</param>
    internal void MoveHand(int pane, double x, double y, double velocityX, double velocityY) =>
        Note(panes[pane].MoveHand(x, y, velocityX, velocityY));

    /// <summary>The hand of a pane lets go, and throws at that velocity.</summary>
    internal void Release(int pane, double velocityX, double velocityY) => Note(panes[pane].Release(velocityX, velocityY));

    /// <summary>A player gives a body a velocity.</summary>
    /// <returns>Whether it could.</returns>
    internal bool Strike(in Stroke stroke) =>
        Note(panes[stroke.Pane].Strike(stroke.Body, stroke.VelocityX, stroke.VelocityY));

    /// <summary>The instants that every pane's world has, the oldest that is kept and the furthest that is precomputed, in seconds from
    /// now. A world at rest knows its future for good; there the look-ahead counts.</summary>
    internal (double Oldest, double Newest) Window()
    {
        (SimTime oldest, SimTime newest) = (SimTime.MinValue, Now + SimDuration.FromMilliseconds(Setup.LookAheadMilliseconds));
        foreach (Pane pane in panes)
        {
            Simulation world = pane.Session.World!.Simulation;
            (oldest, newest) = (SimTime.Max(oldest, world.HistoryEdge), SimTime.Min(newest, world.Horizon));
        }

        return ((oldest - Now).ToSeconds(), (newest - Now).ToSeconds());
    }

    /// <summary>Finds where all bodies are at another instant of the window; <see cref="Advance"/> draws the present again.</summary>
    /// <param name="seconds">The instant, in seconds from now. Outside of the window nothing is there.</param>
    internal void Scrub(double seconds)
    {
        SimTime time = Now + SimDuration.FromSeconds(seconds);
        foreach (Pane pane in panes)
        {
            pane.DrawAt(truth, time);
        }
    }

    /// <summary>Appends the paths of all bodies over the window, pane by pane; see <see cref="PathSampler.Append"/>.</summary>
    internal void AppendPaths(int count, bool withBounces, List<double> into)
    {
        (double oldest, double newest) = Window();
        foreach (Pane pane in panes)
        {
            pane.AppendPaths(Now + SimDuration.FromSeconds(oldest), Now + SimDuration.FromSeconds(newest), Now, (count, withBounces), into);
        }
    }

    /// <summary>The hashes of all panes and of the truth at the newest instant of the grid that all have; of air hockey at one 2.5 s
    /// before.</summary>
    /// <param name="hashes">Gets one for each pane, then that of the truth; null where there is none.</param>
    /// <returns>The instant, in seconds since the world began.</returns>
    internal double ReadHashes(Span<ulong?> hashes)
    {
        SimTime start = panes[0].Session.World!.Simulation.Start;
        SimDuration newest = Now - start - (Scene.IsAirHockey ? HashesOfHandsBehind : SimDuration.Zero);
        SimTime at = start + (HashGrid * Math.Max(0, newest.Ticks / HashGrid.Ticks));
        for (int n = 0; n < panes.Count; n++)
        {
            hashes[n] = panes[n].HashAt(at);
        }

        hashes[panes.Count] = truth.HashAt(at);
        return (at - start).ToSeconds();
    }

    /// <summary>The bytes that a pane's peer has sent so far, with UDP and IP headers.</summary>
    internal long BytesSent(int pane) => run.Network.Traffic(pane).BytesSent;

    /// <summary>The bytes that have come to a pane's peer so far, with UDP and IP headers.</summary>
    internal long BytesReceived(int pane) => run.Network.Traffic(pane).BytesReceived;

    private void Add(int number, LateEventStrategy strategy, LinkProfile? link, RuleNotices notices)
    {
        LatencyCompensationWindow window = new(SimDuration.FromSeconds(3), SimDuration.FromMilliseconds(Setup.LookAheadMilliseconds));
        foreach (EventKind kind in new[] { EventKind.Grab, EventKind.HoldKeyframe, EventKind.Release, EventKind.SetVelocity })
        {
            window = window.WithLocalLag(kind, SimDuration.FromMilliseconds(Setup.LocalLagMilliseconds));
        }

        HostOptions host = new()
        {
            Window = window, // and no early confirmation: the page looks at the whole of its history
            Strategy = strategy,
            ExpectedClients = Setup.Strategies.Count - 1,
            Warmup = false,
            RuleNotices = notices,
        };
        ClientOptions client = new()
        {
            Window = window,
            Strategy = strategy,
            Warmup = false,
            RuleNotices = notices,
            Rules = Scene.IsAirHockey ? [AirHockeyGame.NewRules()] : null,
        };
        (Session session, int place) = run.Open(
            number, link, 0, link?.ReceiverClockOffset ?? SimDuration.Zero,
            (port, clock) => number == 0
                ? new HostSession(Scene.Scene, port, clock, host, Setup.Seed)
                : new ClientSession(null, port, clock, client, VirtualRun.HostAddress, Setup.Seed + (ulong)number));
        panes.Add(new Pane(number, session, strategy, Scene, Setup.IsSmooth, () => run.Steps.Wake(place)));
    }

    /// <exception cref="InvalidOperationException">A player does not get so far.</exception>
    private void Await(Func<Pane, bool> isSoFar)
    {
        WaitEnd end = run.RunUntil(() => panes.All(isSoFar), () => panes.Any(pane => pane.Session.State == SessionState.Ended), Timeout);
        if (end != WaitEnd.Met)
        {
            IEnumerable<int> outside = panes.Where(pane => !isSoFar(pane)).Select(pane => pane.Number + 1);
            throw new InvalidOperationException($"Over that link not every player gets in; not in after a minute: player {string.Join(", ", outside)}.");
        }
    }

    private void AdvanceTo(SimTime shared)
    {
        if (shared > Now)
        {
            Advance((shared - Now).ToSeconds(), 0);
        }
    }

    private bool Note(ExternalEvent? done)
    {
        if (done is ExternalEvent did)
        {
            truth.Do(did);
        }

        return done is not null;
    }
}
