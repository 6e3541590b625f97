using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>Light balls among heavy ones in a box on a slope, with so much friction that they jam: no storm of impacts, nor deep in each other.</summary>
public sealed class JammedTests
{
    private const int Balls = 4;
    private const double Half = 0.5;
    private const double Step = 0.0005;
    private const double Until = 1.5;
    private const double Fine = 1e-5; // a contact tolerance, in metres

    [Theory]
    [InlineData(642)]
    [InlineData(1055)]
    public void Jammed_ByFriction_IsNoStorm(int seed)
    {
        // Friction at the wall drives the ball into its neighbour, and friction there drives it into the wall, as often as gravity has made it slip a little.
        Assert.InRange(Busiest(seed), 0, 1_000);
    }

    [Theory]
    [InlineData(78)]
    [InlineData(98)]
    [InlineData(109)]
    [InlineData(112)]
    [InlineData(136)]
    public void Jammed_OnTheWay_IsNotDeep(int seed) => Assert.InRange(Deepest(seed), 0, 2 * Fine);

    [Theory]
    [InlineData(10)]
    [InlineData(89)]
    public void Jammed_HeardOfLate_HealsToTheSameBits(int seed)
    {
        ExternalEvent push = ExternalEvent.SetVelocity(At(0.4), 1, 1, BodyId.OfScene(1), V(1, 0.5, -1));
        Simulation inTime = new(Draw(seed), KeepAll);
        inTime.Submit(push);
        inTime.AdvanceTo(At(Until));
        Simulation late = new(Draw(seed), KeepAll);
        late.AdvanceTo(At(1));
        late.Submit(push);
        late.AdvanceTo(At(Until));
        Assert.Equal(inTime.StateHash(At(Until)), late.StateHash(At(Until)));
        Assert.Equal(inTime.EventHash(At(Until)), late.EventHash(At(Until)));
    }

    /// <summary>How many events at most come within half a millisecond.</summary>
    private static long Busiest(int seed)
    {
        Simulation simulation = new(Draw(seed), TenSeconds);
        long most = 0;
        for (int k = 1; k * Step <= Until; k++)
        {
            long before = simulation.EventsProcessed;
            simulation.AdvanceTo(At(k * Step));
            most = Math.Max(most, simulation.EventsProcessed - before);
        }

        return most;
    }

    /// <summary>How deep at most, every half millisecond, anybody is in anything, in metres.</summary>
    private static double Deepest(int seed)
    {
        Scene scene = Draw(seed, Fine);
        Simulation simulation = new(scene, TenSeconds);
        simulation.AdvanceTo(At(Until));
        double most = 0;
        Vector3D[] places = new Vector3D[Balls];
        for (int k = 1; k * Step <= Until; k++)
        {
            for (int i = 0; i < Balls; i++)
            {
                double radius = scene.Bodies[i].Spec.Radius;
                places[i] = Read(simulation, BodyId.OfScene(i), k * Step).Position;
                foreach (StaticPlane plane in scene.Planes)
                {
                    most = Math.Max(most, plane.Offset + radius - Vector3D.Dot(plane.Normal, places[i]));
                }

                for (int j = 0; j < i; j++)
                {
                    most = Math.Max(most, radius + scene.Bodies[j].Spec.Radius - (places[i] - places[j]).Length);
                }
            }
        }

        return most;
    }

    private static SimulationOptions TenSeconds => new(history: SimDuration.FromSeconds(10));

    private static Scene Draw(int seed, double tolerance = 1e-3)
    {
        Random random = new(seed);
        double Between(double least, double most) => least + ((most - least) * random.NextDouble());
        double tilt = Half * random.NextDouble();
        double[] masses = [0.01, 0.4, 20];
        SceneBuilder builder = new SceneBuilder("jam").WithSmallestRadius(0.1).WithContactTolerance(tolerance)
            .AddPlane("floor", V(Math.Sin(tilt), Math.Cos(tilt)), 0.0, 0.5, 2)
            .AddPlane("west", V(1), -Half, 0, 2).AddPlane("east", V(-1), -Half, 0, 2)
            .AddPlane("north", V(0, 0, 1), -Half, 0, 2).AddPlane("south", V(0, 0, -1), -Half, 0, 2);
        for (int i = 0; i < Balls; i++)
        {
            BodySpec spec = new(Between(0.1, 0.25), masses[random.Next(masses.Length)], 0.3, friction: 2);
            Vector3D place = V(i % 2 == 0 ? -0.25 : 0.25, 1.2 + (0.6 * (i / 2)), Between(-0.2, 0.2));
            builder.AddBody($"ball {i}", spec, place, V(Between(-3, 3), Between(-3, 0), Between(-3, 3)));
        }

        return builder.Build();
    }
}
