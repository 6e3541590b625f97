using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>
/// The generated motions of a hand: 60 s each, by a seed. Their parameters were set before any predictor was tried on them.
/// </summary>
/// <remarks>
/// <para><c>slow</c>: reaches to places in a box of 0.6 x 0.4 x 0.4 m, each in 0.8 to 1.6 s, after every other a pause of up to 0.5 s: at
/// most about 1.3 m/s and 8 m/s^2.</para>
/// <para><c>random</c>: half of it are series of quick reaches, which may begin before the last has ended, three tenths are shaking at 2.3
/// to 5 Hz, and two tenths are stillness: at most about 3 m/s and 50 m/s^2. Nothing announces what comes next.</para>
/// <para>Both tremble by 0.3 mm. The same seed gives the same bits everywhere.</para>
/// </remarks>
public static class HandMotions
{
    /// <summary>The name of the slow motion.</summary>
    public const string Slow = "slow";

    /// <summary>The name of the random motion.</summary>
    public const string Random = "random";

    /// <summary>The duration of a generated motion, in seconds.</summary>
    public const double Seconds = 60;

    private static readonly Vector3D HalfBox = new(0.3, 0.2, 0.2);

    /// <summary>The names of the generated motions.</summary>
    public static IReadOnlyList<string> Names { get; } = [Slow, Random];

    /// <summary>Generates the motion of a name.</summary>
    /// <exception cref="ArgumentException">There is no such name.</exception>
    public static HandMotion Generate(string name, ulong seed)
    {
        SeededRandom luck = new(seed);
        StrokeSequence strokes = name switch
        {
            Slow => Reaches(luck.Fork(1)),
            Random => Anything(luck.Fork(2)),
            _ => throw new ArgumentException($"'{name}' is no generated hand motion; there are {string.Join(", ", Names)}.", nameof(name)),
        };
        return strokes.Sample(name, Seconds, luck.Fork(3));
    }

    private static StrokeSequence Reaches(SeededRandom luck)
    {
        StrokeSequence strokes = new();
        double time = luck.NextDouble(0.1, 0.6);
        while (time < Seconds)
        {
            double duration = luck.NextDouble(0.8, 1.6);
            strokes.Add(time, duration, Place(luck) - strokes.Goal);
            time += duration + (luck.NextDouble() < 0.5 ? luck.NextDouble(0, 0.5) : 0);
        }

        return strokes;
    }

    private static StrokeSequence Anything(SeededRandom luck)
    {
        StrokeSequence strokes = new();
        double time = luck.NextDouble(0.1, 0.6);
        while (time < Seconds)
        {
            double what = luck.NextDouble();
            time = what < 0.5 ? QuickReaches(strokes, time, luck) : what < 0.8 ? Shaking(strokes, time, luck) : time + luck.NextDouble(0.1, 0.6);
        }

        return strokes;
    }

    /// <summary>Two to six reaches, longer in time over longer distances. The next begins when 60 to 110 % of one are over.</summary>
    private static double QuickReaches(StrokeSequence strokes, double time, SeededRandom luck)
    {
        for (int n = 2 + (int)(luck.NextDouble() * 5); n > 0; n--)
        {
            Vector3D way = Place(luck) - strokes.Goal;
            double duration = (0.15 + (0.5 * way.Length)) * luck.NextDouble(0.8, 1.4);
            strokes.Add(time, duration, way);
            time += duration * luck.NextDouble(0.6, 1.1);
        }

        return time;
    }

    /// <summary>Shakes along one line, 3 to 8 cm, with strokes of 100 to 220 ms that each vary a little.</summary>
    private static double Shaking(StrokeSequence strokes, double time, SeededRandom luck)
    {
        Vector3D line = new(luck.NextGaussian(), luck.NextGaussian(), luck.NextGaussian());
        Vector3D way = line * (luck.NextDouble(0.03, 0.08) / line.Length);
        double duration = luck.NextDouble(0.1, 0.22);
        for (int n = 2 * (2 + (int)(luck.NextDouble() * 5)); n > 0; n--)
        {
            double stroke = duration * luck.NextDouble(0.9, 1.1);
            strokes.Add(time, stroke, way * luck.NextDouble(0.85, 1.15));
            way = -way;
            time += stroke;
        }

        return time;
    }

    private static Vector3D Place(SeededRandom luck) =>
        new(luck.NextDouble(-1, 1) * HalfBox.X, luck.NextDouble(-1, 1) * HalfBox.Y, luck.NextDouble(-1, 1) * HalfBox.Z);
}
