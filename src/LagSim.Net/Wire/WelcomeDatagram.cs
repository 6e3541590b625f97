using System;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>
/// The host's answer that lets a client in and announces what to download: a snapshot of scene and world, and the log from where that ends.
/// </summary>
/// <remarks>Immutable, safe on any thread. Not valid as <c>default</c>.</remarks>
internal readonly struct WelcomeDatagram
{
    /// <summary>Creates an answer from its fields.</summary>
    public WelcomeDatagram(
        ulong nonce, ulong sessionId, SimDuration history, SimDuration longestHistory, int copyLength, ulong copyHash, uint logIndex)
    {
        Nonce = nonce;
        SessionId = sessionId;
        History = history;
        LongestHistory = longestHistory;
        CopyLength = copyLength;
        CopyHash = copyHash;
        LogIndex = logIndex;
    }

    /// <summary>The <see cref="ConnectRequestDatagram.Nonce"/> that this answers.</summary>
    public ulong Nonce { get; }

    /// <summary>The session's number; every later datagram carries it.</summary>
    public ulong SessionId { get; }

    /// <summary>How far back the host's window reaches; above zero, at most <see cref="LongestHistory"/>.</summary>
    public SimDuration History { get; }

    /// <summary>How far back it reaches while events are on their way; at most <see cref="WireFormat.MaxTimeTicks"/>.</summary>
    public SimDuration LongestHistory { get; }

    /// <summary>The length of the snapshot in bytes, 1 to <see cref="SessionSnapshot.MaxBytes"/>.</summary>
    public int CopyLength { get; }

    /// <summary>The hash of the snapshot's bytes.</summary>
    public ulong CopyHash { get; }

    /// <summary>The number of log entries that the snapshot includes, or that precede everything it does not.</summary>
    public uint LogIndex { get; }

    private bool IsWellFormed =>
        History.Ticks > 0 && LongestHistory >= History && LongestHistory.Ticks <= WireFormat.MaxTimeTicks && CopyLength is > 0 and <= SessionSnapshot.MaxBytes;

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.WelcomeBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    /// <exception cref="InvalidOperationException">A field is out of range.</exception>
    public int Encode(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Welcome);
        writer.WriteUInt64(Nonce);
        return writer.Position + EncodeTerms(destination.Slice(writer.Position));
    }

    /// <summary>Writes the terms: all but the nonce.</summary>
    /// <returns>Its length, <see cref="WireFormat.WelcomeTermBytes"/>.</returns>
    /// <exception cref="InvalidOperationException">A field is out of range.</exception>
    internal int EncodeTerms(Span<byte> destination)
    {
        if (!IsWellFormed)
        {
            throw new InvalidOperationException(
                $"No welcome: history {History.ToShortString()} above zero, {LongestHistory.ToShortString()} no less and below 48 days, a copy of {CopyLength} bytes 1 to"
                + $" {SessionSnapshot.MaxBytes}.");
        }

        WireWriter writer = new(destination);
        writer.WriteUInt64(SessionId);
        writer.WriteInt64(History.Ticks);
        writer.WriteInt64(LongestHistory.Ticks);
        writer.WriteUInt32((uint)CopyLength);
        writer.WriteUInt64(CopyHash);
        writer.WriteUInt32(LogIndex);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="welcome">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out WelcomeDatagram welcome, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Welcome);
        welcome = ReadTerms(ref reader, reader.ReadUInt64());
        return reader.Finish(out refusal);
    }

    /// <summary>Reads the terms of a welcome with that nonce; a reader that has refused gives none of use.</summary>
    internal static WelcomeDatagram ReadTerms(ref WireReader reader, ulong nonce)
    {
        ulong session = reader.ReadUInt64();
        SimDuration history = SimDuration.FromTicks(reader.ReadInt64());
        SimDuration longest = SimDuration.FromTicks(reader.ReadInt64());
        uint length = reader.ReadUInt32();
        reader.Require(length <= SessionSnapshot.MaxBytes);
        WelcomeDatagram welcome = new(
            nonce, session, history, longest, (int)Math.Min(length, SessionSnapshot.MaxBytes), reader.ReadUInt64(), reader.ReadUInt32());
        reader.Require(welcome.IsWellFormed);
        return welcome;
    }
}
