using System;
using System.Collections.Generic;
using System.Globalization;

namespace LagSim.Play;

/// <summary>A number of a set-up: its name in a link, its range, and how it is read and written. The page's sliders have these ranges.</summary>
/// <param name="Name">Its name in a link.</param>
/// <param name="Least">The least that it may be.</param>
/// <param name="Most">The most that it may be.</param>
/// <param name="Get">Takes it from a set-up.</param>
/// <param name="Set">Returns a set-up that has another.</param>
/// <param name="IsWhole">Whether it has no fraction.</param>
/// <param name="IsOfLink">Whether a link profile has its own.</param>
internal sealed record SetupNumber(
    string Name, double Least, double Most, Func<PlaySetup, double> Get, Func<PlaySetup, double, PlaySetup> Set,
    bool IsWhole = false, bool IsOfLink = false)
{
    /// <summary>All that there are, in the order in which a link has them.</summary>
    internal static IReadOnlyList<SetupNumber> All { get; } =
    [
        new("seed", 0, 1L << 53, s => s.Seed, (s, v) => s with { Seed = (ulong)v }, IsWhole: true),
        OfLink("delay", 0, 2000, l => l.DelayMilliseconds, (l, v) => l with { DelayMilliseconds = v }),
        OfLink("jitter", 0, 500, l => l.JitterMilliseconds, (l, v) => l with { JitterMilliseconds = v }),
        OfLink("loss", 0, 50, l => l.LossPercent, (l, v) => l with { LossPercent = v }),
        OfLink("burst", 1, 20, l => l.MeanBurstLength, (l, v) => l with { MeanBurstLength = v }),
        OfLink("asymmetry", -4000, 4000, l => l.AsymmetryMilliseconds, (l, v) => l with { AsymmetryMilliseconds = v }),
        OfLink("clock", -10_000, 10_000, l => l.ClockOffsetMilliseconds, (l, v) => l with { ClockOffsetMilliseconds = v }),
        new("ahead", 20, 1000, s => s.LookAheadMilliseconds, (s, v) => s with { LookAheadMilliseconds = v }),
        new("lag", 0, 500, s => s.LocalLagMilliseconds, (s, v) => s with { LocalLagMilliseconds = v }),
        new("smooth", 0, 1, s => s.IsSmooth ? 1 : 0, (s, v) => s with { IsSmooth = v != 0 }, IsWhole: true),
        new("speed", 0.05, 2, s => s.Speed, (s, v) => s with { Speed = v }),
    ];

    /// <summary>A value as a link has it; <see cref="Read"/> reads the same back.</summary>
    internal string Text(double value) =>
        IsWhole ? ((long)value).ToString(CultureInfo.InvariantCulture) : value.ToString("R", CultureInfo.InvariantCulture);

    /// <summary>Returns a set-up that has the number of a text.</summary>
    /// <exception cref="FormatException">It is no number, or out of range; the message says what is allowed.</exception>
    internal PlaySetup Read(PlaySetup setup, string text) =>
        double.TryParse(text, NumberStyles.Float, CultureInfo.InvariantCulture, out double value) && value >= Least && value <= Most
                && (!IsWhole || Math.Floor(value) == value)
            ? Set(setup, value)
            : throw new FormatException(string.Create(
                CultureInfo.InvariantCulture, $"'{Name}' is '{text}'; it must be a {(IsWhole ? "whole " : "")}number from {Least} to {Most}."));

    private static SetupNumber OfLink(
        string name, double least, double most, Func<LinkSettings, double> get, Func<LinkSettings, double, LinkSettings> set) =>
        new(name, least, most, s => get(s.Link), (s, v) => s with { Link = set(s.Link, v) }, IsOfLink: true);
}
