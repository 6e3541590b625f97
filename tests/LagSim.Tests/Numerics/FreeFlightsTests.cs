using System;
using LagSim.Collisions;
using LagSim.Events;
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

    [Theory]
    [InlineData(1)]
    [InlineData(1e3)]
    [InlineData(1e7)]
    public void Approaches_AnyTwo_AreNoLaterThanTheContactThatTheFinderFinds(double far)
    {
        Random random = new(2);
        int touching = 0, left = 0;
        for (int n = 0; n < 20_000; n++)
        {
            Pair pair = new(random, far, V(0, -9.81));
            Span<Approach> approaches = pair.Flights.Approaches(1, [0, 1], pair.From, pair.Until);
            if (pair.Touches(pair.From, pair.Until, out ContactTime contact))
            {
                Assert.True(approaches.Length == 1 && approaches[0].Slot == 0, $"pair {n}");
                Assert.False(FreeFlights.IsLater(approaches[0].Seconds, pair.From, contact.Tick), $"pair {n}");
                touching++;
            }

            left += approaches.Length == 0 ? 1 : 0;
        }

        Assert.True(touching > 3000, $"{touching} touch");
        Assert.True(far > 1e3 || left > 0.7 * (20_000 - touching), $"{left} are left out, {touching} touch");
    }

    [Fact]
    public void Approaches_WithAnotherGravity_AreSeenToMiss()
    {
        Random random = new(2);
        int missed = 0;
        for (int n = 0; n < 20_000; n++)
        {
            Pair pair = new(random, 1, V(0, -9.81), bentOtherwise: V(0, 5));
            missed += pair.Touches(pair.From, pair.Until, out _) && pair.Flights.Approaches(1, [0], pair.From, pair.Until).Length == 0 ? 1 : 0;
        }

        Assert.True(missed > 50, $"{missed} of 20,000");
    }

    [Theory]
    [InlineData(-9.81)]
    [InlineData(0)]
    public void TryTouch_AnyTwo_TellsTheBitsOfTheFinder(double gravity)
    {
        Random random = new(3);
        int touching = 0, elsewhere = 0;
        for (int n = 0; n < 20_000; n++)
        {
            Pair pair = new(random, 10, V(0, gravity));
            bool touches = pair.Touches(pair.From, SimTime.MaxValue, out ContactTime contact);
            bool isTold = pair.Flights.TryTouch(0, 1, out bool told, out ContactTime when);
            Assert.Equal(touches && contact.Tick == pair.From, !isTold);
            if (isTold)
            {
                Assert.Equal((touches, contact.Tick, contact.Residual), (told, when.Tick, when.Residual));
                touching += touches ? 1 : 0;
            }

            pair.Flights.StateAt(0, pair.From, contact.Residual, out Vector3D position, out Vector3D velocity);
            Assert.Equal(pair.StateAt(pair.From, contact.Residual), (position, velocity));
            pair.Flights.SetRadius(0, pair.Radius * (1 + 1e-15));
            elsewhere += isTold && pair.Flights.TryTouch(0, 1, out _, out ContactTime other) && other.Residual != when.Residual ? 1 : 0;
        }

        Assert.True(touching > 3000, $"{touching} touch");
        Assert.True(elsewhere > 1000, $"{elsewhere} where a radius differs in its last bits"); // the control
    }

    [Fact]
    public void Misses_AnyPlane_TheFinderFindsNoContact()
    {
        Random random = new(4);
        int missed = 0, touching = 0, wrong = 0;
        for (int n = 0; n < 20_000; n++)
        {
            Pair pair = new(random, 3, V(0, -9.81));
            Vector3D normal = V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5);
            normal /= normal.Length;
            StaticPlane plane = new("plane", normal, random.NextDouble() * -4, 1, 0);
            bool misses = pair.Flights.Misses(0, plane, pair.From, pair.Until);
            bool touches = pair.TouchesPlane(plane);
            Assert.False(misses && touches, $"pair {n}");
            wrong += touches && pair.Flights.Misses(0, new StaticPlane("lower", normal, plane.Offset - 0.1, 1, 0), pair.From, pair.Until) ? 1 : 0;
            missed += misses ? 1 : 0;
            touching += touches ? 1 : 0;
        }

        Assert.True(touching > 2000 && missed > 2000, $"{touching} touch, {missed} miss");
        Assert.True(wrong > 0, "a plane a tenth of a metre lower is missed by nobody who touches"); // the control
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
    public void AreApart_WhatItIsNotTold_IsInDesyncQuery()
    {
        FreeFlights flights = Two(V(0, -1), default);
        Assert.True(flights.AreApart(0, 1, At(1), At(2)));
        Assert.False(flights.AreApart(0, 1, At(0.5), At(2))); // one was elsewhere then
        flights.Set(1, MotionSegment.AtRest(At(1), V(100)), At(1));
        Assert.True(flights.AreApart(0, 1, At(1), At(2)));
        Assert.False(flights.AreApart(0, 1, At(1), At(100))); // by then the other may have fallen as far
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
    public void AreApart_WithinTheDistanceThatIsNear_IsInDesyncQuery()
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
        private readonly double radius;

        internal Pair(Random random, double far, Vector3D gravity, Vector3D bentOtherwise = default)
        {
            Vector3D Draw(double size) => V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5) * (2 * size);
            Vector3D place = Draw(far);
            radius = 0.05 + random.NextDouble();
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

        internal double Radius => radius;

        internal SimTime From { get; }

        internal SimTime Until { get; }

        internal bool Touches(SimTime from, SimTime until) => Touches(from, until, out _);

        internal bool Touches(SimTime from, SimTime until, out ContactTime contact) => TimeOfImpact.WithSphere(a, default, b, default, reach, from, until, out contact);

        internal bool TouchesPlane(in StaticPlane plane) => TimeOfImpact.WithPlane(a, default, radius, plane, From, Until, out _);

        internal (Vector3D Position, Vector3D Velocity) StateAt(SimTime time, double after)
        {
            double seconds = time.SecondsSince(a.Epoch) + after;
            return (a.PositionAt(seconds, default), a.VelocityAt(seconds, default));
        }
    }
}
