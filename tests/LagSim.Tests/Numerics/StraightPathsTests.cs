using System;
using LagSim.Collisions;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Two of which one rests or slides and that are told to be apart never touch; it is told of most that do not, if they are on a line as seen from each other.</summary>
public sealed class StraightPathsTests
{
    private const double Near = 1e-6;
    private static readonly Vector3D Gravity = V(0, -9.81);

    [Theory]
    [InlineData(MotionLaw.Sliding, MotionLaw.Sliding, 0.7)]
    [InlineData(MotionLaw.Sliding, MotionLaw.Resting, 0.7)]
    [InlineData(MotionLaw.Resting, MotionLaw.Resting, 0.7)]
    [InlineData(MotionLaw.Ballistic, MotionLaw.Resting, 0)]
    [InlineData(MotionLaw.Sliding, MotionLaw.Ballistic, 0)]
    public void AreApart_AnyTwo_TheFinderFindsNoContact(MotionLaw law, MotionLaw other, double told)
    {
        (int apart, int touching, int wrong, int missed) = Try(law, other, fromRest: false, bend: Vector3D.Zero);
        Assert.Equal(0, wrong);
        Assert.True(law == MotionLaw.Resting || touching > 300, $"{touching} touch");
        Assert.True(apart >= told * missed, $"{apart} of {missed} are told apart");
    }

    [Fact]
    public void AreApart_OneBeginsToFallBesideAnotherAtRest_IsToldOfAllThatMiss()
    {
        (int apart, int touching, int wrong, int missed) = Try(MotionLaw.Ballistic, MotionLaw.Resting, fromRest: true, bend: Vector3D.Zero);
        Assert.Equal(0, wrong);
        Assert.True(touching > 200, $"{touching} touch");
        Assert.True(apart > 0.7 * missed, $"{apart} of {missed} are told apart");
    }

    [Theory]
    [InlineData(MotionLaw.Sliding, MotionLaw.Sliding, false)]
    [InlineData(MotionLaw.Ballistic, MotionLaw.Resting, true)]
    public void AreApart_OnAnotherPathThanWasTold_IsWrong(MotionLaw law, MotionLaw other, bool fromRest) =>
        Assert.True(Try(law, other, fromRest, bend: V(0.5, 8)).Wrong > 20); // the control

    [Fact]
    public void AreApart_OfWhoSlidesNoMore_IsNotTold()
    {
        FreeFlights flights = new(Gravity, Near, default, 2);
        flights.AddSlot(0, 0.5);
        flights.AddSlot(1, 0.5);
        flights.Set(0, Path(MotionLaw.Sliding, V(0, 0), V(1, 0), default), SimTime.Zero);
        flights.Set(1, Path(MotionLaw.Resting, V(0, 5), default, default), SimTime.Zero);
        Assert.True(flights.AreApart(0, 1, SimTime.Zero, SimTime.MaxValue));
        flights.Set(0, Path(MotionLaw.Rolling, V(0, 0), V(1, 0), V(-1, 0)), SimTime.Zero);
        Assert.False(flights.AreApart(0, 1, SimTime.Zero, SimTime.MaxValue));
        flights.Set(0, Path(MotionLaw.Sliding, V(0, 0), V(1, 0), default), SimTime.Zero);
        flights.Clear(1);
        Assert.False(flights.AreApart(0, 1, SimTime.Zero, SimTime.MaxValue));
    }

    private static (int Apart, int Touching, int Wrong, int Missed) Try(MotionLaw law, MotionLaw otherLaw, bool fromRest, Vector3D bend)
    {
        Random random = new(7);
        int apart = 0, touching = 0, wrong = 0, missed = 0;
        for (int n = 0; n < 20_000; n++)
        {
            Vector3D Draw(double size) => V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5) * (2 * size);
            double radius = 0.05 + random.NextDouble();
            double reach = radius + 0.05 + random.NextDouble();
            bool isLater = !fromRest && law != MotionLaw.Ballistic && otherLaw != MotionLaw.Ballistic;
            SimTime from = isLater ? At(random.NextDouble()) : SimTime.Zero;
            SimTime until = random.Next(4) == 0 ? SimTime.MaxValue : from + SimDuration.FromSeconds(2 * random.NextDouble());
            Vector3D miss = Draw(1);
            Vector3D place = Draw(100);
            Vector3D away = miss * (reach * (1 + (random.Next(3) == 0 ? Math.Pow(10, -random.Next(2, 14)) : 4 * random.NextDouble())) / miss.Length);
            MotionSegment a = Path(law, place, fromRest ? default : Draw(5), law == MotionLaw.Ballistic ? Gravity : default);
            MotionSegment b = Path(otherLaw, place + away, fromRest ? default : Draw(5), otherLaw == MotionLaw.Ballistic ? Gravity : default);
            FreeFlights flights = new(Gravity, Near, default);
            flights.AddSlot(0, radius);
            flights.AddSlot(1, reach - radius);
            flights.Set(0, a, SimTime.Zero);
            flights.Set(1, b, SimTime.Zero);
            MotionSegment bent = new(a.Law, a.Epoch, a.End, a.Position, a.Velocity, a.Acceleration + bend);
            bool touches = TimeOfImpact.WithSphere(bent, default, b, default, reach, from, until, out _);
            bool isTold = flights.AreApart(0, 1, from, until);
            (apart, touching) = (apart + (isTold ? 1 : 0), touching + (touches ? 1 : 0));
            (wrong, missed) = (wrong + (isTold && touches ? 1 : 0), missed + (touches ? 0 : 1));
        }

        return (apart, touching, wrong, missed);
    }

    private static MotionSegment Path(MotionLaw law, Vector3D place, Vector3D velocity, Vector3D acceleration) =>
        new(law, SimTime.Zero, SimTime.MaxValue, place, law == MotionLaw.Resting ? Vector3D.Zero : velocity, acceleration);
}
