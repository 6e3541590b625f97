using System;
using System.Text;

namespace LagSim.Net.Protection;

/// <summary>What a backend says of a player in a connect token: who it is, and what it may do in the session.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class PlayerAdmission
{
    /// <summary>The longest <see cref="PlayerId"/> and <see cref="Name"/>, in bytes of UTF-8.</summary>
    public const int MaxTextBytes = 64;

    /// <summary>Creates an admission.</summary>
    /// <param name="playerId">
    /// The player's identity with the backend: 1 to <see cref="MaxTextBytes"/> bytes of UTF-8. One player has one place: who joins with the
    /// identity of a player that is in takes over its place.
    /// </param>
    /// <param name="name">
    /// What to show others: up to <see cref="MaxTextBytes"/> bytes of UTF-8, and what <see cref="Sessions.SessionOptions.WhyNoName"/> allows.
    /// </param>
    /// <param name="rights">What the player may do.</param>
    /// <param name="number">The number that the player gets, 1 to 16; 0 for any that is free.</param>
    /// <exception cref="ArgumentException">A text is missing or too long, or is not valid Unicode, or the name is not one to show.</exception>
    /// <exception cref="ArgumentOutOfRangeException">The number or the rights are out of range.</exception>
    public PlayerAdmission(string playerId, string name = "", PlayerRights rights = PlayerRights.All, byte number = 0)
    {
        PlayerId = Checked(playerId, nameof(playerId));
        if (PlayerId.Length == 0)
        {
            throw new ArgumentException("A player's identity has at least one character.", nameof(playerId));
        }

        Name = name is null ? throw new ArgumentNullException(nameof(name))
            : PlayerName.WhyNone(name) is string why ? throw new ArgumentException($"The player's name is not one to show: {why}", nameof(name))
            : name;
        Rights = (rights & ~PlayerRights.All) == 0
            ? rights
            : throw new ArgumentOutOfRangeException(nameof(rights), (int)rights, "There are no such rights.");
        Number = number <= Sessions.SessionOptions.MaxClients
            ? number
            : throw new ArgumentOutOfRangeException(
                nameof(number), number, $"A player's number is 1 to {Sessions.SessionOptions.MaxClients}, or 0 for any.");
    }

    /// <summary>The player's identity with the backend.</summary>
    public string PlayerId { get; }

    /// <summary>What to show others; empty if the backend gave none.</summary>
    public string Name { get; }

    /// <summary>What the player may do.</summary>
    public PlayerRights Rights { get; }

    /// <summary>The number that the player gets; 0 for any that is free.</summary>
    public byte Number { get; }

    /// <summary>The name, or the identity if there is none.</summary>
    public override string ToString() => Name.Length > 0 ? Name : PlayerId;

    private static string Checked(string text, string parameter)
    {
        int bytes;
        try
        {
            bytes = new UTF8Encoding(false, throwOnInvalidBytes: true).GetByteCount(text ?? throw new ArgumentNullException(parameter));
        }
        catch (EncoderFallbackException)
        {
            throw new ArgumentException("The text holds half a surrogate pair, which is no character.", parameter);
        }

        foreach (char one in text)
        {
            if (one == PlayerName.Replacement)
            {
                throw new ArgumentException("The text holds U+FFFD, which stands in place of bytes that were no text.", parameter);
            }

            if (char.IsControl(one))
            {
                throw new ArgumentException(
                    $"The text holds the control character U+{(int)one:X4}, which could change what a terminal shows.", parameter);
            }
        }

        return bytes <= MaxTextBytes
            ? text
            : throw new ArgumentException($"'{text}' has {bytes} bytes of UTF-8; at most {MaxTextBytes} are allowed.", parameter);
    }
}
