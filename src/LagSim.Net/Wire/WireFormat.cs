using System;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>The constants that all datagrams share. The layouts are in <c>docs/WIRE.md</c>; all sizes are in bytes.</summary>
internal static class WireFormat
{
    /// <summary>The first two bytes of every datagram, little-endian.</summary>
    public const ushort Magic = 0x4C53;

    /// <summary>The version of the layouts. Any change to a layout, a range or an enum's numbers needs another version.</summary>
    public const byte Version = 14;

    /// <summary>Magic, version and type.</summary>
    public const int HeaderBytes = 4;

    /// <summary>The length of a <see cref="ConnectRequestDatagram"/>.</summary>
    public const int ConnectRequestBytes = 60;

    /// <summary>The least length of a <see cref="ConnectRequestDatagram"/> in any version.</summary>
    public const int ShortestConnectRequestBytes = 28;

    /// <summary>The length of a <see cref="ChallengeDatagram"/>: no longer than what it answers.</summary>
    public const int ChallengeBytes = 60;

    /// <summary>The length of a <see cref="MoveChallengeDatagram"/>: shorter than what it answers.</summary>
    public const int MoveChallengeBytes = 28;

    /// <summary>The length of what a <see cref="JoinDatagram"/> begins with: header, nonce and cookie.</summary>
    public const int JoinPrologueBytes = 28;

    /// <summary>
    /// The length of the rest of a <see cref="JoinDatagram"/> without a name, and of the payload of a <see cref="SecureJoinDatagram"/>.
    /// </summary>
    public const int JoinClaimBytes = 47;

    /// <summary>The length of a <see cref="JoinDatagram"/> without a name.</summary>
    public const int JoinBytes = JoinPrologueBytes + JoinClaimBytes;

    /// <summary>The length of a <see cref="SecureJoinDatagram"/> without a name and a connect token.</summary>
    public const int SecureJoinBytes = JoinPrologueBytes + IHostProtection.HandshakeOverhead + JoinClaimBytes;

    /// <summary>The length of a <see cref="WelcomeDatagram"/> after its nonce.</summary>
    public const int WelcomeTermBytes = 40;

    /// <summary>The length of a <see cref="WelcomeDatagram"/>.</summary>
    public const int WelcomeBytes = HeaderBytes + sizeof(ulong) + WelcomeTermBytes;

    /// <summary>The length of the payload of a secure welcome: the terms, and the key of a <see cref="ResetDatagram"/>.</summary>
    public const int SecureWelcomePayloadBytes = WelcomeTermBytes + IHostProtection.ResetKeyBytes;

    /// <summary>The length of a secure welcome, a <see cref="SecureAnswerDatagram"/>.</summary>
    public const int SecureWelcomeBytes =
        HeaderBytes + sizeof(ulong) + IHostProtection.WelcomeOverhead + SecureWelcomePayloadBytes;

    /// <summary>The length of the payload of a secure refusal: the reason, and how far a token is off its time.</summary>
    public const int SecureRefusalPayloadBytes = 1 + sizeof(uint);

    /// <summary>The length of a secure refusal, a <see cref="SecureAnswerDatagram"/>.</summary>
    public const int SecureRefusalBytes =
        HeaderBytes + sizeof(ulong) + IHostProtection.HandshakeOverhead + SecureRefusalPayloadBytes;

    /// <summary>The length of a <see cref="ResetDatagram"/>: shorter than any sealed datagram.</summary>
    public const int ResetBytes = 29;

    /// <summary>The length of a <see cref="SeatDatagram"/>: shorter than any update.</summary>
    public const int SeatBytes = 44;

    /// <summary>The length of a <see cref="MoveDatagram"/>.</summary>
    public const int MoveBytes = 29;

    /// <summary>The length of a <see cref="RefusalDatagram"/>.</summary>
    public const int RefusalBytes = 13;

    /// <summary>The length of a <see cref="LeaveDatagram"/> without a sentence.</summary>
    public const int LeaveBytes = 14;

    /// <summary>The length of a <see cref="LeaveDatagram"/> with the longest sentence.</summary>
    public const int MaxLeaveBytes = LeaveBytes + sizeof(ushort) + MaxSentenceBytes;

    /// <summary>The longest sentence of a <see cref="LeaveDatagram"/>, in bytes of UTF-8.</summary>
    public const int MaxSentenceBytes = 1000;

    /// <summary>The length of a <see cref="SnapshotRequestDatagram"/>.</summary>
    public const int SnapshotRequestBytes = 29;

    /// <summary>The length of a <see cref="SnapshotChunkDatagram"/> without its data.</summary>
    public const int EmptySnapshotChunkBytes = 16;

    /// <summary>The length of a <see cref="DesyncQueryDatagram"/>.</summary>
    public const int DesyncQueryBytes = 37;

    /// <summary>The length of an <see cref="DesyncReportDatagram"/> without an event.</summary>
    public const int EmptyDesyncReportBytes = 21;

    /// <summary>The length of a <see cref="RosterDatagram"/> without entries.</summary>
    public const int EmptyRosterBytes = 25;

    /// <summary>The length of a <see cref="RosterReceivedDatagram"/>.</summary>
    public const int RosterReceivedBytes = 17;

    /// <summary>The length of a <see cref="KeyExchangeDatagram"/>.</summary>
    public const int KeyExchangeBytes = HeaderBytes + sizeof(ulong) + sizeof(uint) + IDatagramCipher.ExchangeBytes;

    /// <summary>The length of an <see cref="UpdateDatagram"/> without start, state hash and entries.</summary>
    public const int EmptyUpdateBytes = 59;

    /// <summary>The length of the start in an <see cref="UpdateDatagram"/>.</summary>
    public const int StartBytes = 8;

    /// <summary>The length of a state hash and its time in an <see cref="UpdateDatagram"/>; each further hash adds 8.</summary>
    public const int StateHashBytes = 16;

    /// <summary>The length of the most state hashes and their time in an <see cref="UpdateDatagram"/>.</summary>
    internal const int MaxHashBytes = StateHashBytes + ((UpdateDatagram.MaxHashes - 1) * sizeof(ulong));

    /// <summary>The longest datagram.</summary>
    public const int MaxBytes = IDatagramPort.MaxDatagramBytes;

    /// <summary>
    /// The longest datagram that any path of IPv4 carries: 576 bytes, which every host takes (RFC 1122, 3.3.2), less 28 of IP and UDP.
    /// </summary>
    public const int LeastPathBytes = 548;

    /// <summary>How much longer a datagram is when it is sealed; see <see cref="SealedDatagram"/>.</summary>
    public const int SealBytes = 23;

    /// <summary>The longest datagram that can be sealed, protected or not: what a link carries does not depend on that.</summary>
    public const int MaxPlainBytes = MaxBytes - SealBytes;

    /// <summary>
    /// The most ticks (48 days) that an encoded time may be from its origin, so that no sum or difference of two of them that a receiver
    /// forms with a shorter span can overflow.
    /// </summary>
    public const long MaxTimeTicks = (1L << 62) - 1;

    /// <summary>Whether a time can be encoded; <see cref="SimTime.MinValue"/>, which stands for "none" in some fields, cannot.</summary>
    public static bool IsInRange(SimTime time) => time.Ticks is >= -MaxTimeTicks and <= MaxTimeTicks;

    /// <summary>Reads the header of a datagram, to choose the decoder.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="type">The type that it claims; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    /// <returns>False if it is not a datagram of this version; never throws.</returns>
    public static bool TryReadType(ReadOnlySpan<byte> datagram, out DatagramType type, out WireRefusal refusal)
    {
        WireReader reader = new(datagram);
        type = reader.ReadHeader();
        refusal = reader.Refusal;
        return refusal == WireRefusal.None;
    }
}
