using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Tests.Sessions;

/// <summary>
/// Somebody who comes in as the rules have it, and then only costs: it answers at once whatever it needs to be answered, and asks for the
/// rest when told to.
/// </summary>
/// <remarks>Unlike <see cref="RawClient"/> it lets no time pass, so a thousand of them can be at it at once.</remarks>
internal sealed class Intruder
{
    private readonly IDatagramPort port;
    private readonly byte[] buffer = new byte[WireFormat.MaxBytes];
    private readonly bool sits;
    private ulong nonce;
    private uint number;
    private uint fetches;

    /// <param name="group">Whom it bothers.</param>
    /// <param name="node">Its number in the network.</param>
    /// <param name="sits">Whether it takes a place as soon as it is welcome.</param>
    internal Intruder(SessionGroup group, int node, bool sits = false)
    {
        this.sits = sits;
        group.Network.Connect(node, 0, LinkProfiles.PureDelay(1));
        port = group.Network.CreatePort(node);
        port.Arrived += Receive;
    }

    /// <summary>The session that it was welcomed to last; 0 before.</summary>
    internal ulong SessionId { get; private set; }

    /// <summary>The number that it was given; 0 while it has none.</summary>
    internal byte Peer { get; private set; }

    /// <summary>How long the copy is that it was welcomed to last.</summary>
    internal int SnapshotBytes { get; private set; }

    /// <summary>What tells that copy from others.</summary>
    internal ulong CopyHash { get; private set; }

    internal long BytesIn { get; private set; }

    internal long BytesOut { get; private set; }

    /// <summary>Begins to come in, under another nonce each time.</summary>
    internal void ConnectRequest()
    {
        nonce++;
        byte[] bytes = new byte[WireFormat.ConnectRequestBytes];
        new ConnectRequestDatagram(nonce).Encode(bytes);
        Send(bytes);
    }

    /// <summary>Asks for as many pieces of the copy as can be asked for.</summary>
    internal void Fetch(ulong wanted = ulong.MaxValue)
    {
        byte[] bytes = new byte[WireFormat.SnapshotRequestBytes];
        new SnapshotRequestDatagram(SessionId, 0, ++fetches, 0, wanted).Encode(bytes);
        Send(bytes);
    }

    /// <summary>Says that it is there, as one that is in or not.</summary>
    internal void Update(bool isReady)
    {
        UpdateDatagram update = new() { SessionId = SessionId, Peer = Peer, Number = ++number, Ready = isReady };
        update.Sent = SimTime.FromSeconds(number);
        byte[] bytes = new byte[update.EncodedLength];
        update.Encode(bytes);
        Send(bytes);
    }

    internal void Send(byte[] bytes)
    {
        BytesOut += bytes.Length + PortTraffic.HeaderBytes;
        port.Send(bytes, PeerAddress.Virtual(0));
    }

    private void Receive()
    {
        while (port.TryReceive(buffer, out int length, out _))
        {
            BytesIn += length + PortTraffic.HeaderBytes;
            ReadOnlySpan<byte> datagram = buffer.AsSpan(0, length);
            if (ChallengeDatagram.TryDecode(datagram, out ChallengeDatagram challenge, out _) && challenge.Nonce == nonce)
            {
                byte[] bytes = new byte[WireFormat.JoinBytes];
                Token128 proof = JoinCookies.Prove("", nonce, challenge.Cookie);
                new JoinDatagram(nonce, challenge.Cookie, proof, 0, (uint)Simulation.FoldVersion).Encode(bytes);
                Send(bytes);
            }
            else if (WelcomeDatagram.TryDecode(datagram, out WelcomeDatagram welcome, out _))
            {
                (SessionId, Peer, number, fetches, SnapshotBytes, CopyHash) =
                    (welcome.SessionId, 0, 0, 0, welcome.CopyLength, welcome.CopyHash);
                if (sits)
                {
                    Update(isReady: true);
                }
            }
            else if (SeatDatagram.TryDecode(datagram, out SeatDatagram seat, out _))
            {
                Peer = seat.Peer;
            }
        }
    }
}
