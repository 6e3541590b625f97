using System;
using System.IO;
using System.Net;
using System.Net.Sockets;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Relays;

/// <summary>
/// A relay that simulates a link profile between real processes. Clients send to it as if it were the host; it forwards datagrams in both
/// directions with the profile's delays and losses.
/// </summary>
/// <remarks>
/// <para>Each client has its own socket towards the host, so the host sees separate clients as it would without a relay. Each client also
/// has its own link, with random numbers that depend on the seed and on the number of clients before it. Periodic disturbances in the
/// profile affect both directions of a link at once. Datagrams are forwarded unchanged, whatever they contain.</para>
/// <para>A background thread waits, without spinning, for the next datagram that arrives or falls due. It is late by the operating system's
/// timer: about 1 ms on Linux and macOS, up to 16 ms on Windows. What happens to a datagram depends on the seed and the order of arrival;
/// when it is due also depends on the clock. The profile's <see cref="LinkProfile.ReceiverClockOffset"/> is ignored. A bulk transfer in the
/// profile is simulated beside the real traffic, from a client's first datagram on, with its own link for each client.</para>
/// <para>Safe on any thread.</para>
/// </remarks>
public sealed class UdpRelay : IDisposable
{
    /// <summary>
    /// The most clients ever, since one that has left keeps its place. Datagrams of further ones are refused and counted.
    /// </summary>
    public const int MaxClients = 64;

    private readonly IClock clock;
    private readonly RelayCore core;
    private readonly WorldThread thread;
    private readonly IPEndPoint towardsHost;

    /// <summary>Opens the relay and starts forwarding.</summary>
    /// <param name="listen">The endpoint for clients. Port 0 takes any free one; read it from <see cref="LocalAddress"/>.</param>
    /// <param name="host">The endpoint of the host.</param>
    /// <param name="profile">The profile of each client's link.</param>
    /// <param name="seed">The seed of all links.</param>
    /// <param name="clock">The real-time clock, read from the relay's thread.</param>
    /// <param name="change">The interval after which the host sees each client at another port, repeatedly; null, the default, for
    /// never.</param>
    /// <exception cref="ArgumentException"><paramref name="host"/> is not the address of one machine and a port from 1 on, or is the
    /// relay's own.</exception>
    /// <exception cref="IOException">The system refuses <paramref name="listen"/>, for instance because its port is in use.</exception>
    public UdpRelay(IPEndPoint listen, IPEndPoint host, LinkProfile profile, ulong seed, IClock clock, SimDuration? change = null)
    {
        ArgumentNullException.ThrowIfNull(listen);
        ArgumentNullException.ThrowIfNull(host);
        ArgumentNullException.ThrowIfNull(profile);
        ArgumentNullException.ThrowIfNull(clock);
        PeerAddress address = PeerAddress.From(host);
        if (!UdpDestination.IsOneMachine(host, "relay to", out string? error))
        {
            throw new ArgumentException(error, nameof(host));
        }

        this.clock = clock;
        towardsHost = UdpDestination.Facing(address.ToEndPoint().Address);
        UdpPort front = new(listen);
        LocalAddress = front.LocalAddress;
        if (host.Port == LocalAddress.ToEndPoint().Port && IsReachedAt(listen.Address, host.Address))
        {
            front.Dispose();
            throw new ArgumentException($"'{host}' is the relay's own address, to which it would pass everything on for ever; it takes the host's.", nameof(host));
        }

        core = new RelayCore(front, address, profile, seed, MaxClients, OpenPort, change);
        thread = new WorldThread("LagSim relay", Step);
        front.Arrived += thread.Wake;
        thread.Start();
    }

    /// <summary>The address for clients. It is on this machine only, if the relay listens on all addresses.</summary>
    public PeerAddress LocalAddress { get; }

    /// <summary>The traffic so far. Complete once the relay is disposed; a moment behind while it works.</summary>
    /// <exception cref="InvalidOperationException">The relay's thread ended with an exception, the inner one.</exception>
    public RelayTraffic Traffic
    {
        get
        {
            thread.ThrowIfFaulted();
            return core.Traffic;
        }
    }

    /// <summary>
    /// Moves every client to another port towards the host. What the host still sends to the former port is lost. Safe on any thread.
    /// </summary>
    public void ChangePorts()
    {
        core.ChangePorts();
        thread.Wake();
    }

    /// <summary>Stops at once and closes all sockets. Datagrams in transit are lost. Safe to call twice.</summary>
    public void Dispose()
    {
        thread.Dispose();
        core.Dispose();
    }

    /// <summary>
    /// Whether a datagram to an address with the right port reaches the listener: it listens on that very address, or on any of this
    /// machine.
    /// </summary>
    private static bool IsReachedAt(IPAddress listening, IPAddress to)
    {
        bool listensOnAll = listening.Equals(IPAddress.Any) || listening.Equals(IPAddress.IPv6Any);
        return Plain(listening).Equals(Plain(to)) || (listensOnAll && IsOfThisMachine(to));

        static IPAddress Plain(IPAddress address) => address.IsIPv4MappedToIPv6 ? address.MapToIPv4() : address;
    }

    /// <summary>Whether an address belongs to this machine: only then can a socket be bound to it.</summary>
    private static bool IsOfThisMachine(IPAddress address)
    {
        try
        {
            using Socket probe = new(address.AddressFamily, SocketType.Dgram, ProtocolType.Udp);
            probe.Bind(new IPEndPoint(address, 0));
            return true;
        }
        catch (SocketException)
        {
            return false;
        }
    }

    private SimDuration Step() => core.Poll(clock.Now) is SimTime next ? next - clock.Now : SimDuration.MaxValue;

    private UdpPort? OpenPort()
    {
        try
        {
            UdpPort port = new(towardsHost);
            port.Arrived += thread.Wake;
            return port;
        }
        catch (IOException)
        {
            return null; // the system has no more sockets; the client's next datagram tries again
        }
    }
}
