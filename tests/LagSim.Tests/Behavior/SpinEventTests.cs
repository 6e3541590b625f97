using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>How a body turns after what players do: a spawn may give it a spin, a hand takes it, and nothing else changes it, in time or late.</summary>
public sealed class SpinEventTests
{
    private static readonly Vector3D Turning = V(1, -2, 30);

    private static readonly BodySpec Rough = new(0.5, 1, 0.5, friction: 0.5);

    private static Scene Floor => new SceneBuilder("floor").AddPlane("floor", Vector3D.Up, V(0), 1).AddBody("ball", Rough, V(0, 20), spin: Turning).Build();

    [Fact]
    public void Spawn_WithASpin_TurnsAndIsCarriedOffByTheFloor()
    {
        Simulation turning = With(ExternalEvent.Spawn(At(0.1), 1, 1, Rough, V(0, 0.6), spin: V(0, 0, 10)));
        Simulation still = With(ExternalEvent.Spawn(At(0.1), 1, 1, Rough, V(0, 0.6)));
        BodyId guest = new(1, 1, 0);
        Assert.Equal(V(0, 0, 10), Read(turning, guest, 0.11).Spin);
        Assert.True(Read(turning, guest, 1).Velocity.X < -0.1);
        Assert.Equal(0, Read(still, guest, 1).Velocity.X); // the control
        Assert.NotEqual(still.StateHash(At(0.11)), turning.StateHash(At(0.11)));
    }

    [Fact]
    public void Spawn_WithANegativeZeroInItsSpin_IsTheOneThatTravels()
    {
        Simulation sender = With(ExternalEvent.Spawn(At(0.1), 1, 1, Rough, V(3, 5), spin: V(-0.0, 4, -0.0)));
        Simulation receiver = With(ExternalEvent.Spawn(At(0.1), 1, 1, Rough, V(3, 5), spin: V(0, 4)));
        Assert.Equal(receiver.StateHash(At(1)), sender.StateHash(At(1)));
        Assert.Equal(receiver.EventHash(At(1)), sender.EventHash(At(1)));
    }

    [Fact]
    public void TeleportSetVelocityImpulse_OfABodyThatTurns_LeaveItTurning()
    {
        Assert.Equal(Turning, After(ExternalEvent.Teleport(At(0.5), 1, 1, First, V(4, 9), V(1))).Spin);
        Assert.Equal(Turning, After(ExternalEvent.SetVelocity(At(0.5), 1, 1, First, V(1))).Spin);
        Assert.Equal(Turning, After(ExternalEvent.Impulse(At(0.5), 1, 1, First, V(1))).Spin);
    }

    [Fact]
    public void GrabAndRelease_OfABodyThatTurns_StopIt()
    {
        Simulation simulation = With(ExternalEvent.Grab(At(0.5), 1, 1, First), ExternalEvent.Release(At(0.7), 1, 2, First));
        Assert.Equal(Turning, Read(simulation, First, 0.4).Spin);
        Assert.Equal(Vector3D.Zero, Read(simulation, First, 0.6).Spin);
        Assert.Equal(Vector3D.Zero, Read(simulation, First, 0.8).Spin);
    }

    [Fact]
    public void SubmitForwarded_OfABodyThatTurns_TurnsAsInTime()
    {
        foreach (ExternalEvent external in new[]
        {
            ExternalEvent.Spawn(At(0.3), 1, 1, Rough, V(3, 9), spin: V(0, 5)),
            ExternalEvent.Teleport(At(0.3), 1, 1, First, V(4, 9), V(1)),
            ExternalEvent.SetVelocity(At(0.3), 1, 1, First, V(1)),
            ExternalEvent.Impulse(At(0.3), 1, 1, First, V(1)),
        })
        {
            Simulation inTime = With(external);
            Simulation late = new(Floor, KeepAll);
            late.AdvanceTo(At(0.35));
            late.SubmitForwarded(external, At(0.35));
            late.AdvanceTo(At(0.5));
            Assert.NotEqual(Vector3D.Zero, Read(inTime, external.Body, 0.4).Spin);
            SameBits(Read(inTime, external.Body, 0.4), Read(late, external.Body, 0.4));
        }
    }

    private static BodyState After(ExternalEvent external) => Read(With(external), First, external.Time + SimDuration.FromSeconds(0.1));

    private static Simulation With(params ExternalEvent[] events)
    {
        Simulation simulation = new(Floor, KeepAll);
        foreach (ExternalEvent external in events)
        {
            simulation.Submit(external);
        }

        simulation.AdvanceTo(At(2));
        return simulation;
    }
}
