using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Hands;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Hands;

/// <summary>The generated motions are what they say, and stay it.</summary>
public sealed class HandMotionTests(ITestOutputHelper output)
{
    [Theory]
    [InlineData(HandMotions.Slow, 0.8, 1.5, 4, 10)]
    [InlineData(HandMotions.Random, 2, 3.5, 35, 60)]
    public void Generate_AnySeed_MovesAsFastAsItsDescriptionSays(string name, double minSpeed, double maxSpeed, double minAcceleration, double maxAcceleration)
    {
        foreach (ulong seed in new ulong[] { 1, 2, 3, ulong.MaxValue })
        {
            HandMotion motion = HandMotions.Generate(name, seed);
            double speed = Enumerable.Range(0, motion.Count).Max(n => motion.VelocityAt(n).Length);
            output.WriteLine($"{name} {seed}: {speed:0.###} m/s, {motion.LargestAcceleration():0.###} m/s^2");
            Assert.Equal(7201, motion.Count);
            Assert.Equal(HandMotions.Seconds, motion.Seconds);
            Assert.InRange(speed, minSpeed, maxSpeed);
            Assert.InRange(motion.LargestAcceleration(), minAcceleration, maxAcceleration);
            Assert.All(Positions(motion), at => Assert.InRange(at.Length, 0, 1));
        }
    }

    [Fact]
    public void Generate_SameSeed_SameBits()
    {
        foreach (string name in HandMotions.Names)
        {
            Assert.Equal(Positions(HandMotions.Generate(name, 5)), Positions(HandMotions.Generate(name, 5)));
            Assert.NotEqual(Positions(HandMotions.Generate(name, 5)), Positions(HandMotions.Generate(name, 6)));
        }
    }

    [Fact]
    public void Generate_Stillness_TremblesByAThirdOfAMillimetre()
    {
        // The first tenth of a second holds no stroke.
        double[] squares = Enumerable.Range(1, 300)
            .SelectMany(seed => Positions(HandMotions.Generate(HandMotions.Slow, (ulong)seed)).Take(1)).Select(at => at.LengthSquared / 3).ToArray();
        Assert.InRange(Math.Sqrt(squares.Average()), 0.00028, 0.00032);
    }

    [Fact]
    public void Generate_UnknownName_IsRefusedByName() =>
        Assert.Contains("'fast'", Assert.Throws<ArgumentException>(() => HandMotions.Generate("fast", 1)).Message, StringComparison.Ordinal);

    [Fact]
    public void LargestAcceleration_OfAParabola_IsItsOwn()
    {
        HandMotion motion = new("parabola", Enumerable.Range(0, 50).Select(n => new Vector3D(0, 4.0 * n * n / (2 * 120 * 120), 0)).ToArray());
        Assert.Equal(4, motion.LargestAcceleration(), 1e-9);
    }

    private static IEnumerable<Vector3D> Positions(HandMotion motion) => Enumerable.Range(0, motion.Count).Select(motion.PositionAt);
}
