using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

/// <summary>A small game's world and session: two players push a ball about on a walled pitch.</summary>
public static class Pitch
{
    public static Scene Build() => new SceneBuilder("pitch")
        .AddPlane("floor", normal: Vector3D.Up, point: Vector3D.Zero, restitution: 0.5)
        .AddPlane("left wall", normal: new Vector3D(1, 0, 0), point: new Vector3D(-5, 0, 0), restitution: 0.8)
        .AddPlane("right wall", normal: new Vector3D(-1, 0, 0), point: new Vector3D(5, 0, 0), restitution: 0.8)
        .AddPlane("near wall", normal: new Vector3D(0, 0, 1), point: new Vector3D(0, 0, -3), restitution: 0.8)
        .AddPlane("far wall", normal: new Vector3D(0, 0, -1), point: new Vector3D(0, 0, 3), restitution: 0.8)
        .AddStaticSphere("post", centre: new Vector3D(4, 0.3, 1), radius: 0.3, restitution: 0.8)
        .AddBody("ball", new BodySpec(radius: 0.3, mass: 0.5, restitution: 0.8, friction: 0.4), position: new Vector3D(0, 1, 0))
        .AddBody("crate", new BodySpec(radius: 0.4, mass: 2, restitution: 0.3, friction: 0.6), position: new Vector3D(2, 0.4, 0))
        .Build();

    // An event may come up to five seconds late and is still accepted.
    public static HostOptions Options() => new() { Window = new(SimDuration.FromSeconds(5)) };
}
