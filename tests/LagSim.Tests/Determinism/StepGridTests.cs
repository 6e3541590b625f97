using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>The grid of an integrator belongs to the timeline: a contact that is rewound gives back the step that it had cut short.</summary>
public sealed class StepGridTests
{
    private static Scene Scene => new SceneBuilder("steps").WithGravity(Floating)
        .AddForce(Force.Supplied(new FunctionForce((t, x, v) => (x * -2) + (v * -0.1) + V(t))))
        .AddBody("integrated", Ball(0.1, flight: MotionLaw.RungeKutta4, step: 0.05, force: 1), V(1), V(0, 1))
        .AddBody("target", Ball(0.1), V(0, 50)).Build();

    [Fact]
    public void Step_ContactInsideItTakenBack_IsTheSameToTheBit()
    {
        Simulation undisturbed = Run(Scene, 2);
        Simulation disturbed = new(Scene, KeepAll);
        disturbed.AdvanceTo(At(1.5));
        BodyState there = Read(disturbed, First, 0.777); // in the middle of a step
        ExternalEvent blocks = ExternalEvent.Teleport(At(0.7), 1, 1, Second, there.Position);
        Assert.Equal(SubmitResult.RolledBack, disturbed.Submit(blocks));
        disturbed.AdvanceTo(At(1.5));
        Assert.NotEmpty(Impacts(disturbed, First));
        Assert.NotEqual(undisturbed.StateHash(At(1.5)), disturbed.StateHash(At(1.5)));
        Assert.True(disturbed.Retract(blocks));
        disturbed.AdvanceTo(At(2));
        SameTimelines(undisturbed, disturbed);
        Assert.Equal(undisturbed.EventHash(At(2)), disturbed.EventHash(At(2)));
    }

    [Fact]
    public void Steps_AfterAContact_CountFromTheContact()
    {
        Simulation simulation = Run(Drop(0.3, 1, MotionLaw.RungeKutta4), 1);
        SimTime contact = Impacts(simulation, First)[0].Key.Time;
        SimTime[] steps = simulation.Timeline(First).Select(entry => entry.Key.Time).SkipWhile(time => time < contact).Take(4).ToArray();
        Assert.Equal(Enumerable.Range(0, 4).Select(i => contact + (BodySpec.DefaultStep * i)), steps);
    }

    [Fact]
    public void Step_ReadInTheMiddle_OpensNoSegment()
    {
        Simulation simulation = Run(Scene, 1);
        int before = simulation.Timeline(First).Count;
        ulong hash = simulation.EventHash(At(1));
        for (int i = 0; i < 1000; i++)
        {
            simulation.TryRead(First, At(i / 1000.0), out _);
        }

        Assert.Equal(before, simulation.Timeline(First).Count);
        Assert.Equal(hash, simulation.EventHash(At(1)));
    }
}
