using System;
using System.Collections.Generic;
using System.Globalization;

namespace LagSim.Scenes;

/// <summary>A set of a session's peers, by number; the host is 0. A scene grants rights to such sets.</summary>
/// <remarks>Immutable, safe on any thread. <c>default</c> is <see cref="Everyone"/>.</remarks>
public readonly struct PeerSet : IEquatable<PeerSet>
{
    /// <summary>The highest number that can be named.</summary>
    public const int MaxPeer = 15;

    private const int All = (1 << (MaxPeer + 1)) - 1;

    private PeerSet(ushort others) => Others = others;

    /// <summary>Every peer there is.</summary>
    public static PeerSet Everyone => default;

    /// <summary>No peer at all.</summary>
    public static PeerSet Nobody => new(All);

    /// <summary>Bit n: peer n is not among them.</summary>
    internal ushort Others { get; }

    /// <summary>The peers of these numbers, 0 to <see cref="MaxPeer"/>; none gives <see cref="Nobody"/>.</summary>
    /// <exception cref="ArgumentOutOfRangeException">A number is out of range.</exception>
    public static PeerSet Of(params int[] peers)
    {
        int others = All;
        foreach (int peer in peers ?? throw new ArgumentNullException(nameof(peers)))
        {
            if (peer is < 0 or > MaxPeer)
            {
                throw new ArgumentOutOfRangeException(nameof(peers), peer, $"A peer that is granted a right has a number from 0 to {MaxPeer}.");
            }

            others &= ~(1 << peer);
        }

        return new PeerSet((ushort)others);
    }

    /// <summary>The set with bit n of the mask for peer n, as <see cref="Mask"/> gives it.</summary>
    public static PeerSet FromMask(ushort mask) => new((ushort)(All & ~mask));

    /// <summary>Bit n: peer n is among them.</summary>
    public ushort Mask => (ushort)(All & ~Others);

    /// <summary>Whether that peer is among them; above <see cref="MaxPeer"/> only <see cref="Everyone"/> has any.</summary>
    public bool Contains(int peer) => peer >= 0 && (peer <= MaxPeer ? (Others >> peer & 1) == 0 : Others == 0);

    /// <inheritdoc/>
    public bool Equals(PeerSet other) => Others == other.Others;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is PeerSet other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Others;

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
