using System;
using LagSim.Contacts;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Two that are told to be apart never touch; it is told of most that do not.</summary>
public sealed class FreeFlightsTests
{
    private const double Near = 1e-6;

    [Theory]
    [InlineData(1)]
    [InlineData(1e3)]
    [InlineData(1e7)]
    public void AreApart_AnyTwo_TheFinderFindsNoContact(double far)
    {
        Random random = new(1);
        int apart = 0, touching = 0;
        for (int n = 0; n < 20_000; n++)
        {
            Pair pair = new(random, far, V(0, -9.81));
            bool touches = pair.Touches(pair.From, pair.Until);
            bool areApart = pair.Flights.AreApart(0, 1, pair.From, pair.Until);
            Assert.False(touches && areApart, $"pair {n}");
            touching += touches ? 1 : 0;
            apart += areApart ? 1 : 0;
        }

        Assert.True(touching > 3000, $"{touching} touch");
        Assert.True(far > 1e3 || apart > 0.7 * (20_000 - touching), $"{apart} are told apart, {touching} touch"); // where it is close, or far out, rounding leaves it in doubt
    }

    [Fact]
    public void AreApart_WithAnotherGravity_IsSeenToBeWrong()
    {
        // The control: paths that are bent otherwise do touch where straight ones would not, so the test above can fail.
        Random random = new(1);
        int wrong = 0;
        for (int n = 0; n < 20_000; n++)
        {
            Pair pair = new(random, 1, V(0, -9.81), bentOtherwise: V(0, 5));
            wrong += pair.Touches(pair.From, pair.Until) && pair.Flights.AreApart(0, 1, pair.From, pair.Until) ? 1 : 0;
        }

        Assert.True(wrong > 50, $"{wrong} of 20,000");
    }

    [Fact]
    public void AreApart_WhatItIsNotTold_IsInDoubt()
    {
        FreeFlights flights = Two(V(0, -1), default);
        Assert.True(flights.AreApart(0, 1, At(1), At(2)));
        Assert.False(flights.AreApart(0, 1, At(0.5), At(2))); // one was elsewhere then
        flights.Set(1, MotionSegment.AtRest(At(1), V(100)), At(1));
        Assert.False(flights.AreApart(0, 1, At(1), At(2)));
        flights.Set(1, Flight(At(1), V(100), V(0), V(0, -2)), At(1));
        Assert.False(flights.AreApart(0, 1, At(1), At(2)));
        flights.Set(1, Flight(At(0.5), V(100), V(0), V(0, -1)), At(1)); // a path taken over
        Assert.False(flights.AreApart(0, 1, At(1), At(2)));
        flights.Clear(1);
        Assert.False(flights.AreApart(0, 1, At(1), At(2)));
    }

    [Fact]
    public void AreApart_InAPeriodicBox_GoesByTheNearestImage()
    {
        FreeFlights flights = Two(V(0), new PeriodicBox(V(100.5, 100.5, 100.5)));
        Assert.False(flights.AreApart(0, 1, At(1), At(2)));
    }

    [Fact]
    public void AreApart_WithinTheDistanceThatIsNear_IsInDoubt()
    {
        FreeFlights flights = new(V(0), 0.5, default);
        flights.AddSlot(0, 1);
        flights.AddSlot(1, 1);
        flights.Set(0, Flight(At(0), V(0), V(0), V(0)), At(0));
        flights.Set(1, Flight(At(0), V(2.4), V(0), V(0)), At(0));
        Assert.False(flights.AreApart(0, 1, At(0), At(1)));
        flights.Set(1, Flight(At(0), V(2.6), V(0), V(0)), At(0));
        Assert.True(flights.AreApart(0, 1, At(0), At(1)));
        flights.SetRadius(1, 1.2);
        Assert.False(flights.AreApart(0, 1, At(0), At(1)));
    }

    private static FreeFlights Two(Vector3D gravity, PeriodicBox box)
    {
        FreeFlights flights = new(gravity, Near, box);
        flights.AddSlot(0, 0.3);
        flights.AddSlot(1, 0.3);
        flights.Set(0, Flight(At(0), V(0), V(0), gravity), At(0));
        flights.Set(1, Flight(At(1), V(100), V(0), gravity), At(1));
        return flights;
    }

    private static MotionSegment Flight(SimTime epoch, Vector3D position, Vector3D velocity, Vector3D gravity) =>
        new(MotionLaw.Ballistic, epoch, SimTime.MaxValue, position, velocity, gravity);

    /// <summary>Two that fly about a place far from the origin, so that they touch every few times.</summary>
    private sealed class Pair
    {
        private readonly MotionSegment a;
        private readonly MotionSegment b;
        private readonly double reach;

        internal Pair(Random random, double far, Vector3D gravity, Vector3D bentOtherwise = default)
        {
            Vector3D Draw(double size) => V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5) * (2 * size);
            Vector3D place = Draw(far);
            double radius = 0.05 + random.NextDouble();
            double otherRadius = 0.05 + random.NextDouble();
            SimTime openedA = At(random.NextDouble());
            From = openedA + SimDuration.FromSeconds(random.NextDouble());
            Until = random.Next(4) == 0 ? SimTime.MaxValue : From + SimDuration.FromSeconds(random.NextDouble());
            a = Flight(openedA, place, Draw(5), gravity);
            reach = radius + otherRadius;

            // The other comes by after a while, at a distance that is about, or all but, the sum of the radii.
            double after = random.NextDouble();
            Vector3D closing = Draw(3);
            Vector3D across = Vector3D.Cross(closing, Draw(1));
            double miss = random.Next(2) == 0 ? 3 * random.NextDouble() : 1 + (Math.Pow(10, -random.Next(2, 14)) * (random.Next(3) - 1));
            double seconds = From.SecondsSince(a.Epoch);
            b = Flight(
                From, a.PositionAt(seconds, default) + (closing * after) + (across * (reach * miss / across.Length)), a.VelocityAt(seconds, default) - closing,
                gravity + bentOtherwise);
            Flights = new FreeFlights(gravity, Near, default);
            Flights.AddSlot(0, radius);
            Flights.AddSlot(1, otherRadius);
            Flights.Set(0, a, openedA);
            Flights.Set(1, Flight(From, b.Position, b.Velocity, gravity), From);
        }

        internal FreeFlights Flights { get; }

        internal SimTime From { get; }

        internal SimTime Until { get; }

        internal bool Touches(SimTime from, SimTime until) => ContactFinder.WithSphere(a, default, b, default, reach, from, until, out _);
    }
}
