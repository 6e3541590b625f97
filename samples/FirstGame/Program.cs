using System;
using System.Net;
using System.Threading;
using LagSim;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Scenes;

Scene scene = new SceneBuilder("my first world")
    .AddPlane("floor", normal: Vector3D.Up, point: Vector3D.Zero)
    .AddBody("ball", new BodySpec(radius: 0.5, mass: 1, restitution: 0.8), position: new Vector3D(0, 5, 0))
    .Build();

// "join ADDRESS:PORT" makes this program a client; anything else makes it the host.
using PeerThread me = args is ["join", string address]
    ? PeerThread.Join(IPEndPoint.Parse(address), setUp: Watch)
    : PeerThread.Host(scene, udpPort: 5000, new HostOptions { Unprotected = true }, setUp: Watch); // or a Protection
if (!me.WaitUntilRunning(TimeSpan.FromSeconds(15)))
{
    Console.Error.WriteLine(me.Session.WhyNotRunning);
    return 1;
}

BodyId ball = me.Session.Scene!.BodyNamed("ball"); // a client gets the scene from the host
for (int frame = 0; frame < 60 * 60 && me.State != SessionState.Ended; frame++)
{
    if (frame % 120 == 60 && me.State == SessionState.Running) // not while a client that lost its host asks to be let in again
    {
        _ = me.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0))); // a kick every two seconds, 6 N s upwards
    }

    if (frame % 15 == 0 && me.Latest() is RenderSnapshot snapshot && snapshot.TryRead(ball, me.Session.DisplayTime, out BodyState state))
    {
        Console.WriteLine($"height {state.Position.Y:F2} m");
    }

    Thread.Sleep(1000 / 60);
}

Console.WriteLine(me.Session.EndReason); // nothing while it goes on
return 0;

static void Watch(Session session) => session.StateCommitted +=
    state => Console.WriteLine($"committed at {state.Time.ToSeconds():F2} s: {state.StateHash:x16}");
