using System;
using System.Globalization;

namespace LagSim.Rules;

/// <summary>What rules tell the game outside: a number, a value and a key, whose meaning is the game's.</summary>
/// <remarks>Immutable.</remarks>
public readonly struct RuleNotice : IEquatable<RuleNotice>
{
    internal RuleNotice(int code, long value, long key)
    {
        Code = code;
        Value = value;
        Key = key;
    }

    /// <summary>What happened; the game's own meaning.</summary>
    public int Code { get; }

    /// <summary>More about it; the game's own meaning.</summary>
    public long Value { get; }

    /// <summary>
    /// What it is about, such as a player; the game's own meaning. When a late event moves something that was told, what has the same code
    /// and key is the same thing, whatever its value.
    /// </summary>
    public long Key { get; }

    /// <inheritdoc/>
    public bool Equals(RuleNotice other) => Code == other.Code && Value == other.Value && Key == other.Key;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is RuleNotice other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Code ^ Value.GetHashCode() ^ (Key.GetHashCode() * 397);

    /// <summary>Same code, value and key.</summary>
    public static bool operator ==(RuleNotice a, RuleNotice b) => a.Equals(b);

    /// <summary>Another code, value or key.</summary>
    public static bool operator !=(RuleNotice a, RuleNotice b) => !a.Equals(b);

    /// <summary>Code, value, and the key if it is not zero, for logs.</summary>
    public override string ToString() =>
        string.Format(CultureInfo.InvariantCulture, Key == 0 ? "notice {0} of {1}" : "notice {0} of {1} for {2}", Code, Value, Key);
}
