using System;
using System.Globalization;

namespace LagSim.Rules;

/// <summary>What rules tell the game outside: a number, a value and a key, whose meaning is the game's.</summary>
/// <remarks>Immutable.</remarks>
public readonly struct RuleNotice : IEquatable<RuleNotice>
{
    /// <summary>The code of what the world itself tells where a command failed and counts as none; see
    /// <see cref="TryReadFailedCommand"/>.</summary>
    public const int CommandFailed = int.MinValue;

    /// <summary>The code of what the world itself tells where rules wanted to do more in a tick than they may, once for that tick. The
    /// value is how much of what the first such call did had no effect.</summary>
    public const int ChainEnded = int.MinValue + 1;

    internal RuleNotice(int code, long value, long key, string? sentence = null)
    {
        Code = code;
        Value = value;
        Key = key;
        Sentence = sentence;
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

    /// <summary>Of what the world itself tells, what happened in words, for a log; null for what rules tell. Not part of equality.</summary>
    public string? Sentence { get; }

    /// <summary>Which command failed and counts as none, if this tells that.</summary>
    /// <param name="player">Whose command it was.</param>
    /// <param name="number">The command's number.</param>
    /// <returns>False if it tells something else.</returns>
    public bool TryReadFailedCommand(out byte player, out int number)
    {
        bool isThat = Code == CommandFailed;
        player = isThat ? (byte)(Value >> 32) : (byte)0;
        number = isThat ? unchecked((int)Value) : 0;
        return isThat;
    }

    /// <summary>A command failed and counts as none.</summary>
    internal static RuleNotice OfFailedCommand(byte player, int number, string sentence) =>
        new(CommandFailed, ((long)player << 32) | unchecked((uint)number), player, sentence);

    /// <summary>Rules wanted to do so much more in a tick than they may.</summary>
    internal static RuleNotice OfEndedChain(int dropped, string sentence) => new(ChainEnded, dropped, 0, sentence);

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

    /// <summary>Code, value, and the key if it is not zero, or the sentence if there is one, for logs.</summary>
    public override string ToString() => Sentence
        ?? string.Format(CultureInfo.InvariantCulture, Key == 0 ? "notice {0} of {1}" : "notice {0} of {1} for {2}", Code, Value, Key);
}
