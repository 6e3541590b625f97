using System;
using System.Collections.Concurrent;
using System.Net;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Display;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Docs;

/// <summary>The code of the front pages, each as it stands there: <see cref="SnippetTests"/> holds the pages to it. That it compiles is part of the test.</summary>
internal sealed class Snippets(Scene scene, Action<Vector3D> show)
{
    internal void Bounce()
    {
        Scene scene = new SceneBuilder("bounce")
            .AddPlane("floor", normal: Vector3D.Up, point: Vector3D.Zero)
            .AddBody("ball", new BodySpec(radius: 0.5, mass: 1, restitution: 0.7), position: new Vector3D(0, 4, 0))
            .Build();
        BodyId ball = scene.BodyNamed("ball");

        using SimulationHost host = new(scene, new StopwatchClock());
        host.Start();

        // each frame; until the thread has made its first render snapshot there is nothing to read
        if (host.RenderSnapshot.TryRead(ball, host.Now, out BodyState state))
        {
            Draw(state.Position);
        }

        // a player kicks it: 6 N s upwards, now
        host.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0)));
    }

    internal Simulation HearLate(BodyId ball)
    {
        Simulation world = new(scene, new SimulationOptions(history: SimDuration.FromSeconds(2))); // how late an event may be; 1 s by default
        world.Healed += heal => Console.WriteLine($"{heal.Bodies} bodies rewound, {heal.Events} events re-simulated");
        world.AdvanceTo(SimTime.FromSeconds(3));

        // at 3 s a late event arrives: peer 1 kicked the ball at 2.2 s; it is the first thing that peer did
        ExternalEvent kick = PlayerAction.Impulse(ball, new Vector3D(0, 6, 0)).Stamp(SimTime.FromSeconds(2.2), peer: 1, sequence: 1);
        if (world.Submit(kick) == SubmitResult.TooOld)
        {
            throw new InvalidOperationException("It lies before the history; nothing has changed.");
        }

        world.AdvanceTo(SimTime.FromSeconds(3)); // to the bit what it would be if the event had come in time
        return world;
    }

    internal void Contacts()
    {
        ContactNotices contacts = new(minClosingSpeed: 0.2); // m/s; slower contacts are not reported
        using SimulationHost host = new(scene, new StopwatchClock(), contacts: contacts);
        host.Start();

        // each frame
        while (contacts.TryRead(out ContactNotice contact))
        {
            switch (contact.Kind)
            {
                case NoticeKind.Predicted or NoticeKind.Moved:
                    PlaySound(contact.Id, contact.Position, contact.ClosingSpeed, at: contact.Time); // one sound an Id: what has begun goes on
                    break;
                case NoticeKind.InDoubt or NoticeKind.Retracted or NoticeKind.Unresolved:
                    StopSound(contact.Id); // what has not begun does not begin
                    break;
                case NoticeKind.Confirmed:
                    Score(contact.First, contact.Second); // on the floor both are the ball; contact.Surface is the number of the surface, and -1 between two bodies
                    break;
            }
        }
    }

    internal void Losses()
    {
        LossNotices losses = new();
        using SimulationHost host = new(scene, new StopwatchClock(), losses: losses); // in a session: new HostOptions { Losses = losses }
        host.Start();

        // each frame
        while (losses.TryRead(out LossNotice loss))
        {
            if (loss.Kind == NoticeKind.Confirmed)
            {
                Console.WriteLine($"{scene.Describe(loss.Body)} is gone: {loss.Reason}, near {loss.Position}"); // the same on every machine
            }
        }
    }

    internal void Share(ConcurrentQueue<string> refusals)
    {
        // where the world is
        using PeerThread host = PeerThread.Host(scene, udpPort: 5000, new HostOptions { Unprotected = true }); // or a Protection: docs/SECURITY.md

        // up to sixteen others join, at any time; the scene comes from the host
        using PeerThread peer = PeerThread.Join(new IPEndPoint(IPAddress.Parse("192.0.2.1"), 5000));
        if (!peer.WaitUntilRunning(TimeSpan.FromSeconds(15)))
        {
            Console.Error.WriteLine(peer.Session.WhyNotRunning);
            return;
        }

        BodyId ball = peer.Session.Scene!.BodyNamed("ball");

        // each frame
        if (peer.Latest() is RenderSnapshot snapshot && snapshot.TryRead(ball, peer.Session.DisplayTime, out BodyState state))
        {
            Draw(state.Position);
        }

        // once: what is not allowed; called on the session's thread, so hand it on to your own
        peer.Refused += (action, why) => refusals.Enqueue($"{action.Kind}: {why.Message}");

        // the action shows here at once, and takes effect on every other machine at the same instant; it does nothing if the body is gone
        _ = peer.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0)));
    }

    internal void Spawn(PeerThread peer, ConcurrentQueue<RosterChange> changes, Vector3D position, Vector3D velocity)
    {
        // on host and clients alike: how this peer is called, and who comes and goes; called on the session's thread, so hand it on to your own
        using PeerThread host = PeerThread.Host(scene, udpPort: 5000, new HostOptions { Name = "Hedy", Unprotected = true }, setUp: session =>
            session.RosterChanged += change => changes.Enqueue(change));

        // each frame, or whenever you like: who is here, on any thread
        foreach (RosterMember one in peer.Session.Roster)
        {
            DrawName(one.Number, one.Name, isWatching: one.Role == PeerRole.Spectator, isSilent: one.SilentSince is not null);
        }

        // this player fires; the answer, which has the new body's identity, is there in a later frame
        Task<ExternalEvent> shot = peer.Do(PlayerAction.Spawn(new BodySpec(radius: 0.05, mass: 0.02, restitution: 0.5), position, velocity)).AsTask();

        // each frame
        BodyId? bullet = shot.IsCompletedSuccessfully ? shot.Result.Body : null;

        // each frame: draw all bodies, also those that players have spawned
        if (peer.Latest() is RenderSnapshot all)
        {
            for (int n = 0; n < all.BodyCount; n++)
            {
                BodyId body = all.BodyAt(n);
                if (all.TryRead(body, peer.Session.DisplayTime, out BodyState at))
                {
                    DrawBall(at.Position, all.RadiusOf(body), isOwn: body.Peer == peer.Session.Peer);
                }
            }
        }

        DrawBall(position, bullet?.Index ?? 0, isOwn: true);
    }

    internal static void Hold(PeerThread peer, BodyId ball, Vector3D hand, Vector3D handVelocity)
    {
        // the hand closes, 5 cm above the ball's centre
        _ = peer.Do(PlayerAction.Grab(ball, new Vector3D(0, 0.05, 0)));
        HandSender sender = new(ball);

        // each frame
        if (sender.TrySample(peer.Session.SharedTime.Now, hand, handVelocity, out PlayerAction keyframe))
        {
            _ = peer.Do(keyframe);
        }

        // the hand opens: a throw
        _ = peer.Do(PlayerAction.Release(ball, handVelocity));
    }

    internal void Smooth(PeerThread peer, BodyId ball)
    {
        DisplayOffsets display = new(peer.Session.Scene!);

        // each frame
        if (peer.Latest() is RenderSnapshot shown)
        {
            display.Update(shown, peer.Session.DisplayTime);
        }

        if (display.TryRead(ball, out DrawnBody drawn))
        {
            Draw(drawn.Position); // the world has it at drawn.State.Position; a late event moved it by drawn.Jump metres
        }
    }

    internal void Predict(PeerThread peer, SimTime sampledAt, Vector3D position, Vector3D velocity)
    {
        AdaptivePredictor hand = new();

        // when a sample comes
        hand.Add(sampledAt, position, velocity);

        // each frame
        if (hand.TryPredict(peer.Session.SharedTime.Now, out Vector3D at))
        {
            DrawHand(at);
        }
    }

    internal void Smallest()
    {
        Scene scene = new SceneBuilder("bounce")
            .AddPlane("floor", normal: Vector3D.Up, point: Vector3D.Zero)
            .AddBody("ball", new BodySpec(radius: 0.5, mass: 1, restitution: 0.7), position: new Vector3D(0, 4, 0))
            .Build();
        BodyId ball = scene.BodyNamed("ball");

        using PeerThread host = PeerThread.Host(scene, udpPort: 5000, new HostOptions { Unprotected = true }); // or a Protection: docs/SECURITY.md

        // on another machine, with the host's address in place of Loopback: a client gets the scene from the host
        using PeerThread client = PeerThread.Join(new IPEndPoint(IPAddress.Loopback, 5000));
        if (!client.WaitUntilRunning(TimeSpan.FromSeconds(15)))
        {
            throw new InvalidOperationException(client.Session.WhyNotRunning);
        }

        // each frame
        if (client.Latest() is RenderSnapshot snapshot && snapshot.TryRead(ball, client.Session.DisplayTime, out BodyState state))
        {
            Console.WriteLine(state.Position); // or draw it
        }

        // a kick: shows here at once, and takes effect on every other machine at the same instant
        _ = client.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0)));
    }

    internal void Polled(BodyId ball)
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Any, 5000));
        HostSession session = new(scene, port, new StopwatchClock(), new HostOptions(), Session.DrawNumber());

        // each frame
        session.Step();
        if (session.World?.RenderSnapshots.Latest() is RenderSnapshot snapshot && snapshot.TryRead(ball, session.DisplayTime, out BodyState state))
        {
            Draw(state.Position);
        }

        // at the end
        session.Leave();
    }

    internal void PolledClient(BodyId ball)
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Any, 0));
        ClientSession session = new(
            null, port, new StopwatchClock(), new ClientOptions { Name = "Ann" }, PeerAddress.From(new IPEndPoint(IPAddress.Parse("192.0.2.1"), 5000)),
            Session.DrawNumber());
        session.RosterChanged += change => ShowMessage($"{change}"); // in your frame, by Step: it may touch anything of the game

        // each frame
        session.Step(); // receives, sends, simulates; never waits
        if (session.World?.RenderSnapshots.Latest() is RenderSnapshot snapshot && snapshot.TryRead(ball, session.DisplayTime, out BodyState state))
        {
            Draw(state.Position);
        }

        if (session.State == SessionState.Running)
        {
            session.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0))); // at once; throws if it is not allowed
        }

        // at the end
        session.Leave();
    }

    internal static HostOptions Early()
    {
        HostOptions options = new() { ConfirmsEarly = true, Window = new LatencyCompensationWindow(history: SimDuration.FromMilliseconds(800)) };
        return options;
    }

    internal static HostOptions Capped()
    {
        HostOptions options = new() { MaxBytesPerSecond = 16_000, Timeout = SimDuration.FromSeconds(10) };
        return options;
    }

    internal static HostOptions Tuned()
    {
        HostOptions options = new()
        {
            Window = new LatencyCompensationWindow(history: SimDuration.FromMilliseconds(400), lookAhead: SimDuration.FromMilliseconds(50))
                .WithLocalLag(EventKind.Impulse, SimDuration.FromMilliseconds(40)),
        };
        return options;
    }

    internal void ShareOfThePackage()
    {
        // one machine; others reach it at UDP port 5000
        using PeerThread host = PeerThread.Host(scene, udpPort: 5000, new HostOptions { Unprotected = true }); // or a Protection: docs/SECURITY.md

        // the others, at any time; the scene comes from the host
        using PeerThread peer = PeerThread.Join(new IPEndPoint(IPAddress.Parse("192.0.2.1"), 5000));
        if (!peer.WaitUntilRunning(TimeSpan.FromSeconds(10)))
        {
            Console.Error.WriteLine(peer.Session.WhyNotRunning);
        }

        BodyId ball = peer.Session.Scene!.BodyNamed("ball");

        // each frame
        if (peer.Latest() is RenderSnapshot snapshot && snapshot.TryRead(ball, peer.Session.DisplayTime, out BodyState state))
        {
            Draw(state.Position);
        }

        // what this player does
        _ = peer.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0)));
    }

    private void Draw(Vector3D place) => show(place);

    private void DrawBall(Vector3D place, double radius, bool isOwn) => show(isOwn ? place * radius : place);

    private void ShowMessage(string text) => show(new Vector3D(text.Length, 0, 0));

    private void DrawName(byte number, string name, bool isWatching, bool isSilent) =>
        show(new Vector3D(number, name.Length, isWatching || isSilent ? 1 : 0));

    private void DrawHand(Vector3D place) => show(place);

    private void PlaySound(long id, Vector3D place, double speed, SimTime at) => show(place * (id + speed + at.ToSeconds()));

    private void StopSound(long id) => show(new Vector3D(id, 0, 0));

    private void Score(BodyId first, BodyId second) => show(new Vector3D(first.Index, second.Index, 0));
}
