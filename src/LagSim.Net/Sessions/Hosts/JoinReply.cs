using System;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>The host's answer to one join: in clear text, or by a handshake, which gives the link its keys.</summary>
/// <param name="nonce">The nonce of the join.</param>
/// <param name="to">Where it came from.</param>
/// <param name="protection">The host's protection; null in a session without.</param>
/// <param name="handshake">The handshake that the join began; null in a session without protection.</param>
/// <param name="sender">Sends the answer.</param>
internal sealed class JoinReply(
    ulong nonce, PeerAddress to, IHostProtection? protection, IHostHandshake? handshake, DatagramSender sender) : IDisposable
{
    private readonly byte[] binding = BindingOf(handshake);

    /// <summary>Which handshake the join began (<see cref="JoinClaim.Handshake"/>).</summary>
    internal Token128 Handshake { get; init; }

    /// <summary>What the handshake alone has, and the client's proofs cover; empty in a session without protection.</summary>
    internal ReadOnlySpan<byte> Binding => binding;

    /// <summary>Wipes the keys of the handshake.</summary>
    public void Dispose() => handshake?.Dispose();

    /// <summary>Makes the answer that lets the client in, to be sent now and whenever the join is repeated.</summary>
    /// <param name="terms">The terms.</param>
    /// <param name="connectKey">The key that the client proved to know.</param>
    /// <param name="seal">What protects the link; null in a session without protection.</param>
    internal byte[] Welcome(in WelcomeDatagram terms, string connectKey, out LinkSeal? seal)
    {
        if (protection is null || handshake is null)
        {
            byte[] plain = new byte[WireFormat.WelcomeBytes];
            terms.Encode(plain);
            seal = null;
            return plain;
        }

        Span<byte> payload = stackalloc byte[WireFormat.SecureWelcomePayloadBytes];
        WireWriter rest = new(payload.Slice(terms.EncodeTerms(payload)));
        StrayReply.Key(protection, terms.SessionId, sender.LocalAddress).Write(ref rest);
        byte[] bytes = new byte[WireFormat.SecureWelcomeBytes];
        int length = SecureAnswerDatagram.WritePrologue(bytes, DatagramType.SecureWelcome, nonce);
        seal = new LinkSeal(handshake.Accept(connectKey, payload, bytes.AsSpan(length)));
        return bytes;
    }

    /// <summary>Sends the client the reason why it is not let in.</summary>
    /// <param name="reason">The reason.</param>
    /// <param name="secondsOff">How far its connect token is off its time, in seconds; not told in clear text.</param>
    internal void Refuse(RefusalReason reason, uint secondsOff = 0)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.SecureRefusalBytes];
        int length;
        if (handshake is null)
        {
            length = new RefusalDatagram(nonce, reason).Encode(bytes);
        }
        else
        {
            Span<byte> payload = stackalloc byte[WireFormat.SecureRefusalPayloadBytes];
            WireWriter writer = new(payload);
            writer.WriteByte((byte)reason);
            writer.WriteUInt32(secondsOff);
            length = SecureAnswerDatagram.WritePrologue(bytes, DatagramType.SecureRefusal, nonce);
            handshake.Refuse(payload, bytes.Slice(length));
            length = WireFormat.SecureRefusalBytes;
        }

        sender.Send(bytes.Slice(0, length), to);
    }

    private static byte[] BindingOf(IHostHandshake? handshake)
    {
        byte[] bytes = new byte[handshake is null ? 0 : IHostProtection.BindingBytes];
        handshake?.WriteBinding(bytes);
        return bytes;
    }
}
