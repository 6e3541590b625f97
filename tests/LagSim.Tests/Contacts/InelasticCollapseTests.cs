using System;
using System.Linq;
using LagSim.Contacts;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Contacts;

/// <summary>From which restitution on infinitely many impacts may follow, against thresholds that are known; and what becomes of them in a world.</summary>
public sealed class InelasticCollapseTests
{
    /// <summary>A row of N balls that closes on a wall: tan²(pi/4 (1 - 1/N)) (Bernu and Mazighi 1990).</summary>
    [Theory]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(5)]
    [InlineData(20)]
    public void IsPossible_RowAtAWall_AsBernuAndMazighi(int balls)
    {
        double threshold = Math.Pow(Math.Tan(Math.PI / 4 * (1 - (1.0 / balls))), 2);
        Assert.True(IsPossible(Row([.. Enumerable.Repeat(1.0, balls)], hasWall: true), threshold - 1e-9));
        Assert.False(IsPossible(Row([.. Enumerable.Repeat(1.0, balls)], hasWall: true), threshold + 1e-9));
    }

    /// <summary>Three balls alone: 7 - 4 sqrt 3; the middle one lighter: (1 - sin t) / (1 + sin t), t being the angle of the billiard's wedge.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(1e-2)]
    [InlineData(1e-6)]
    public void IsPossible_ThreeBalls_AtTheAngleOfTheWedge(double middle)
    {
        double sine = Math.Sqrt(1 - Math.Pow(1 / (1 + middle), 2));
        double threshold = (1 - sine) / (1 + sine);
        Assert.Equal(middle == 1 ? 7 - (4 * Math.Sqrt(3)) : threshold, threshold, 1e-12);
        Assert.True(IsPossible(Row([1, middle, 1], hasWall: false), threshold * (1 - 1e-9)));
        Assert.False(IsPossible(Row([1, middle, 1], hasWall: false), threshold * (1 + 1e-9)));
    }

    /// <summary>
    /// A ball between floor and wall, which only friction couples, with cosine mu where it slips: mu (1 + e) = 2 sqrt e at the threshold,
    /// and from mu = 1 on any loss is enough. Without friction at one of the two the ball is driven to it and never back.
    /// </summary>
    [Theory]
    [InlineData(0.3)]
    [InlineData(0.9)]
    public void IsPossible_BallInACorner_ByItsFriction(double mu)
    {
        double threshold = Math.Pow((1 - Math.Sqrt(1 - (mu * mu))) / mu, 2);
        Assert.True(InCorner(threshold * (1 - 1e-9), mu, mu));
        Assert.False(InCorner(threshold * (1 + 1e-9), mu, mu));
        Assert.True(InCorner(1 - 1e-12, 1, 1));
        Assert.False(InCorner(1e-12, 0, mu));

        static bool InCorner(double e, double floor, double wall)
        {
            ContactPoint below = new(0, ContactPoint.Static, 0, default) { Normal = V(0, 1) };
            ContactPoint beside = new(0, ContactPoint.Static, 1, default) { Normal = V(1) };
            ContactPoint[] contacts = [below, beside];
            return new InelasticCollapse().IsPossible(contacts, [e, e], [floor, wall], [1.0]);
        }
    }

    [Fact]
    public void IsPossible_OneContactOrElasticOnes_IsNot()
    {
        Assert.False(IsPossible(Row([1, 1], hasWall: false), 0));
        Assert.False(IsPossible(Row([1, 1e-9, 1], hasWall: false), 1));
    }

    /// <summary>
    /// Galperin's billiard with restitution a little below 1: from however near the two begin, it is the same, for nothing in it has a length. The control
    /// is a restitution below the threshold, with which the heavy ball stops.
    /// </summary>
    [Theory]
    [InlineData(0.999, 1e4)]
    [InlineData(0.9999, 1e4)]
    [InlineData(0.9, 100)]
    public void Impacts_OfANarrowGap_AreThoseOfAWideOne(double e, double ratio)
    {
        double wide = Left(e, ratio, 1e-3, out long impacts);
        Assert.True(wide > 0.01);
        foreach (double gap in new[] { 1e-6, 1e-9, 1e-12, 1e-15, 0 })
        {
            Assert.Equal(wide, Left(e, ratio, gap, out long again), 1e-3 * wide);
            Assert.Equal(impacts, again);
        }

        double threshold = (1 - Math.Sqrt(1 / (1 + ratio))) / (1 + Math.Sqrt(1 / (1 + ratio)));
        Assert.InRange(Left(0.9 * threshold, ratio, 1e-9, out _), 0, 1e-9);
    }

    /// <summary>
    /// A light ball between two heavy ones, a rounding away from one of them: places do not tell in how many picoseconds it gets there. If
    /// they decided, it would be struck every few picoseconds for ever.
    /// </summary>
    [Fact]
    public void Impacts_AcrossAGapOfRounding_AreOfOneInstant()
    {
        BodySpec heavy = new(0.2, 1e9, 0.3), light = new(0.2, 1, 0.3);
        Scene scene = new SceneBuilder("rounding").WithGravity(Vector3D.Zero).AddBody("left", heavy, V(0.6906116835972948), V(2e-6))
            .AddBody("middle", light, V(1.0906116835972948)).AddBody("right", heavy, V(1.490611683597295)).Build();
        Simulation simulation = new(scene, new SimulationOptions());
        long most = 1_000;
        Assert.True(simulation.TryAdvanceTo(At(1), ref most), $"at {simulation.SimulatedTo}");
        Assert.Equal(1e-6, Read(simulation, BodyId.OfScene(0), 1).Velocity.X, 1e-9);
        Assert.Equal(1e-6, Read(simulation, BodyId.OfScene(2), 1).Velocity.X, 1e-9);
    }

    /// <summary>What is left of the energy when a heavy ball has driven a light one against a wall.</summary>
    private static double Left(double e, double ratio, double gap, out long impacts)
    {
        Scene scene = new SceneBuilder("narrow").WithGravity(Vector3D.Zero).AddPlane("wall", V(1), 0.0)
            .AddBody("light", new BodySpec(0.5, 1, e), V(0.5 + gap))
            .AddBody("heavy", new BodySpec(0.5, ratio, e), V(1.5 + (2 * gap)), V(-1)).Build();
        Simulation simulation = new(scene, new SimulationOptions());
        simulation.AdvanceTo(At(10));
        impacts = simulation.ImpactsProcessed;
        return (Read(simulation, First, 10).Velocity.LengthSquared + (ratio * Read(simulation, Second, 10).Velocity.LengthSquared)) / ratio;
    }

    /// <summary>
    /// Two heavy balls close slowly on a light one that touches both. If each touch could wait, it would go to and fro without end, by a
    /// thousandth of the restitution threshold and a millionth less fast each time. It is one collapse, after which they go on together.
    /// </summary>
    [Theory]
    [InlineData(1e-6, 8.7e-7, 0)]
    [InlineData(1e-6, 3e-11, 0)]
    [InlineData(1e-9, 1.4e-8, 0.3)]
    public void SlowSqueeze_OfALightBall_IsOneCollapse(double light, double speed, double e)
    {
        Scene scene = new SceneBuilder("squeeze").WithGravity(Vector3D.Zero)
            .AddBody("slow", new BodySpec(0.5, 1000, e), V(1), V(0.3 * speed)).AddBody("light", new BodySpec(0.5, light, e), V(0))
            .AddBody("fast", new BodySpec(0.5, 1, e), V(-1), V(speed)).Build();
        Simulation simulation = new(scene, new SimulationOptions());
        simulation.AdvanceTo(At(10));
        Assert.InRange(simulation.ImpactsProcessed, 1, 20);
        double common = ((0.3 * speed * 1000) + speed) / (1001 + light);
        foreach (BodyId body in new[] { First, Second, BodyId.OfScene(2) })
        {
            Assert.InRange(Read(simulation, body, 10).Velocity.X, common - (1e-5 * speed), common + (1e-5 * speed));
        }
    }

    /// <summary>
    /// A ball of 10^9 kg closes slowly on one of 10 g that touches a wall, as in <c>check --seed 40405</c>. Both impacts are slower
    /// than what a collapse may leave; yet there was none before the third round, and if that waits, the light ball goes to and fro
    /// every microsecond.
    /// </summary>
    [Theory]
    [InlineData(1e9, 0.01, 3.8e-9)]
    [InlineData(1e6, 1, 1.3e-8)]
    public void SlowSqueeze_AgainstAWall_IsOneCollapse(double heavy, double light, double speed)
    {
        Scene scene = new SceneBuilder("wall").WithGravity(Vector3D.Zero)
            .AddPlane("wall", V(1), 0, 0)
            .AddBody("light", new BodySpec(0.2, light, 0), V(0.2)).AddBody("heavy", new BodySpec(0.2, heavy, 1), V(0.6), V(-speed)).Build();
        Simulation simulation = new(scene, new SimulationOptions());
        long most = 1000;
        Assert.True(simulation.TryAdvanceTo(At(10), ref most), $"at {simulation.SimulatedTo} after {simulation.ImpactsProcessed} impacts");
        Assert.InRange(Math.Abs(Read(simulation, Second, 10).Velocity.X), 0, 1e-6 * speed);
    }

    /// <summary>
    /// Two that slide along each other, 1.9 pm deep, part by so little that no place can tell (from <c>check --seed 300199</c>): they are not struck for
    /// it every microsecond.
    /// </summary>
    [Fact]
    public void SlidingApart_ByLessThanRounding_IsNoStorm()
    {
        Scene scene = new SceneBuilder("slide").WithGravity(Vector3D.Zero)
            .AddBody("one", new BodySpec(0.2, 1, 0), V(-1.7440272628554248, 0.199999999999), V(-5.286773078206401e-17))
            .AddBody("other", new BodySpec(0.2, 20, 0.9), V(-1.3440272628573402, 0.20000000000203097), V(-5.286776469215463e-17, 4.4751552964854584e-12))
            .Build();
        Simulation simulation = new(scene, new SimulationOptions());
        long most = 10_000;
        Assert.True(simulation.TryAdvanceTo(At(1), ref most), $"at {simulation.SimulatedTo}");
    }

    private static bool IsPossible((ContactPoint[] Contacts, double[] Masses) row, double e) =>
        new InelasticCollapse().IsPossible(
            row.Contacts, row.Contacts.Select(_ => e).ToArray(), new double[row.Contacts.Length], row.Masses);

    /// <summary>Balls that touch along a line.</summary>
    private static (ContactPoint[] Contacts, double[] Masses) Row(double[] masses, bool hasWall)
    {
        ContactPoint[] pairs = [.. Enumerable.Range(1, masses.Length - 1).Select(n => new ContactPoint(n - 1, n, -1, default) { Normal = V(-1) })];
        return (hasWall ? [new ContactPoint(0, ContactPoint.Static, 0, default) { Normal = V(1) }, .. pairs] : pairs, masses);
    }
}
