using System;

namespace LagSim.Time;

/// <summary>An instant of simulation time: a whole number of ticks of 2^-40 s (0.91 ps) from an origin that a session chooses.</summary>
/// <remarks>
/// <para>It is not wall-clock time and knows no calendar. Range: about 97 days to either side of the origin, which is also
/// <c>default</c>. All arithmetic is exact and checked: what does not fit throws <see cref="OverflowException"/>.</para>
/// <para>The motion of bodies depends on differences of instants only, so a scene started at another instant gives the same bits.</para>
/// <para>Immutable, so safe on any thread. Deterministic: integers only, but for the conversions from and to <see cref="double"/>.</para>
/// </remarks>
public readonly struct SimTime : IEquatable<SimTime>, IComparable<SimTime>
{
    private SimTime(long ticks) => Ticks = ticks;

    /// <summary>Ticks of 2^-40 s since the origin.</summary>
    public long Ticks { get; }

    /// <summary>The origin; also <c>default</c>.</summary>
    public static SimTime Zero => default;

    /// <summary>The earliest instant, about 97 days before the origin.</summary>
    public static SimTime MinValue => new(long.MinValue);

    /// <summary>The latest instant, about 97 days after the origin. As the end of a motion it means "never".</summary>
    public static SimTime MaxValue => new(long.MaxValue);

    /// <summary>The instant that many ticks of 2^-40 s from the origin.</summary>
    public static SimTime FromTicks(long ticks) => new(ticks);

    /// <summary>The instant nearest to that many seconds from the origin, ties to even.</summary>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="seconds"/> is not finite, or beyond about 97 days.</exception>
    public static SimTime FromSeconds(double seconds) => new(TickConversion.FromSeconds(seconds, nameof(seconds)));

    /// <summary>
    /// Seconds from the origin: exact up to 2^13 s, beyond that the nearest <see cref="double"/>. For display, not for motion.
    /// </summary>
    public double ToSeconds() => Ticks * TickConversion.SecondsPerTick;

    /// <summary>
    /// The seconds from another time to this, rounded once; also where the span exceeds the range of a <see cref="SimDuration"/>.
    /// </summary>
    internal double SecondsSince(SimTime other)
    {
        long span = unchecked(Ticks - other.Ticks);
        bool overflows = ((Ticks ^ other.Ticks) & (Ticks ^ span)) < 0;
        return (overflows ? (double)Ticks - other.Ticks : span) * TickConversion.SecondsPerTick;
    }

    /// <summary>Reads the exact form that <see cref="ToString"/> writes: seconds in decimal with a trailing <c>s</c>.</summary>
    /// <exception cref="FormatException">The text is not of that form, or is not a whole number of ticks within the range.</exception>
    public static SimTime Parse(string text) => new(TickText.Parse(text));

    /// <summary>The exact value in decimal seconds, for example <c>12.25s</c>; never rounded, at most 40 decimals.</summary>
    public override string ToString() => TickText.Format(Ticks);

    /// <summary>
    /// For people: the fewest decimals that stand for no other instant, for example <c>0.01s</c>; at most 13. For machines see
    /// <see cref="ToString"/>.
    /// </summary>
    public string ToShortString() => TickText.Shortest(Ticks);

    /// <inheritdoc/>
    public bool Equals(SimTime other) => Ticks == other.Ticks;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is SimTime other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Ticks.GetHashCode();

    /// <inheritdoc/>
    public int CompareTo(SimTime other) => Ticks.CompareTo(other.Ticks);

    /// <summary>The later of two instants.</summary>
    public static SimTime Max(SimTime a, SimTime b) => a.Ticks >= b.Ticks ? a : b;

    /// <summary>The earlier of two instants.</summary>
    public static SimTime Min(SimTime a, SimTime b) => a.Ticks <= b.Ticks ? a : b;

    /// <summary>The instant a span later.</summary>
    /// <exception cref="OverflowException">The instant is out of range.</exception>
    public static SimTime operator +(SimTime time, SimDuration span) => new(checked(time.Ticks + span.Ticks));

    /// <summary>The instant a span earlier.</summary>
    /// <exception cref="OverflowException">The instant is out of range.</exception>
    public static SimTime operator -(SimTime time, SimDuration span) => new(checked(time.Ticks - span.Ticks));

    /// <summary>The exact span from <paramref name="b"/> to <paramref name="a"/>.</summary>
    /// <exception cref="OverflowException">The instants are further apart than the longest span.</exception>
    public static SimDuration operator -(SimTime a, SimTime b) => SimDuration.FromTicks(checked(a.Ticks - b.Ticks));

    /// <summary>Same instant.</summary>
    public static bool operator ==(SimTime a, SimTime b) => a.Ticks == b.Ticks;

    /// <summary>Different instant.</summary>
    public static bool operator !=(SimTime a, SimTime b) => a.Ticks != b.Ticks;

    /// <summary>Earlier than.</summary>
    public static bool operator <(SimTime a, SimTime b) => a.Ticks < b.Ticks;

    /// <summary>Later than.</summary>
    public static bool operator >(SimTime a, SimTime b) => a.Ticks > b.Ticks;

    /// <summary>Not later than.</summary>
    public static bool operator <=(SimTime a, SimTime b) => a.Ticks <= b.Ticks;

    /// <summary>Not earlier than.</summary>
    public static bool operator >=(SimTime a, SimTime b) => a.Ticks >= b.Ticks;
}
