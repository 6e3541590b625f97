using System;
using System.Globalization;

namespace LagSim.Rules;

/// <summary>What rules tell the game outside: a number and a value, whose meaning is the game's.</summary>
/// <remarks>Immutable.</remarks>
public readonly struct RuleNotice : IEquatable<RuleNotice>
{
    internal RuleNotice(int code, long value)
    {
        Code = code;
        Value = value;
    }

    /// <summary>What happened; the game's own meaning.</summary>
    public int Code { get; }

    /// <summary>More about it; the game's own meaning.</summary>
    public long Value { get; }

    /// <inheritdoc/>
    public bool Equals(RuleNotice other) => Code == other.Code && Value == other.Value;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is RuleNotice other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Code ^ Value.GetHashCode();

    /// <summary>Same code and value.</summary>
    public static bool operator ==(RuleNotice a, RuleNotice b) => a.Equals(b);

    /// <summary>Another code or value.</summary>
    public static bool operator !=(RuleNotice a, RuleNotice b) => !a.Equals(b);

    /// <summary>Code and value, for logs.</summary>
    public override string ToString() => string.Format(CultureInfo.InvariantCulture, "notice {0} of {1}", Code, Value);
}
