using System;
using System.Globalization;
using System.Runtime.InteropServices;

namespace LagSim.Events;

/// <summary>What a player tells the game's rules: a number and some bytes, whose meaning is the game's.</summary>
/// <remarks>Immutable, safe on any thread. Equal if number and bytes are.</remarks>
public sealed class GameCommand : IEquatable<GameCommand>
{
    /// <summary>The most bytes that a command carries: 128.</summary>
    public const int MaxBytes = 128;

    private readonly byte[] data;

    /// <summary>A command; its bytes are copied.</summary>
    /// <param name="number">Which command, 0 to 65,535; the game's own meaning.</param>
    /// <param name="data">What it carries, at most <see cref="MaxBytes"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The number is out of its range.</exception>
    /// <exception cref="ArgumentException">There are too many bytes.</exception>
    public GameCommand(int number, ReadOnlySpan<byte> data = default)
    {
        if (number is < 0 or > ushort.MaxValue)
        {
            throw new ArgumentOutOfRangeException(nameof(number), number, "The number of a command is 0 to 65535.");
        }

        if (data.Length > MaxBytes)
        {
            throw new ArgumentException($"Command {number} carries {data.Length} bytes; at most {MaxBytes} are allowed.", nameof(data));
        }

        Number = number;
        this.data = data.ToArray();
    }

    /// <summary>Which command; the game's own meaning.</summary>
    public int Number { get; }

    /// <summary>The number of bytes that it carries.</summary>
    public int Length => data.Length;

    /// <summary>The bytes that it carries.</summary>
    public ReadOnlySpan<byte> Data => data;

    /// <summary>A command that carries a value, by its bytes in memory.</summary>
    /// <exception cref="ArgumentException">The value takes more than <see cref="MaxBytes"/>.</exception>
    public static GameCommand Of<T>(int number, T value)
        where T : unmanaged
    {
        Span<T> one = stackalloc T[1];
        one[0] = value;
        return new GameCommand(number, MemoryMarshal.AsBytes(one));
    }

    /// <summary>The value that it carries; false if its length is another. Whether the value makes sense is for the game to check, since
    /// it comes from a player.</summary>
    public bool TryRead<T>(out T value)
        where T : unmanaged
    {
        Span<T> one = stackalloc T[1];
        Span<byte> bytes = MemoryMarshal.AsBytes(one);
        bool fits = bytes.Length == data.Length;
        if (fits)
        {
            data.CopyTo(bytes);
        }

        value = fits ? one[0] : default;
        return fits;
    }

    /// <inheritdoc/>
    public bool Equals(GameCommand? other) => other is not null && Number == other.Number && data.AsSpan().SequenceEqual(other.data);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => Equals(obj as GameCommand);

    /// <inheritdoc/>
    public override int GetHashCode() => Number ^ (data.Length << 16);

    /// <summary>The number and the length, for logs.</summary>
    public override string ToString() => string.Format(CultureInfo.InvariantCulture, "command {0} of {1} bytes", Number, data.Length);
}
