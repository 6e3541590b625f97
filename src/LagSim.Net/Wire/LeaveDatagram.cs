using System;
using System.Text;

namespace LagSim.Net.Wire;

/// <summary>A notice that a peer is no longer in the session, from the peer itself or from the host.</summary>
/// <remarks>Immutable, safe on any thread. Not valid as <c>default</c>.</remarks>
internal readonly struct LeaveDatagram
{
    private readonly string? sentence;

    /// <summary>Creates a notice from its fields.</summary>
    public LeaveDatagram(ulong sessionId, byte peer, LeaveReason reason, string sentence = "")
    {
        SessionId = sessionId;
        Peer = peer;
        Reason = reason;
        this.sentence = HasSentence(reason) ? Fitting(sentence) : "";
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>The peer that is gone; 0 is the host.</summary>
    public byte Peer { get; }

    /// <summary>The reason.</summary>
    public LeaveReason Reason { get; }

    /// <summary>
    /// What failed, or why the peer was sent away, for people; empty for none, and with any reason but <see cref="LeaveReason.HostFailed"/> and
    /// <see cref="LeaveReason.Kicked"/>.
    /// </summary>
    public string Sentence => sentence ?? "";

    private bool IsWellFormed => Reason is >= LeaveReason.Left and <= LeaveReason.KeysTooOld;

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, from <see cref="WireFormat.LeaveBytes"/> to <see cref="WireFormat.MaxLeaveBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    /// <exception cref="InvalidOperationException"><see cref="Reason"/> is not a defined value.</exception>
    public int Encode(Span<byte> destination)
    {
        if (!IsWellFormed)
        {
            throw new InvalidOperationException($"{(byte)Reason} is not the number of a reason to leave.");
        }

        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Leave);
        writer.WriteUInt64(SessionId);
        writer.WriteByte(Peer);
        writer.WriteByte((byte)Reason);
        if (HasSentence(Reason))
        {
            byte[] utf8 = Encoding.UTF8.GetBytes(Sentence);
            writer.WriteUInt16((ushort)utf8.Length);
            writer.WriteBytes(utf8);
        }

        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="leave">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out LeaveDatagram leave, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Leave);
        leave = new LeaveDatagram(reader.ReadUInt64(), reader.ReadByte(), (LeaveReason)reader.ReadByte());
        reader.Require(leave.IsWellFormed);
        if (HasSentence(leave.Reason))
        {
            int length = reader.ReadUInt16();
            reader.Require(length <= WireFormat.MaxSentenceBytes);
            reader.Require(WireText.TryDecode(reader.ReadBytes(length), out string text));
            leave = new LeaveDatagram(leave.SessionId, leave.Peer, leave.Reason, text);
            reader.Require(string.Equals(leave.Sentence, text, StringComparison.Ordinal));
        }

        return reader.Finish(out refusal);
    }

    private static bool HasSentence(LeaveReason reason) => reason is LeaveReason.HostFailed or LeaveReason.Kicked;

    /// <summary>The sentence as it may travel: without control characters, which could change what a terminal shows, and not too
    /// long.</summary>
    private static string Fitting(string sentence)
    {
        StringBuilder fitting = new();
        int bytes = 0;
        for (int at = 0; at < sentence.Length; at++)
        {
            bool isPair = at + 1 < sentence.Length && char.IsSurrogatePair(sentence[at], sentence[at + 1]);
            string one = isPair ? sentence.Substring(at++, 2)
                : char.IsControl(sentence[at]) ? " "
                : char.IsSurrogate(sentence[at]) ? "?"
                : sentence.Substring(at, 1);
            bytes += Encoding.UTF8.GetByteCount(one);
            if (bytes > WireFormat.MaxSentenceBytes)
            {
                break;
            }

            fitting.Append(one);
        }

        return fitting.ToString();
    }
}
