using System;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Collisions;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>When two paths touch.</summary>
public sealed class TimeOfImpactTests
{
    private static readonly SimTime Until = At(4);

    private static Config Many => Config.QuickThrowOnFailure.WithMaxTest(800).WithReplay(20261121, 1);

    private static readonly Arbitrary<(MotionSegment A, DenseOutput Da, MotionSegment B, DenseOutput Db, double Reach)> Paths = (
        from a in Segment(0)
        from b in Segment(5)
        from reach in Gen.Choose(1, 3000).Select(x => x / 1000.0)
        select (a.Segment, a.Dense, b.Segment, b.Dense, reach)).ToArbitrary();

    [Fact]
    public void WithSphere_AnyTwoPaths_TouchFirstAtTheRoot()
    {
        Prop.ForAll(Paths, p =>
        {
            SimTime from = SimTime.Max(p.A.Epoch, p.B.Epoch);
            bool found = TimeOfImpact.WithSphere(p.A, p.Da, p.B, p.Db, p.Reach, from, Until, out ContactTime contact);
            double Gap(double t) => (Position(p.A, p.Da, from, t) - Position(p.B, p.Db, from, t)).Length - p.Reach;
            return IsFirst(Gap, found, contact, from);
        }).Check(Many);
    }

    [Fact]
    public void WithPlane_AnyPath_TouchesFirstAtTheRoot()
    {
        StaticPlane plane = new SceneBuilder("plane").AddPlane("plane", V(1, 2, 2), V(-3, -3, -3)).Build().Planes[0];
        Prop.ForAll(Paths, p =>
        {
            double radius = p.Reach;
            bool found = TimeOfImpact.WithPlane(p.A, p.Da, radius, plane, p.A.Epoch, Until, out ContactTime contact);
            double Gap(double t) => plane.Gap(Position(p.A, p.Da, p.A.Epoch, t), radius);
            return IsFirst(Gap, found, contact, p.A.Epoch);
        }).Check(Many);
    }

    [Fact]
    public void WithSphere_OperandsSwapped_IsTheSameInstant()
    {
        // Not the same bits in general, which is why they come ordered; but the same contact.
        Prop.ForAll(Paths, p =>
        {
            SimTime from = SimTime.Max(p.A.Epoch, p.B.Epoch);
            bool found = TimeOfImpact.WithSphere(p.A, p.Da, p.B, p.Db, p.Reach, from, Until, out ContactTime contact);
            bool swapped = TimeOfImpact.WithSphere(p.B, p.Db, p.A, p.Da, p.Reach, from, Until, out ContactTime other);
            return found == swapped && Math.Abs((contact.Tick - other.Tick).Ticks) <= 1;
        }).Check(Many);
    }

    [Fact]
    public void IsFirst_ContactAThousandTicksLate_IsSeenToFail()
    {
        MotionSegment a = Flight(V(0), V(1)), b = Flight(V(5), V(-1));
        Assert.True(TimeOfImpact.WithSphere(a, default, b, default, 1, default, Until, out ContactTime contact));
        double Gap(double t) => (a.PositionAt(t, default) - b.PositionAt(t, default)).Length - 1;
        Assert.True(IsFirst(Gap, true, contact, default));
        Assert.True(ContactTime.TryMake(default, Until, 2 + 1e-9, out ContactTime late));
        Assert.False(IsFirst(Gap, true, late, default));
        Assert.False(IsFirst(Gap, false, late, default));
    }

    [Theory]
    [InlineData(1.0, false)] // passes at exactly the sum of the radii: a graze
    [InlineData(1.0000001, false)]
    [InlineData(0.9999999, true)]
    public void WithSphere_PassingBy_IsHitOnlyWhenNearerThanTheRadii(double offset, bool hits)
    {
        MotionSegment a = Flight(V(-2, offset), V(1)), b = Flight(V(0), V(0));
        Assert.Equal(hits, TimeOfImpact.WithSphere(a, default, b, default, 1, default, Until, out _));
    }

    [Fact]
    public void WithPlane_ApexAtTheCeiling_IsAGraze()
    {
        StaticPlane ceiling = new SceneBuilder("c").AddPlane("ceiling", V(0, -1), V(0, 5)).Build().Planes[0];
        MotionSegment rising = new(MotionLaw.Ballistic, default, SimTime.MaxValue, V(0), V(0, 8), V(0, -8)); // apex at 4 m
        Assert.False(TimeOfImpact.WithPlane(rising, default, 1, ceiling, default, SimTime.MaxValue, out _));
        Assert.True(TimeOfImpact.WithPlane(rising, default, 1.000001, ceiling, default, SimTime.MaxValue, out _));
    }

    private static bool IsFirst(Func<double, double> gap, bool found, ContactTime contact, SimTime from)
    {
        const double Ulps = 2e-13; // coordinates of some ten metres, paths of degree five
        double root = found ? (contact.Tick - from).ToSeconds() + contact.Residual : (Until - from).ToSeconds();
        if (found && (Math.Abs(contact.Residual) > 0.5001 / SimDuration.TicksPerSecond || gap(root) > Ulps || (gap(0) > Ulps && gap(root) < -Ulps)))
        {
            return false;
        }

        double last = gap(0);
        for (int i = 1; i <= 1000; i++)
        {
            double now = gap(root * 0.9999999 * i / 1000);
            if (now < -Ulps && now < last - Ulps)
            {
                return false; // overlapping and closing, and no event
            }

            last = now;
        }

        return true;
    }

    private static MotionSegment Flight(Vector3D x, Vector3D v) => new(MotionLaw.Ballistic, default, SimTime.MaxValue, x, v, default);

    private static Vector3D Position(in MotionSegment segment, in DenseOutput dense, SimTime from, double t) =>
        segment.PositionAt((from - segment.Epoch).ToSeconds() + t, dense);

    private static Gen<(MotionSegment Segment, DenseOutput Dense)> Segment(double x) =>
        from law in Gen.Elements(MotionLaw.Ballistic, MotionLaw.RungeKutta4, MotionLaw.Resting, MotionLaw.Sliding)
        from epoch in Gen.Choose(0, 8)
        from d in Gen.Choose(-2000, 2000).Select(n => n / 1000.0).ArrayOf(18)
        select (
            law == MotionLaw.Resting ? MotionSegment.AtRest(At(epoch / 8.0), V(x + d[0], d[1], d[2])) : new MotionSegment(law, At(epoch / 8.0), Until, V(x + d[0], d[1], d[2]), V(d[3], d[4], d[5]), V(d[6], d[7], d[8])),
            law == MotionLaw.RungeKutta4
                ? new DenseOutput(V(d[9], d[10], d[11]), V(d[12], d[13], d[14]) * 0.1, V(d[15], d[16], d[17]) * 0.01)
                : default);
}
