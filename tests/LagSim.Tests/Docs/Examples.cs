using System;
using System.Net;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Display;
using LagSim.Net.Sessions;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Docs;

/// <summary>
/// The examples in the comments of the types met first, each as it stands there: <see cref="SnippetTests"/> holds the comments to it.
/// </summary>
internal static class Examples
{
    internal static Scene BuildScene()
    {
        Scene scene = new SceneBuilder("bounce")
            .AddPlane("floor", normal: Vector3D.Up, point: Vector3D.Zero, friction: 0.4)
            .AddBody("ball", new BodySpec(radius: 0.5, mass: 1, restitution: 0.7), position: new Vector3D(0, 4, 0))
            .Build();

        return scene;
    }

    internal static void Simulate(Scene scene, BodyId ball)
    {
        Simulation world = new(scene);
        world.AdvanceTo(SimTime.FromSeconds(2));
        ExternalEvent kick = PlayerAction.Impulse(ball, new Vector3D(0, 6, 0)).Stamp(SimTime.FromSeconds(1.5), peer: 1, sequence: 1);
        world.Submit(kick);
        world.AdvanceTo(SimTime.FromSeconds(2)); // as if the kick had come in time, to the last bit
        if (world.TryRead(ball, SimTime.FromSeconds(2), out BodyState state))
        {
            Console.WriteLine($"{state.Position} {world.StateHash(SimTime.FromSeconds(2)):x16}");
        }
    }

    internal static BodySpec Ball()
    {
        BodySpec football = new(radius: 0.11, mass: 0.43, restitution: 0.7, friction: 0.6, rollingResistance: 0.02);

        return football;
    }

    internal static void Act(PeerThread me, BodyId ball)
    {
        _ = me.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0))); // 6 N s upwards
        _ = me.Do(PlayerAction.Teleport(ball, new Vector3D(0, 4, 0), Vector3D.Zero));
    }

    internal static void RunAlone(Scene scene, BodyId ball)
    {
        using SimulationHost host = new(scene, new StopwatchClock());
        host.Start();
        host.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0)));
        if (host.RenderSnapshot.TryRead(ball, host.Now, out BodyState state))
        {
            Console.WriteLine($"height {state.Position.Y:F2} m");
        }
    }

    internal static void Hear(Scene scene)
    {
        ContactNotices contacts = new(minClosingSpeed: 0.2); // m/s
        using PeerThread host = PeerThread.Host(scene, options: new HostOptions { Contacts = contacts, Unprotected = true });
        int score = 0;

        // each frame
        while (contacts.TryRead(out ContactNotice contact))
        {
            score += contact.Kind == NoticeKind.Confirmed ? 1 : 0;
        }
    }

    internal static int Told(Scene scene)
    {
        int goals = 0;
        RuleNotices notices = new();
        using PeerThread host = PeerThread.Host(scene, options: new HostOptions { RuleNotices = notices, Unprotected = true });

        // each frame
        while (notices.TryRead(out RuleEvent told))
        {
            goals += told.Kind == NoticeKind.Confirmed && told.Notice.Code == 1 ? 1 : 0;
        }

        return goals;
    }

    internal static void Count(Scene scene)
    {
        CrossingNotices crossings = new();
        using PeerThread host = PeerThread.Host(scene, options: new HostOptions { Crossings = crossings, Unprotected = true });
        int goal = scene.SensorNamed("goal");
        int score = 0;

        // each frame
        while (crossings.TryRead(out CrossingNotice crossing))
        {
            score += crossing.Kind == NoticeKind.Confirmed && crossing.Sensor == goal && crossing.Entered ? 1 : 0;
        }
    }

    internal static void Replace(Scene scene)
    {
        LossNotices losses = new();
        using PeerThread host = PeerThread.Host(scene, options: new HostOptions { Losses = losses, Unprotected = true });

        // each frame
        while (losses.TryRead(out LossNotice loss))
        {
            if (loss.Kind == NoticeKind.Confirmed)
            {
                _ = host.Do(PlayerAction.Spawn(new BodySpec(0.1, 1, 0.5), new Vector3D(0, 1, 0)));
            }
        }
    }

    internal static void Smooth(PeerThread me, BodyId ball)
    {
        DisplayOffsets display = new(me.Session.Scene!);

        // each frame
        if (me.Latest() is RenderSnapshot snapshot)
        {
            display.Update(snapshot, me.Session.DisplayTime);
        }

        if (display.TryRead(ball, out DrawnBody drawn))
        {
            Console.WriteLine($"drawn at {drawn.Position}, in truth at {drawn.State.Position}");
        }
    }

    internal static void HostIt(Scene scene)
    {
        HostOptions options = new()
        {
            ConnectKey = "correct horse battery staple",
            ExpectedClients = 2,
            Window = new LatencyCompensationWindow(history: SimDuration.FromMilliseconds(400)),
            Unprotected = true, // or a Protection
        };
        using PeerThread host = PeerThread.Host(scene, udpPort: 5000, options, setUp: session =>
            session.ClientCame += link => Console.WriteLine($"player {link.Peer} is in"));
    }

    internal static void JoinIt(IPEndPoint address, PlayerPass pass)
    {
        ClientOptions options = new() { ConnectKey = "correct horse battery staple", Pass = pass };
        using PeerThread client = PeerThread.Join(address, options, setUp: session =>
            session.PassGiven += given => Console.WriteLine($"player {given.Number}"));
    }

    internal static void Play(Scene scene, BodyId ball, bool isHost)
    {
        using PeerThread me = isHost
            ? PeerThread.Host(scene, udpPort: 5000, new HostOptions { Unprotected = true }) // or with a Protection
            : PeerThread.Join(new IPEndPoint(IPAddress.Loopback, 5000));
        me.Refused += (action, why) => Console.Error.WriteLine($"{action.Kind}: {why.Message}");
        me.WaitUntilRunning(TimeSpan.FromSeconds(5));
        _ = me.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0))); // 6 N s upwards
        if (me.Latest() is RenderSnapshot snapshot && snapshot.TryRead(ball, me.Session.DisplayTime, out BodyState state))
        {
            Console.WriteLine($"height {state.Position.Y:F2} m");
        }
    }
}

public sealed class Squash : GameRules
{
    public Squash() : base("squash", version: 1) => WithWorldState<SquashScore>();

    public override bool HearsContact(BodyId first, BodyId second, int surface) => surface == 0;

    public override void OnStart(RuleWorld world) => world.SetTimer(1, SimDuration.FromSeconds(60));

    public override void OnContact(RuleWorld world, in RuleContact contact) => world.State<SquashScore>().Hits++;

    public override void OnTimer(RuleWorld world, int timer) => world.State<SquashScore>().IsOver = 1;
}

/// <summary>The state of <see cref="Squash"/>.</summary>
public struct SquashScore
{
    public int Hits;
    public int IsOver;
}
