using System;
using System.Globalization;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions;

/// <summary>
/// Proves to a host that a client is a player it had before: the player's number, and a secret that the host gave with it.
/// </summary>
/// <remarks>
/// <para>A client gets one with its number (<see cref="ClientSession.Pass"/>), and uses it by itself when it has lost its host. A program
/// that wants to come back after a restart saves it as text and sets it as <see cref="ClientOptions.Pass"/>. It is valid only with the host
/// that gave it, until that host ends or gives the number to another client. Anyone who has it can take the player's place, so keep it like
/// a password. Without protection it travels in clear text once, when it is given.</para>
/// <para>Immutable, safe on any thread. <c>default</c> is no pass.</para>
/// </remarks>
public readonly struct PlayerPass : IEquatable<PlayerPass>
{
    private const int Digits = 16;

    internal PlayerPass(byte number, Token128 secret)
    {
        Number = number;
        Secret = secret;
    }

    /// <summary>The player's number, 1 or more; 0 for no pass.</summary>
    public byte Number { get; }

    internal Token128 Secret { get; }

    /// <summary>Parses the text that <see cref="ToString"/> returns.</summary>
    /// <param name="text">A number from 1 to 255, a hyphen, and 32 hexadecimal digits.</param>
    /// <param name="pass">The pass, if it is one.</param>
    /// <returns>False for anything else; never throws.</returns>
    public static bool TryParse(string? text, out PlayerPass pass)
    {
        pass = default;
        string[] parts = (text ?? "").Trim().Split('-');
        if (parts.Length != 2 || parts[1].Length != 2 * Digits || HasNull(parts[0]) || HasNull(parts[1])
            || !byte.TryParse(parts[0], NumberStyles.None, CultureInfo.InvariantCulture, out byte number) || number == 0
            || !ulong.TryParse(parts[1].Substring(0, Digits), NumberStyles.AllowHexSpecifier, CultureInfo.InvariantCulture, out ulong first)
            || !ulong.TryParse(parts[1].Substring(Digits), NumberStyles.AllowHexSpecifier, CultureInfo.InvariantCulture, out ulong second))
        {
            return false;
        }

        pass = new PlayerPass(number, new Token128(first, second));
        return true;
    }

    /// <summary>Checks for a null character, which number parsers accept as the end of the text.</summary>
    private static bool HasNull(string digits) => digits.IndexOf('\0') >= 0;

    /// <summary>Same number and secret.</summary>
    public static bool operator ==(PlayerPass a, PlayerPass b) => a.Equals(b);

    /// <summary>Another number or secret.</summary>
    public static bool operator !=(PlayerPass a, PlayerPass b) => !a.Equals(b);

    /// <inheritdoc/>
    public bool Equals(PlayerPass other) => Number == other.Number && Secret == other.Secret;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is PlayerPass other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Secret.GetHashCode();

    /// <summary>The number, a hyphen, and the secret as 32 hexadecimal digits; empty for no pass.</summary>
    /// <remarks>
    /// Store it as you would a password, and never log it: anyone who has it can take the player's place.
    /// </remarks>
    public override string ToString() => Number == 0 ? "" : FormattableString.Invariant($"{Number}-{Secret.First:x16}{Secret.Second:x16}");
}
