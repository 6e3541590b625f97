using System;

namespace LagSim.Time;

/// <summary>A signed span of simulation time: a whole number of ticks of 2^-40 s (0.91 ps).</summary>
/// <remarks>
/// <para>Range: about plus or minus 97 days. <c>default</c> is zero. All arithmetic is exact and checked: what does not fit throws
/// <see cref="OverflowException"/>, nothing wraps or saturates.</para>
/// <para>Immutable, so safe on any thread. Deterministic: integers only, but for the two conversions from and to <see cref="double"/>,
/// each of which rounds once.</para>
/// </remarks>
public readonly struct SimDuration : IEquatable<SimDuration>, IComparable<SimDuration>
{
    /// <summary>Ticks in a second: 2^40.</summary>
    public const long TicksPerSecond = 1L << 40;

    private SimDuration(long ticks) => Ticks = ticks;

    /// <summary>The length in ticks of 2^-40 s.</summary>
    public long Ticks { get; }

    /// <summary>No time at all; also <c>default</c>.</summary>
    public static SimDuration Zero => default;

    /// <summary>The shortest positive span: 2^-40 s.</summary>
    public static SimDuration OneTick => new(1);

    /// <summary>The longest span, about 97 days.</summary>
    public static SimDuration MaxValue => new(long.MaxValue);

    /// <summary>A span of that many ticks of 2^-40 s.</summary>
    public static SimDuration FromTicks(long ticks) => new(ticks);

    /// <summary>The span nearest to that many seconds, ties to even.</summary>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="seconds"/> is not finite, or beyond about 97 days.</exception>
    public static SimDuration FromSeconds(double seconds) => new(TickConversion.FromSeconds(seconds, nameof(seconds)));

    /// <summary>The span of that many milliseconds: a thousandth of the number, rounded to a <see cref="double"/>, as seconds.</summary>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="milliseconds"/> is not finite, or beyond about 97 days.</exception>
    public static SimDuration FromMilliseconds(double milliseconds) =>
        new(TickConversion.FromSeconds(milliseconds / 1000.0, nameof(milliseconds)));

    /// <summary>The length in seconds: exact up to 2^13 s (2 h 16 min), beyond that the nearest <see cref="double"/>.</summary>
    public double ToSeconds() => Ticks * TickConversion.SecondsPerTick;

    /// <summary>The length in milliseconds, rounded to a <see cref="double"/>; for display and waits, not for motion.</summary>
    public double ToMilliseconds() => Ticks * TickConversion.SecondsPerTick * 1000.0;

    /// <summary>Reads the exact form that <see cref="ToString"/> writes: seconds in decimal with a trailing <c>s</c>.</summary>
    /// <exception cref="FormatException">The text is not of that form, or is not a whole number of ticks within the range.</exception>
    public static SimDuration Parse(string text) => new(TickText.Parse(text));

    /// <summary>The exact value in decimal seconds, for example <c>0.5s</c>; never rounded, at most 40 decimals.</summary>
    public override string ToString() => TickText.Format(Ticks);

    /// <summary>
    /// For people: the fewest decimals that stand for no other length, for example <c>0.01s</c>; at most 13. For machines see
    /// <see cref="ToString"/>.
    /// </summary>
    public string ToShortString() => TickText.Shortest(Ticks);

    /// <inheritdoc/>
    public bool Equals(SimDuration other) => Ticks == other.Ticks;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is SimDuration other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Ticks.GetHashCode();

    /// <inheritdoc/>
    public int CompareTo(SimDuration other) => Ticks.CompareTo(other.Ticks);

    /// <summary>The exact sum.</summary>
    /// <exception cref="OverflowException">The sum is out of range.</exception>
    public static SimDuration operator +(SimDuration a, SimDuration b) => new(checked(a.Ticks + b.Ticks));

    /// <summary>The exact difference.</summary>
    /// <exception cref="OverflowException">The difference is out of range.</exception>
    public static SimDuration operator -(SimDuration a, SimDuration b) => new(checked(a.Ticks - b.Ticks));

    /// <summary>The span with its sign changed.</summary>
    /// <exception cref="OverflowException">The span is the lowest there is.</exception>
    public static SimDuration operator -(SimDuration a) => new(checked(-a.Ticks));

    /// <summary>The span, a whole number of times.</summary>
    /// <exception cref="OverflowException">The product is out of range.</exception>
    public static SimDuration operator *(SimDuration a, long times) => new(checked(a.Ticks * times));

    /// <summary>The span divided by a whole number, rounded towards zero.</summary>
    /// <exception cref="DivideByZeroException"><paramref name="parts"/> is zero.</exception>
    public static SimDuration operator /(SimDuration a, long parts) => new(checked(a.Ticks / parts));

    /// <summary>Same length.</summary>
    public static bool operator ==(SimDuration a, SimDuration b) => a.Ticks == b.Ticks;

    /// <summary>Different length.</summary>
    public static bool operator !=(SimDuration a, SimDuration b) => a.Ticks != b.Ticks;

    /// <summary>Shorter than.</summary>
    public static bool operator <(SimDuration a, SimDuration b) => a.Ticks < b.Ticks;

    /// <summary>Longer than.</summary>
    public static bool operator >(SimDuration a, SimDuration b) => a.Ticks > b.Ticks;

    /// <summary>Not longer than.</summary>
    public static bool operator <=(SimDuration a, SimDuration b) => a.Ticks <= b.Ticks;

    /// <summary>Not shorter than.</summary>
    public static bool operator >=(SimDuration a, SimDuration b) => a.Ticks >= b.Ticks;
}
