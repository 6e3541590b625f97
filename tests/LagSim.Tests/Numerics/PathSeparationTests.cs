using System;
using LagSim.Collisions;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Two paths of any law that are told to be apart never touch in that span; it is told of most that do not.</summary>
public sealed class PathSeparationTests
{
    private const int Pairs = 20_000;

    [Theory]
    [InlineData(1)]
    [InlineData(1e3)]
    [InlineData(1e7)]
    public void AreApart_AnyTwo_TheFinderFindsNoContact(double far)
    {
        (int apart, int touching, int wrong) = Count(far, share: 1);
        Assert.Equal(0, wrong);
        Assert.True(touching > 2000, $"{touching} touch");
        Assert.True(far > 1e3 || apart > 0.5 * (Pairs - touching), $"{apart} are told apart, {touching} touch"); // far out rounding leaves it in doubt
    }

    [Fact]
    public void AreApart_OfSmallerBodies_IsSeenToBeWrong()
    {
        // The control: what holds for bodies a twentieth smaller does not hold for these, so the test above can fail.
        Assert.True(Count(1, share: 0.95).Wrong > 20);
    }

    [Fact]
    public void AreApart_PathsThatPart_Are()
    {
        MotionSegment left = new(MotionLaw.Ballistic, At(0), SimTime.MaxValue, V(-1), V(-1), V(0, -9.81));
        MotionSegment right = new(MotionLaw.Ballistic, At(0), SimTime.MaxValue, V(1), V(1), V(0, -9.81));
        Assert.True(PathSeparation.AreApart(left, default, right, default, 1, At(0), At(60)));
        Assert.True(PathSeparation.AreApart(right, default, left, default, 1, At(0), At(60)));
        Assert.False(PathSeparation.AreApart(left, default, right, default, 2.5, At(0), At(0))); // overlapping
        Assert.False(PathSeparation.AreApart(left, default, left, default, 1, At(0), At(1))); // the same place
    }

    private static (int Apart, int Touching, int Wrong) Count(double far, double share)
    {
        Random random = new(1);
        (int apart, int touching, int wrong) = (0, 0, 0);
        for (int n = 0; n < Pairs; n++)
        {
            double reach = 0.2 + random.NextDouble();
            SimTime from = At(100 + random.NextDouble());
            SimTime until = n % 8 == 0 ? SimTime.MaxValue : from + SimDuration.FromSeconds(Math.Pow(random.NextDouble(), 4) * (n % 4 == 0 ? 30 : 0.5));
            Vector3D there = new(far * (random.NextDouble() - 0.5), far * (random.NextDouble() - 0.5), 0);
            Vector3D towards = Near(random, 3);
            (MotionSegment a, DenseOutput denseA) = Path(random, from, there, Near(random, 6));
            (MotionSegment b, DenseOutput denseB) = Path(random, from, there + towards, (towards * -random.NextDouble() * 6) + Near(random, 3));
            bool touches = TimeOfImpact.WithSphere(a, denseA, b, denseB, reach, from, SimTime.Min(a.End, b.End), out ContactTime contact)
                && (until == SimTime.MaxValue || contact.Tick <= until + SimDuration.OneTick);
            bool areApart = PathSeparation.AreApart(a, denseA, b, denseB, reach * share, from, until);
            touching += touches ? 1 : 0;
            apart += areApart ? 1 : 0;
            wrong += touches && areApart ? 1 : 0;
        }

        return (apart, touching, wrong);
    }

    /// <summary>A fall, a slide, a rest, or a step of a curved path, which began up to half a minute before it is looked at.</summary>
    private static (MotionSegment Segment, DenseOutput Dense) Path(Random random, SimTime from, Vector3D place, Vector3D velocity)
    {
        SimTime epoch = random.Next(2) == 0 ? from : from - SimDuration.FromSeconds(Math.Pow(random.NextDouble(), 4) * 30);
        return random.Next(4) switch
        {
            0 => (new MotionSegment(MotionLaw.Ballistic, epoch, SimTime.MaxValue, place, velocity, V(0, -9.81)), default),
            1 => (new MotionSegment(MotionLaw.Sliding, epoch, from + SimDuration.FromSeconds(1), place, velocity, velocity * -0.7), default),
            2 => (MotionSegment.AtRest(epoch, place), default),
            _ => (
                new MotionSegment(MotionLaw.DormandPrince54, epoch, from + SimDuration.FromSeconds(1), place, velocity, Near(random, 20)),
                new DenseOutput(Near(random, 40), Near(random, 80), Near(random, 80))),
        };
    }

    private static Vector3D Near(Random random, double size) =>
        new(size * (random.NextDouble() - 0.5), size * (random.NextDouble() - 0.5), size * (random.NextDouble() - 0.5));
}
