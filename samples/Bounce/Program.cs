// A ball in a world of its own: simulated ahead of time on a thread of its own, drawn and kicked from this one.
using System;
using System.Threading;
using LagSim;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;

Scene scene = new SceneBuilder("bounce")
    .AddPlane("floor", normal: Vector3D.Up, point: Vector3D.Zero)
    .AddBody("ball", new BodySpec(radius: 0.5, mass: 1, restitution: 0.7), position: new Vector3D(0, 4, 0))
    .Build();
BodyId ball = scene.BodyNamed("ball");

using SimulationHost host = new(scene, new StopwatchClock());
SimTime began = host.Now;
host.Start();

for (int frame = 0; frame < 40; frame++)
{
    if (frame == 18)
    {
        Console.WriteLine("kick!");
        host.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0))); // 6 N s upwards, now
    }

    // Any instant of the render snapshot can be read; a game reads the one it draws.
    SimTime now = host.Now;
    if (host.RenderSnapshot.TryRead(ball, now, out BodyState state))
    {
        string height = new('#', (int)(state.Position.Y * 12));
        Console.WriteLine($"{(now - began).ToSeconds(),5:0.00} s {state.Position.Y,6:0.000} m {state.Motion,-9} {height}");
    }

    Thread.Sleep(75);
}
