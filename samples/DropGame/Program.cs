// A game loop in the console, from the LagSim packages alone. Two players, one ball: space (or the bot) lifts it.
//   dotnet run --project samples/DropGame                       a host and a bot that joins it, in one process
//   dotnet run --project samples/DropGame -- host 5000          a host for other machines
//   dotnet run --project samples/DropGame -- join 127.0.0.1:5000
using System;
using System.Collections.Generic;
using System.Net;
using System.Threading;
using LagSim;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

const int FramesPerSecond = 30, DemoSeconds = 6, Rows = 16;

Scene scene = new SceneBuilder("drop game")
    .AddPlane("floor", Vector3D.Up, Vector3D.Zero)
    .AddPlane("west", new Vector3D(1, 0, 0), new Vector3D(-8, 0, 0))
    .AddPlane("east", new Vector3D(-1, 0, 0), new Vector3D(8, 0, 0))
    .AddBody("ball", new BodySpec(radius: 0.5, mass: 1, restitution: 0.8), new Vector3D(0, 10, 0), new Vector3D(3, 0, 0))
    .AddBody("rock", new BodySpec(radius: 0.8, mass: 5, restitution: 0.5), new Vector3D(4, 0.8, 0))
    .Build();
BodyId ball = scene.BodyNamed("ball"), rock = scene.BodyNamed("rock");

List<PeerThread> peers = [];
try
{
    if (args is ["join", string address] && IPEndPoint.TryParse(address, out IPEndPoint? there))
    {
        peers.Add(PeerThread.Join(there));
    }
    else if (args is [] || (args is ["host", ..] && args.Length <= 2))
    {
        PeerThread host = PeerThread.Host(scene, args.Length == 2 ? int.Parse(args[1]) : 0);
        peers.Add(host);
        Console.WriteLine($"listening on port {host.LocalAddress.ToEndPoint().Port}");
        if (args is [])
        {
            peers.Add(PeerThread.Join(new IPEndPoint(IPAddress.Loopback, host.LocalAddress.ToEndPoint().Port)));
        }
    }
    else
    {
        Console.Error.WriteLine("Say nothing, 'host PORT', or 'join ADDRESS:PORT'.");
        return 2;
    }

    PeerThread me = peers[0];
    if (!me.WaitUntilRunning(TimeSpan.FromMinutes(args is [] ? 0.2 : 10)))
    {
        Console.Error.WriteLine(me.Session.EndReason ?? "Nobody came.");
        return 3;
    }

    bool isDemo = args is [], hasKeys = !Console.IsInputRedirected;
    for (int frame = 0; me.State == SessionState.Running && (!isDemo || frame < FramesPerSecond * DemoSeconds); frame++)
    {
        // Input: what a player does takes effect at once here, and at its own time everywhere else.
        if (hasKeys && Console.KeyAvailable && Console.ReadKey(intercept: true).Key == ConsoleKey.Spacebar)
        {
            _ = me.Do(PlayerAction.Impulse(ball, new Vector3D(0, 8, 0)));
        }
        else if (isDemo && frame % (2 * FramesPerSecond) == FramesPerSecond)
        {
            _ = peers[1].Do(PlayerAction.Teleport(ball, new Vector3D(-4, 12, 0), new Vector3D(4, 0, 0)));
        }

        // Picture: any instant of it can be read; a frame draws the one it is at.
        if (me.Latest() is Picture picture && !Console.IsOutputRedirected)
        {
            Draw(picture, me.Session.SharedTime.Now);
        }

        Thread.Sleep(1000 / FramesPerSecond);
    }

    SessionCounters counters = await me.Ask(session => session.Counters.Copy());
    Console.WriteLine($"events {counters.EventsAccepted}, of them late {counters.Heals}; {me.Session.EndReason ?? "goodbye"}");
    return isDemo && counters.EventsAccepted == 0 ? 1 : 0;
}
finally
{
    peers.ForEach(peer => peer.Dispose());
}

void Draw(Picture picture, SimTime now)
{
    Console.Clear();
    foreach ((BodyId body, char look) in new[] { (ball, 'o'), (rock, '@') })
    {
        if (picture.TryRead(body, now, out BodyState state) && state.Position.Y < Rows)
        {
            Console.SetCursorPosition((int)((state.Position.X + 8) * 4), Rows - (int)state.Position.Y);
            Console.Write(look);
        }
    }
}
