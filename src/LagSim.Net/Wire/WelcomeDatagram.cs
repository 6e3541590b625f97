using System;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>The host lets a joiner in, and tells it who it is.</summary>
/// <remarks>Immutable, safe on any thread. Not valid as <c>default</c>.</remarks>
public readonly struct WelcomeDatagram
{
    /// <summary>An answer of these fields.</summary>
    public WelcomeDatagram(ulong nonce, ulong sessionId, byte peer, SimDuration history)
    {
        Nonce = nonce;
        SessionId = sessionId;
        Peer = peer;
        History = history;
    }

    /// <summary>The <see cref="JoinDatagram.Nonce"/> that this answers.</summary>
    public ulong Nonce { get; }

    /// <summary>The session's number; every later datagram carries it.</summary>
    public ulong SessionId { get; }

    /// <summary>The joiner's peer number, 1 to 255.</summary>
    public byte Peer { get; }

    /// <summary>How far back the host's window reaches; above zero, at most <see cref="WireFormat.MaxTimeTicks"/>.</summary>
    public SimDuration History { get; }

    private bool IsWellFormed => Peer != 0 && History.Ticks is > 0 and <= WireFormat.MaxTimeTicks;

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.WelcomeBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    /// <exception cref="InvalidOperationException">A field is out of its range.</exception>
    public int Encode(Span<byte> destination)
    {
        if (!IsWellFormed)
        {
            throw new InvalidOperationException($"No welcome: peer {Peer} must be 1 to 255, history {History} above zero and below 48 days.");
        }

        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Welcome);
        writer.WriteUInt64(Nonce);
        writer.WriteUInt64(SessionId);
        writer.WriteByte(Peer);
        writer.WriteInt64(History.Ticks);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="welcome">What it says; meaningless on refusal.</param>
    /// <param name="refusal">Why not, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out WelcomeDatagram welcome, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Welcome);
        welcome = new WelcomeDatagram(
            reader.ReadUInt64(), reader.ReadUInt64(), reader.ReadByte(), SimDuration.FromTicks(reader.ReadInt64()));
        reader.Require(welcome.IsWellFormed);
        return reader.Finish(out refusal);
    }
}
