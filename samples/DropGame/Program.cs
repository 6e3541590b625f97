// A game loop in the console, from the LagSim packages alone. Two players, one ball: space (or the bot) lifts it.
//   dotnet run --project samples/DropGame                       a host and a bot that joins it, in one process
//   dotnet run --project samples/DropGame -- host 5000          a host for other machines
//   dotnet run --project samples/DropGame -- join 127.0.0.1:5000
using System;
using System.Collections.Generic;
using System.IO;
using System.Net;
using System.Threading;
using LagSim;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

const int FramesPerSecond = 30, DemoSeconds = 6, Rows = 16;
(int port, IPEndPoint? there) = (0, null);
bool isDemo = args is [], isHost = args is ["host"] || (args is ["host", string number] && int.TryParse(number, out port) && port is >= 0 and <= IPEndPoint.MaxPort);
if (!isDemo && !isHost && !(args is ["join", string address] && IPEndPoint.TryParse(address, out there) && there.Port > 0))
{
    Console.Error.WriteLine($"'{string.Join(' ', args)}' must be nothing, 'host', 'host PORT' with a port of 0 (any free) to {IPEndPoint.MaxPort}, or 'join ADDRESS:PORT'.");
    return 2;
}

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
    peers.Add(there is not null ? PeerThread.Join(there) : PeerThread.Host(scene, port, new HostOptions { Unprotected = true }));
    PeerThread me = peers[0];
    Console.WriteLine(there is null ? $"listening on port {me.LocalAddress.ToEndPoint().Port}" : $"joining {there}");
    if (isDemo)
    {
        peers.Add(PeerThread.Join(me.LocalAddress.ToEndPoint()));
    }

    if (!me.WaitUntilRunning(TimeSpan.FromMinutes(isDemo ? 0.2 : 10)))
    {
        Console.Error.WriteLine(me.Session.EndReason ?? "Nobody came.");
        return 3;
    }

    bool hasKeys = !Console.IsInputRedirected;
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

        if (me.Latest() is RenderSnapshot snapshot && !Console.IsOutputRedirected)
        {
            Draw(snapshot, me.Session.SharedTime.Now); // any instant of a render snapshot can be read; a frame draws the one it is at
        }

        Thread.Sleep(1000 / FramesPerSecond);
    }

    SessionCounters counters = await me.Ask(session => session.Counters.Copy());
    Console.WriteLine($"events {counters.EventsAccepted}, of them late {counters.Heals}; {me.Session.EndReason ?? "goodbye"}");
    return isDemo && counters.EventsAccepted == 0 ? 1 : 0;
}
catch (IOException taken)
{
    Console.Error.WriteLine(taken.Message);
    return 3;
}
finally
{
    peers.ForEach(peer => peer.Dispose());
}

void Draw(RenderSnapshot snapshot, SimTime now)
{
    Console.Clear();
    foreach ((BodyId body, char look) in new[] { (ball, 'o'), (rock, '@') })
    {
        if (snapshot.TryRead(body, now, out BodyState state) && state.Position.Y < Rows)
        {
            Console.SetCursorPosition((int)((state.Position.X + 8) * 4), Rows - (int)state.Position.Y);
            Console.Write(look);
        }
    }
}
