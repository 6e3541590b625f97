// Two peers share a world over UDP: what one does, both have, to the last bit.
using System;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

Scene scene = new SceneBuilder("two peers")
    .AddPlane("floor", normal: Vector3D.Up, point: Vector3D.Zero)
    .AddBody("ball", new BodySpec(radius: 0.5, mass: 1, restitution: 0.7), position: new Vector3D(0, 4, 0))
    .Build();
BodyId ball = scene.BodyNamed("ball");

// On two machines each would have one of these lines; the client gets the scene from the host.
using PeerThread host = PeerThread.Host(scene, bind: IPAddress.Loopback);
using PeerThread client = PeerThread.Join(host.LocalAddress.ToEndPoint());
if (!host.WaitUntilRunning(TimeSpan.FromSeconds(5)) || !client.WaitUntilRunning(TimeSpan.FromSeconds(5)))
{
    Console.Error.WriteLine(client.Session.EndReason ?? "The two did not come together.");
    return 1;
}

for (int frame = 0; frame < 30; frame++)
{
    if (frame == 15)
    {
        Console.WriteLine("the client kicks the ball");
        _ = client.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0)));
    }

    Console.WriteLine($"host {Height(host),7:0.000} m   client {Height(client),7:0.000} m");
    Thread.Sleep(75);
}

// Of half a second ago no event is on its way any more: both have the same world, bit for bit.
SimTime then = host.Session.SharedTime.Now - SimDuration.FromMilliseconds(500);
ulong[] hashes = [await Hash(host), await Hash(client)];
Console.WriteLine($"event hashes {hashes[0]:x16} {hashes[1]:x16}");
return hashes[0] == hashes[1] ? 0 : 1;

// A frame draws the instant that the session displays: the shared time, which both peers' clocks agree on, or with the strategy interpolation a little before.
double Height(PeerThread peer) =>
    peer.Latest() is { } snapshot && snapshot.TryRead(ball, peer.Session.DisplayTime, out BodyState state) ? state.Position.Y : double.NaN;

Task<ulong> Hash(PeerThread peer) => peer.Ask(session => session.World!.Simulation.EventHash(then));
