// A shared world without a thread: the game steps its session once a frame. Here two players' frames take turns in one program.
using System;
using System.Net;
using System.Threading;
using LagSim;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;

const int FramesPerSecond = 60;

Scene scene = new SceneBuilder("polled")
    .AddPlane("floor", normal: Vector3D.Up, point: Vector3D.Zero)
    .AddBody("ball", new BodySpec(radius: 0.5, mass: 1, restitution: 0.7), position: new Vector3D(0, 4, 0))
    .Build();
BodyId ball = scene.BodyNamed("ball");

// Each session has a port and a clock. What its events call runs in the frame that steps it: a handler may touch anything of the game.
using UdpPort hostPort = new(new IPEndPoint(IPAddress.Loopback, 0));
using UdpPort clientPort = new(new IPEndPoint(IPAddress.Loopback, 0));
HostSession host = new(
    scene, hostPort, new StopwatchClock(), new HostOptions { Name = "Hedy", ExpectedClients = 1, ConfirmsEarly = true },
    Session.DrawNumber());
ClientSession client = new(
    null, clientPort, new StopwatchClock(), new ClientOptions { Name = "Ann" }, hostPort.LocalAddress, Session.DrawNumber());
host.RosterChanged += change => Console.WriteLine($"{change}");

// The frames of the game: step, draw, act. A step never waits, and does no more than is due.
int runningFrames = 0;
for (int frame = 0; frame < 20 * FramesPerSecond && runningFrames < 3 * FramesPerSecond; frame++)
{
    host.Step();
    client.Step();
    if (client.State == SessionState.Ended)
    {
        Console.Error.WriteLine(client.EndReason);
        return 1;
    }

    if (client.State == SessionState.Running && host.State == SessionState.Running)
    {
        if (runningFrames++ == FramesPerSecond)
        {
            Console.WriteLine("the client kicks the ball");
            client.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0)));
        }

        if (runningFrames % 15 == 0)
        {
            Console.WriteLine($"host {Height(host),7:0.000} m   client {Height(client),7:0.000} m");
        }
    }

    Thread.Sleep(1000 / FramesPerSecond); // the rest of a frame: drawing
}

// Each second of the world both hash what is final, and the client compares: the worlds are equal, bit for bit.
long agreed = client.Counters.StatesAgreed;
bool isSame = agreed > 0 && client.Counters.StatesDiffered == 0;
Console.WriteLine($"{host.Committed}; {agreed} states agreed, {host.Counters.EventsAccepted} event accepted");

// Whoever leaves says so.
client.Leave();
host.Step();
host.Leave();
return isSame && host.Counters.EventsAccepted == 1 ? 0 : 1;

double Height(Session session) =>
    session.World?.RenderSnapshots.Latest() is RenderSnapshot snapshot && snapshot.TryRead(ball, session.DisplayTime, out BodyState state)
        ? state.Position.Y : double.NaN;
