using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>An impact leaves no body faster than a state means something: whoever may throw two bodies ends no world by it.</summary>
public sealed class ImpactSpeedTests
{
    private const double Given = 0.1 * 0.5 * SimDuration.TicksPerSecond;

    [Fact]
    public void Impact_ThatWouldMakeABodyTooFast_LeavesItAtTheLimitInItsDirection()
    {
        Scene scene = HeadOn(Given);
        Simulation simulation = Run(scene, 1);
        Vector3D velocity = Read(simulation, Second, 1).Velocity;
        Near(1.5 * Given, velocity.X, Given * 1e-12);
        Near(0, velocity.Y, Given * 1e-12);
        Near(Given, Read(simulation, First, 1).Velocity.X, Given * 1e-8);
    }

    [Theory]
    [InlineData(0.01)]
    [InlineData(0.49)]
    public void Impact_ThatStaysBelow_IsNewtonsLaw(double part)
    {
        // The control: to three times the speed of the heavy one.
        Simulation simulation = Run(HeadOn(part * Given), 1);
        Near(3 * part * Given, Read(simulation, Second, 1).Velocity.X, part * Given * 1e-8);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(-1)]
    public void Impact_AtTheLimit_UnderGravity_DoesNotEndTheWorld(int way)
    {
        Scene scene = new SceneBuilder("struck").AddBody("heavy", Ball(mass: 1e30), V(0), V(0, way * Given))
            .AddBody("light", Ball(mass: 1e-30), V(0, way * 2), V(0, -way * Given)).Build();
        Simulation simulation = Run(scene, 3600);
        Near(way * 1.5 * Given, Read(simulation, Second, 3600).Velocity.Y, 9.82 * 3600);
    }

    [Fact]
    public void Impact_BetweenTwoHeavyOnesThatClose_EndsItsTick()
    {
        Scene scene = new SceneBuilder("between").WithGravity(Floating).AddBody("left", Ball(mass: 1e9), V(-3), V(Given))
            .AddBody("light", Ball(), V(0), V(0, 0.5 * Given)).AddBody("right", Ball(mass: 1e9), V(3), V(-Given)).Build();
        Simulation simulation = Run(scene, 1);
        Assert.True(Read(simulation, Second, 1).Velocity.Length <= 1.5 * Given * (1 + 1e-12));
    }

    [Fact]
    public void Impact_AtTheLimit_HeardLate_HasTheSameBits()
    {
        Scene scene = new SceneBuilder("empty").WithSmallestRadius(0.5).AddPlane("floor", Vector3D.Up, V(0), 1).Build();
        ExternalEvent heavy = ExternalEvent.Spawn(At(0.5), 1, 1, Ball(mass: 1e9), V(0, 100), V(Given));
        ExternalEvent light = ExternalEvent.Spawn(At(0.5), 2, 1, Ball(), V(5, 100.2), V(-Given));
        Simulation inTime = new(scene, KeepAll);
        inTime.Submit(heavy);
        inTime.Submit(light);
        inTime.AdvanceTo(At(1));
        Simulation late = new(scene, KeepAll);
        late.Submit(light);
        late.AdvanceTo(At(1));
        Assert.NotEqual(inTime.StateHash(At(1)), late.StateHash(At(1)));
        Assert.Equal(SubmitResult.RolledBack, late.Submit(heavy));
        late.AdvanceTo(At(1));
        SameTimelines(inTime, late);
        Near(1.5 * Given, Read(late, light.Body, 1).Velocity.Length, Given * 1e-9);
    }

    private static Scene HeadOn(double speed) => new SceneBuilder("head-on").WithGravity(Floating)
        .AddBody("heavy", Ball(mass: 1e12), V(0), V(speed)).AddBody("light", Ball(), V(2), V(-speed)).Build();
}
