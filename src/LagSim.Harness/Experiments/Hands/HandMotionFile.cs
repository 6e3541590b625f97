using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>A recorded hand motion: CSV with the header <c>time_s,x_m,y_m,z_m</c>, a row for each sample.</summary>
/// <remarks>
/// Times in seconds, rising, at most 0.1 s apart, 2 s to an hour in all, from any origin; metres within +-1,000. Brought to 120 samples a
/// second along straight lines between the recorded ones, so what is slower than that looks smoother than the hand was. Invariant culture.
/// </remarks>
public static class HandMotionFile
{
    /// <summary>The header of the columns.</summary>
    public const string Header = "time_s,x_m,y_m,z_m";

    private const double LongestGap = 0.1;
    private const double MinSeconds = 2;
    private const double MaxSeconds = 3600;
    private const double Furthest = 1000;
    private const int LongestLine = 1000;

    /// <summary>Reads a file.</summary>
    /// <exception cref="HandMotionException">The file does not exist, cannot be read, or holds no hand motion.</exception>
    public static HandMotion Read(string path)
    {
        ArgumentNullException.ThrowIfNull(path);
        try
        {
            using StreamReader file = new(path);
            return Read(file, path);
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException or ArgumentException or NotSupportedException)
        {
            throw new HandMotionException($"The hand motion '{path}' cannot be read: {failure.Message}", failure);
        }
    }

    /// <summary>Parses the content of a file.</summary>
    /// <param name="text">The text. The caller closes it.</param>
    /// <param name="name">The name for error messages.</param>
    /// <exception cref="HandMotionException">The text holds no hand motion.</exception>
    public static HandMotion Read(TextReader text, string name)
    {
        ArgumentNullException.ThrowIfNull(text);
        ArgumentException.ThrowIfNullOrEmpty(name);
        string? header = text.ReadLine();
        if (header != Header)
        {
            throw Fault(name, 1, header is null ? $"the file is empty; it must begin with '{Header}'" : $"the header is '{Clip(header)}'; it must be"
                + $" '{Header}'");
        }

        List<Vector3D> samples = [];
        double start = 0, lastTime = 0;
        Vector3D last = default;
        int line = 1;
        while (text.ReadLine() is string row)
        {
            line++;
            if (row.Length == 0 && text.Peek() < 0)
            {
                break; // an empty line at the end is no row
            }

            double[] numbers = Numbers(row, name, line);
            Vector3D at = new(numbers[1], numbers[2], numbers[3]);
            if (line == 2)
            {
                (start, lastTime, last) = (numbers[0], numbers[0], at);
                samples.Add(at);
                continue;
            }

            CheckTime(numbers[0], start, lastTime, name, line);
            for (double next; (next = start + (samples.Count / (double)HandMotion.RateHertz)) <= numbers[0];)
            {
                samples.Add(last + ((at - last) * ((next - lastTime) / (numbers[0] - lastTime))));
            }

            (lastTime, last) = (numbers[0], at);
        }

        return lastTime - start >= MinSeconds
            ? new HandMotion(name, samples)
            : throw Fault(name, line, FormattableString.Invariant($"the motion lasts {lastTime - start} s; it must last at least {MinSeconds} s"));
    }

    private static void CheckTime(double time, double start, double last, string name, int line)
    {
        if (!(time > last) || time - last > LongestGap)
        {
            throw Fault(name, line, FormattableString.Invariant($"time_s is {time} after {last}; it must rise, by at most {LongestGap} s"));
        }

        if (time - start > MaxSeconds)
        {
            throw Fault(name, line, FormattableString.Invariant($"time_s is {time}, {time - start} s after the first; at most {MaxSeconds} s are allowed"));
        }
    }

    private static double[] Numbers(string row, string name, int line)
    {
        string[] columns = Header.Split(',');
        string[] fields = row.Length <= LongestLine ? row.Split(',') : throw Fault(name, line, $"the line has {row.Length} characters; at most {LongestLine}"
            + " are allowed");
        if (fields.Length != columns.Length)
        {
            throw Fault(name, line, $"'{Clip(row)}' has {fields.Length} values; there must be {columns.Length}: {Header}");
        }

        double[] numbers = new double[columns.Length];
        for (int i = 0; i < numbers.Length; i++)
        {
            double most = i == 0 ? 1e9 : Furthest;
            if (!double.TryParse(fields[i], NumberStyles.Float, CultureInfo.InvariantCulture, out numbers[i]) || !(Math.Abs(numbers[i]) <= most))
            {
                throw Fault(name, line, FormattableString.Invariant($"{columns[i]} is '{Clip(fields[i])}'; it must be a number between {-most} and {most}"));
            }
        }

        return numbers;
    }

    private static string Clip(string text) => text.Length <= 100 ? text : text[..100] + "...";

    private static HandMotionException Fault(string name, int line, string problem) => new($"{name}: line {line}: {problem}.");
}
