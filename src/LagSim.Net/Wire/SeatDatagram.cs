using System;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>
/// The host's assignment of a player number to a client that is ready, repeated until an update of the client carries the number.
/// </summary>
/// <remarks>Immutable, safe on any thread. Not valid as <c>default</c>.</remarks>
internal readonly struct SeatDatagram
{
    /// <summary>The value of <see cref="PromiseSeconds"/> for a client that keeps to the pause whether it acts or not.</summary>
    public const byte Always = 255;

    /// <summary>Creates a place from its fields.</summary>
    public SeatDatagram(
        ulong sessionId, byte peer, uint lastSequence, Token128 pass, SimTime? earliest = null, ushort promiseMilliseconds = 0,
        byte promiseSeconds = 0)
    {
        SessionId = sessionId;
        Peer = peer;
        LastSequence = lastSequence;
        Pass = pass;
        Earliest = earliest ?? SimTime.MinValue;
        PromiseMilliseconds = promiseMilliseconds;
        PromiseSeconds = promiseSeconds;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>The client's peer number, 1 to 255.</summary>
    public byte Peer { get; }

    /// <summary>The last sequence number in an event of that peer number, by any holder; the client's first event is the next.</summary>
    public uint LastSequence { get; }

    /// <summary>Proves, after a silence, that the client is the same player: see <see cref="JoinDatagram.PlayerProof"/>. Secret.</summary>
    public Token128 Pass { get; }

    /// <summary>The shared time before which the client stamps no event; <see cref="SimTime.MinValue"/> for none.</summary>
    public SimTime Earliest { get; }

    /// <summary>
    /// The longest pause between the client's updates, each with a promise of how early its next event may be stamped, in ms; 0 for a host
    /// that has no use for promises.
    /// </summary>
    public ushort PromiseMilliseconds { get; }

    /// <summary>
    /// For how many seconds after its newest event the client keeps to that pause; <see cref="Always"/> for always, 0 for a host that has no
    /// use for promises.
    /// </summary>
    public byte PromiseSeconds { get; }

    /// <summary>For how long after its newest event the client keeps to that pause; the longest span for always.</summary>
    public SimDuration PromisedFor =>
        PromiseSeconds == Always ? SimDuration.MaxValue : SimDuration.FromSeconds(PromiseSeconds);

    /// <summary>The same, with what the client is to promise.</summary>
    /// <param name="earliest">The shared time before which the client stamps no event.</param>
    /// <param name="pause">The longest pause between two promises.</param>
    /// <param name="after">For how long after its newest event; the longest span for always.</param>
    public SeatDatagram WithPromises(SimTime earliest, SimDuration pause, SimDuration after) => new(
        SessionId, Peer, LastSequence, Pass, earliest, (ushort)pause.ToMilliseconds(),
        after == SimDuration.MaxValue ? Always : (byte)after.ToSeconds());

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.SeatBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    /// <exception cref="InvalidOperationException"><see cref="Peer"/> is 0.</exception>
    public int Encode(Span<byte> destination)
    {
        if (Peer == 0)
        {
            throw new InvalidOperationException("A client's number is 1 to 255; 0 is the host's.");
        }

        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Seat);
        writer.WriteUInt64(SessionId);
        writer.WriteByte(Peer);
        writer.WriteUInt32(LastSequence);
        Pass.Write(ref writer);
        writer.WriteOptionalTime(Earliest);
        writer.WriteUInt16(PromiseMilliseconds);
        writer.WriteByte(PromiseSeconds);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="seat">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out SeatDatagram seat, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Seat);
        seat = new SeatDatagram(
            reader.ReadUInt64(), reader.ReadByte(), reader.ReadUInt32(), Token128.Read(ref reader),
            reader.ReadOptionalTime(), reader.ReadUInt16(), reader.ReadByte());
        reader.Require(seat.Peer != 0);
        reader.Require((seat.Earliest == SimTime.MinValue) == (seat.PromiseMilliseconds == 0)); // all or none
        reader.Require((seat.PromiseSeconds == 0) == (seat.PromiseMilliseconds == 0));
        return reader.Finish(out refusal);
    }
}
