using System;
using System.Globalization;

namespace LagSim.Rules;

/// <summary>What rules tell the game outside: a number and a value, whose meaning is the game's.</summary>
/// <remarks>Immutable.</remarks>
public readonly struct RuleNotice : IEquatable<RuleNotice>
{
    /// <summary>The code of what the world itself tells where a command failed and counts as none; see
    /// <see cref="TryReadFailedCommand"/>.</summary>
    public const int CommandFailed = int.MinValue;

    /// <summary>The code of what the world itself tells where rules wanted to do more in a tick than they may, once for that tick. The
    /// value is how much of what the first such call did had no effect.</summary>
    public const int ChainEnded = int.MinValue + 1;

    internal RuleNotice(int code, long value, string? sentence = null)
    {
        Code = code;
        Value = value;
        Sentence = sentence;
    }

    /// <summary>What happened; the game's own meaning.</summary>
    public int Code { get; }

    /// <summary>More about it; the game's own meaning.</summary>
    public long Value { get; }

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
        new(CommandFailed, ((long)player << 32) | unchecked((uint)number), sentence);

    /// <summary>Rules wanted to do so much more in a tick than they may.</summary>
    internal static RuleNotice OfEndedChain(int dropped, string sentence) => new(ChainEnded, dropped, sentence);

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

    /// <summary>Code and value, or the sentence if there is one, for logs.</summary>
    public override string ToString() => Sentence ?? string.Format(CultureInfo.InvariantCulture, "notice {0} of {1}", Code, Value);
}
