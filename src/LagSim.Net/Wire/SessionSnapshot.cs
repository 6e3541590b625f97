using System;
using System.Buffers.Binary;
using System.Diagnostics.CodeAnalysis;
using System.Security.Cryptography;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Net.Wire;

/// <summary>
/// The snapshot from which a client gets the world: its scene, and the committed state if the world has begun long enough ago.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal sealed class SessionSnapshot
{
    /// <summary>The longest encoding: 64 MiB, some 300,000 bodies.</summary>
    public const int MaxBytes = 1 << 26;

    private SessionSnapshot(Scene scene, WorldSnapshot? world)
    {
        Scene = scene;
        World = world;
    }

    /// <summary>The scene.</summary>
    public Scene Scene { get; }

    /// <summary>The committed state; null if the world is to be simulated from its start.</summary>
    public WorldSnapshot? World { get; }

    /// <summary>Encodes a snapshot.</summary>
    /// <exception cref="SceneException">The encoding would exceed <see cref="MaxBytes"/>, or the scene cannot be encoded.</exception>
    public static byte[] Encode(Scene scene, WorldSnapshot? snapshot)
    {
        byte[] first = SceneFormat.Encode(scene);
        long length = sizeof(uint) + first.Length + (snapshot is null ? 0 : SnapshotFormat.EncodedLength(snapshot));
        if (length > MaxBytes)
        {
            throw new SceneException($"A copy of scene '{scene.Name}' and its world has {length} bytes; at most {MaxBytes} can travel.");
        }

        byte[] bytes = new byte[length];
        WireWriter writer = new(bytes);
        writer.WriteUInt32((uint)first.Length);
        writer.WriteBytes(first);
        if (snapshot is not null)
        {
            writer.WriteBytes(SnapshotFormat.Encode(snapshot));
        }

        return bytes;
    }

    /// <summary>The hash by which a complete snapshot is recognised: the first eight bytes of its SHA-256.</summary>
    internal static ulong HashOf(ReadOnlySpan<byte> snapshot)
    {
        using SHA256 hash = SHA256.Create();
        Span<byte> bytes = stackalloc byte[32];
        return hash.TryComputeHash(snapshot, bytes, out _)
            ? BinaryPrimitives.ReadUInt64LittleEndian(bytes)
            : throw new InvalidOperationException("SHA-256 gave more than 32 bytes.");
    }

    /// <summary>Reads a copy; never throws.</summary>
    /// <param name="bytes">The whole encoding.</param>
    /// <param name="known">The accelerations and rules that this peer can supply, for a scene that names some.</param>
    /// <param name="own">A scene this peer has; used instead of a new one if the copy is of the same.</param>
    /// <param name="copy">The copy, if the bytes are one.</param>
    /// <param name="error">Otherwise a sentence that says why not.</param>
    public static bool TryDecode(
        ReadOnlySpan<byte> bytes,
        SceneCode known,
        Scene? own,
        [NotNullWhen(true)] out SessionSnapshot? copy,
        [NotNullWhen(false)] out string? error)
    {
        copy = null;
        WireReader reader = new(bytes, MaxBytes);
        uint length = reader.ReadUInt32();
        reader.Require(length <= reader.Remaining, WireRefusal.TooShort);
        if (reader.Refusal != WireRefusal.None)
        {
            error = $"The copy of the world is damaged: {reader.Refusal}.";
            return false;
        }

        if (!SceneFormat.TryDecode(reader.ReadBytes((int)length), known.Or(own), out Scene? scene, out error))
        {
            return false;
        }

        WorldSnapshot? snapshot = null;
        if (reader.Remaining > 0 && !SnapshotFormat.TryDecode(reader.ReadBytes(reader.Remaining), out snapshot, out WireRefusal refusal))
        {
            error = $"The copy of the world's state is damaged: {refusal}.";
            return false;
        }

        if (snapshot is not null && !SnapshotFormat.IsInRange(snapshot))
        {
            error = $"The copy of the world's state is of {snapshot.Time.ToShortString()} in a world that began at {snapshot.Start.ToShortString()}; the first"
                + " must come after the second, and both travel only within 48 days of the origin.";
            return false;
        }

        copy = new SessionSnapshot(own is not null && own.Hash == scene.Hash ? own : scene, snapshot);
        error = null;
        return true;
    }
}
