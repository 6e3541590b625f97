using System;
using System.Linq;
using LagSim.Harness.Experiments.Accuracy;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Accuracy;

/// <summary>What is measured of dense contact, of runs that are made up: each watch sees what it is for, and nothing else.</summary>
public sealed class ContactWatchTests
{
    private const double Gravity = 9.81;

    /// <summary>Balls of r 0.5 m and 1 kg, a floor at height zero, and a static sphere of r 1 m far off.</summary>
    private static readonly Scene Scene = new SceneBuilder("two").WithGravity(V(0, -Gravity)).AddPlane("floor", V(0, 1), 0.0)
        .AddStaticSphere("rock", V(50, 0), 1).AddBody("a", Ball(), V(0, 5)).AddBody("b", Ball(), V(0, 7)).Build();

    [Theory]
    [InlineData(0, 0.5, 0, 1.5, 0)] // one stands on the other
    [InlineData(0, 0.5, 0, 1.25, 0.25)] // is in it
    [InlineData(0, 1.25, 0, 0.5, 0.25)] // the same the other way round
    [InlineData(0, 0.5, 0.75, 0.5, 0.25)] // beside it, equally high
    [InlineData(0, 0.375, 9, 9, 0.125)] // in the floor
    [InlineData(49, 1, 9, 9, 0.085786437626904952)] // in the rock, 1.5 - sqrt 2
    public void Overlap_PutInByHand_IsSeen(double x1, double y1, double x2, double y2, double depth)
    {
        OverlapWatch watch = new(Scene);
        watch.Look(new Still([V(x1, y1), V(x2, y2)]));
        Assert.Equal(depth, watch.Worst, 1e-15);

        // It stays seen when it is gone.
        watch.Look(new Still([V(0, 5), V(0, 7)]));
        Assert.Equal(depth, watch.Worst, 1e-15);
    }

    [Fact]
    public void Overlap_AmongManyBalls_IsTheDeepestOfAllPairs()
    {
        Random random = new(5);
        SceneBuilder builder = new SceneBuilder("many").AddPlane("floor", V(0, 1), -90.0);
        for (int n = 0; n < 200; n++)
        {
            builder.AddBody($"{n}", Ball(0.25 + (0.5 * random.NextDouble())), V(9 * n));
        }

        Scene scene = builder.Build();
        Vector3D Anywhere() => new(20 * random.NextDouble(), 20 * random.NextDouble(), 20 * random.NextDouble());
        for (int trial = 0; trial < 20; trial++)
        {
            Vector3D[] places = [.. scene.Bodies.Select(_ => Anywhere())];
            double all = (from i in Enumerable.Range(0, 200)
                          from j in Enumerable.Range(0, i)
                          select scene.Bodies[i].Spec.Radius + scene.Bodies[j].Spec.Radius - (places[i] - places[j]).Length).Max();
            OverlapWatch watch = new(scene);
            watch.Look(new Still(places));
            Assert.Equal(Math.Max(0, all), watch.Worst);
        }
    }

    [Fact]
    public void EnergyGain_IsTheLargestRiseOverAllBefore_AndWhatIsLostIsNone()
    {
        // 12 m of height between the two at first; then one metre less, and from there a joule of each kind more.
        double start = Gravity * 12, metre = 1 / Gravity;
        EnergyGainWatch watch = new(Scene);
        watch.Look(new Still([V(0, 5), V(0, 7)]));
        watch.Look(new Still([V(0, 5), V(0, 6)]));
        Assert.Equal(0, watch.Worst);
        watch.Look(new Still([V(0, 5 + metre), V(0, 6)]));
        Assert.Equal(1 / start, watch.Worst, 1e-12);
        watch.Look(new Still([V(0, 5), V(0, 6)]) { Speed = V(2) }); // both of them
        Assert.Equal(4 / start, watch.Worst, 1e-12);
        watch.Look(new Still([V(0, 5), V(0, 6)]) { Turning = V(0, 0, 10) }); // 1/5 m r^2 w^2 each
        Assert.Equal(10 / start, watch.Worst, 1e-12);
        watch.Look(new Still([V(0, 4), V(0, 6)]));
        Assert.Equal(10 / start, watch.Worst, 1e-12);
    }

    [Fact]
    public void Drift_CountsFromItsTimeOn()
    {
        DriftWatch watch = new(Scene, 2);
        watch.Look(new Still([V(0, 5), V(0, 7)]) { Seconds = 1 });
        watch.Look(new Still([V(0, 1), V(0, 2)]) { Seconds = 1.9999999999 }); // steps that sum to a little less than 2 s
        Assert.Equal(0, watch.Worst);
        watch.Look(new Still([V(0, 1), V(0.25, 2)]) { Seconds = 2.5 });
        watch.Look(new Still([V(0, 1), V(0.125, 2)]) { Seconds = 3 });
        Assert.Equal(0.25, watch.Worst);
    }

    [Fact]
    public void StateThatIsNotFinite_IsNoResultAnyMore()
    {
        (OverlapWatch overlap, EnergyGainWatch gain, DriftWatch drift) = (new(Scene), new(Scene), new(Scene, 0));
        foreach (Vector3D place in new[] { V(0, 7), V(double.NaN), V(0, 7) })
        {
            Still run = new([V(0, 5), place]);
            overlap.Look(run);
            gain.Look(run);
            drift.Look(run);
        }

        Assert.Equal([double.NaN, double.NaN, double.NaN], [overlap.Worst, gain.Worst, drift.Worst]);
    }

    /// <summary>A run that stands where it is put, everything at one speed and one spin.</summary>
    private sealed class Still(Vector3D[] places) : IWorkRun
    {
        public double Seconds { get; init; }

        public Vector3D Speed { get; init; }

        public Vector3D Turning { get; init; }

        public long Events => 0;

        public void AdvanceTo(double seconds)
        {
        }

        public Vector3D Position(int body) => places[body];

        public Vector3D Velocity(int body) => Speed;

        public Vector3D Spin(int body) => Turning;

        public void Dispose()
        {
        }
    }
}
