using System;
using System.Buffers.Binary;
using System.Net;
using System.Net.Sockets;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Fuzz;

/// <summary>
/// Joins from machines that are there: each has an address of the loopback network and a cookie for it, and sends handshakes of noise, and
/// requests for more cookies as if from others.
/// </summary>
internal sealed class JoinFlood : IDisposable
{
    /// <summary>More machines than a host has places.</summary>
    private const int Machines = 32;

    /// <summary>After so many datagrams a machine asks for another cookie, as they expire.</summary>
    private const int DatagramsPerCookie = 1_000;

    private readonly SeededRandom random;
    private readonly Machine[] machines = new Machine[Machines];
    private readonly byte[] buffer = new byte[WireFormat.MaxBytes];
    private long sent;

    internal JoinFlood(PeerAddress host, SeededRandom random)
    {
        this.random = random;
        for (int n = 0; n < Machines; n++)
        {
            machines[n] = new Machine(Open(n, host.ToEndPoint()), random.NextUInt64());
        }
    }

    /// <summary>Sends one datagram more.</summary>
    internal void Send()
    {
        Machine machine = machines[sent % Machines];
        long round = sent++ / Machines;
        if (round % DatagramsPerCookie == 0)
        {
            machine.AskForACookie(buffer);
        }
        else if (round % 2 == 0)
        {
            machine.AskAsAnother(buffer, random.NextUInt64());
        }
        else
        {
            machine.Join(buffer, random);
        }
    }

    /// <inheritdoc/>
    public void Dispose() => Array.ForEach(machines, machine => machine.Socket.Dispose());

    /// <summary>A socket at an address of its own, or where the system has but one loopback address, at a port of its own.</summary>
    private static Socket Open(int number, EndPoint host)
    {
        Socket socket = new(AddressFamily.InterNetwork, SocketType.Dgram, ProtocolType.Udp);
        try
        {
            socket.Bind(new IPEndPoint(new IPAddress([127, 0, 1, (byte)(number + 1)]), 0));
        }
        catch (SocketException)
        {
            socket.Bind(new IPEndPoint(IPAddress.Loopback, 0));
        }

        socket.Connect(host);
        return socket;
    }

    private sealed class Machine(Socket socket, ulong nonce)
    {
        private Token128 cookie;

        internal Socket Socket => socket;

        internal void AskForACookie(byte[] buffer) => Send(buffer, new ConnectRequestDatagram(nonce).Encode(buffer));

        internal void AskAsAnother(byte[] buffer, ulong other) => Send(buffer, new ConnectRequestDatagram(other).Encode(buffer));

        internal void Join(byte[] buffer, SeededRandom random)
        {
            while (socket.Available > 0)
            {
                int length = socket.Receive(buffer);
                bool isChallenge = ChallengeDatagram.TryDecode(buffer.AsSpan(0, length), out ChallengeDatagram challenge, out _);
                cookie = isChallenge && challenge.Nonce == nonce ? challenge.Cookie : cookie;
            }

            for (int at = 0; at < WireFormat.SecureJoinBytes; at += sizeof(ulong))
            {
                BinaryPrimitives.WriteUInt64LittleEndian(buffer.AsSpan(at), random.NextUInt64());
            }

            JoinDatagram.WritePrologue(buffer, DatagramType.SecureJoin, nonce, cookie);
            Send(buffer, WireFormat.SecureJoinBytes);
        }

        private void Send(byte[] buffer, int length)
        {
            try
            {
                socket.Send(buffer, length, SocketFlags.None);
            }
            catch (SocketException)
            {
                // the system's buffer is full: the flood is what it takes
            }
        }
    }
}
