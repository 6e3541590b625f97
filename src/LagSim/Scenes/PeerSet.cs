using System;
using System.Collections.Generic;
using System.Globalization;

namespace LagSim.Scenes;

/// <summary>A set of a session's peers, by number; the host is 0. A scene grants rights to such sets.</summary>
/// <remarks>Immutable, safe on any thread. <c>default</c> is <see cref="Everyone"/>.</remarks>
public readonly struct PeerSet : IEquatable<PeerSet>
{
    /// <summary>The highest number that can be named.</summary>
    public const int MaxPeer = 16;

    private const uint All = (1u << (MaxPeer + 1)) - 1;

    private PeerSet(uint others) => Others = others;

    /// <summary>Every peer there is.</summary>
    public static PeerSet Everyone => default;

    /// <summary>No peer at all.</summary>
    public static PeerSet Nobody => new(All);

    /// <summary>Bit n: peer n is not among them.</summary>
    internal uint Others { get; }

    /// <summary>What a scene's hash takes in of a set that is not <see cref="Everyone"/>: 49 bits.</summary>
    /// <remarks>Peer 16 counts where it is among them, so that sets of the others have the hash they always had.</remarks>
    internal ulong HashBits => (Others & 0xFFFF) | ((ulong)(~Others >> MaxPeer & 1) << 48);

    /// <summary>The peers of these numbers, 0 to <see cref="MaxPeer"/>; none gives <see cref="Nobody"/>.</summary>
    /// <exception cref="ArgumentOutOfRangeException">A number is out of range.</exception>
    public static PeerSet Of(params int[] peers)
    {
        uint others = All;
        foreach (int peer in peers ?? throw new ArgumentNullException(nameof(peers)))
        {
            if (peer is < 0 or > MaxPeer)
            {
                throw new ArgumentOutOfRangeException(nameof(peers), peer, $"A peer that is granted a right has a number from 0 to {MaxPeer}.");
            }

            others &= ~(1u << peer);
        }

        return new PeerSet(others);
    }

    /// <summary>The set with bit n of the mask for peer n, as <see cref="Mask"/> gives it.</summary>
    public static PeerSet FromMask(uint mask) => new(All & ~mask);

    /// <summary>Bit n: peer n is among them.</summary>
    public uint Mask => All & ~Others;

    /// <summary>Whether that peer is among them; above <see cref="MaxPeer"/> only <see cref="Everyone"/> has any.</summary>
    public bool Contains(int peer) => peer >= 0 && (peer <= MaxPeer ? (Others >> peer & 1) == 0 : Others == 0);

    /// <inheritdoc/>
    public bool Equals(PeerSet other) => Others == other.Others;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is PeerSet other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => (int)Others;

    /// <summary>Same peers.</summary>
    public static bool operator ==(PeerSet a, PeerSet b) => a.Equals(b);

    /// <summary>Different peers.</summary>
    public static bool operator !=(PeerSet a, PeerSet b) => !a.Equals(b);

    /// <summary><c>everyone</c>, <c>nobody</c>, or the numbers.</summary>
    public override string ToString()
    {
        List<string> numbers = new();
        for (int peer = 0; peer <= MaxPeer; peer++)
        {
            if (Contains(peer))
            {
                numbers.Add(peer.ToString(CultureInfo.InvariantCulture));
            }
        }

        return Others == 0 ? "everyone" : numbers.Count == 0 ? "nobody" : string.Join(", ", numbers);
    }
}
