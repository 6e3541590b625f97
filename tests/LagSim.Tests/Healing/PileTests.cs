using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Healing;

/// <summary>Late events for balls that lie on one another in a tube, where thousands of impacts look at who is near.</summary>
public sealed class PileTests
{
    [Theory]
    [InlineData(HealingMode.CausalCone)]
    [InlineData(HealingMode.FullRollback)]
    public void LateEvents_OneAfterTheOther_LeaveNothingBehindOfWhatWasTakenBack(HealingMode mode)
    {
        // Each rewinds some thousand impacts. Near misses of what is rewound would, if kept, fill the memory that is allowed, and be gone through again each time.
        Simulation late = new(Tube(3), new SimulationOptions(default, SimDuration.FromSeconds(0.5), maxSegments: 50_000, healing: mode));
        Simulation inTime = new(Tube(3), KeepAll);
        for (int n = 0; n < 40; n++)
        {
            SimTime now = At(2 + (0.01 * n));
            ExternalEvent kick = ExternalEvent.Impulse(now - SimDuration.FromSeconds(0.4), 1, (uint)n + 1, BodyId.OfScene(n % 3), V(0.001 * n, 0.01));
            late.AdvanceTo(now);
            late.Submit(kick);
            inTime.Submit(kick);
        }

        late.AdvanceTo(At(2.4));
        inTime.AdvanceTo(At(2.4));
        Assert.Equal(inTime.StateHash(At(2.4)), late.StateHash(At(2.4)));
        Assert.Equal(inTime.EventHash(At(2.4)), late.EventHash(At(2.4)));
    }

    /// <summary>Balls one above the other between four walls with two centimetres of play.</summary>
    private static Scene Tube(int balls)
    {
        const double Radius = 0.1, Half = 0.12;
        SceneBuilder builder = new SceneBuilder("tube").AddPlane("floor", Vector3D.Up, V(0, -Radius), 0.3)
            .AddPlane("west", V(1), V(-Half), 0.5).AddPlane("east", V(-1), V(Half), 0.5)
            .AddPlane("back", new Vector3D(0, 0, 1), new Vector3D(0, 0, -Half), 0.5).AddPlane("front", new Vector3D(0, 0, -1), new Vector3D(0, 0, Half), 0.5);
        for (int n = 0; n < balls; n++)
        {
            builder.AddBody($"ball {n}", Ball(Radius, 1, 0.3), new Vector3D(0.006 * (n % 2), 0.21 * n, -0.004));
        }

        return builder.Build();
    }
}
