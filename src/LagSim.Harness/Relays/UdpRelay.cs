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
/// A link profile between real processes: clients send to this relay as if it were the host, and it passes their datagrams on to the host,
/// and the host's answers back, as late and with as many losses as the profile says.
/// </summary>
/// <remarks>
/// <para>Each client has a socket of its own towards the host, so that the host tells them apart as it would without a relay, and a link of
/// its own: its luck depends on the seed and on how many clients were heard of before it. What the profile has in periods befalls both
/// directions of a client's link at once. Datagrams are handed on as they are, whatever is in them.</para>
/// <para>A thread of its own waits, without spinning, for the next datagram that comes in or falls due; it is late by the operating
/// system's timer: about 1 ms on Linux and macOS, up to 16 ms on Windows. Which luck a datagram meets depends on the seed and the order of
/// arrival; when it is due also on the clock. The profile's <see cref="LinkProfile.ReceiverClockOffset"/> is no matter of a relay. A bulk
/// transfer of the profile's is simulated beside what is real, from a client's first datagram on, for each client on a link of its
/// own.</para>
/// <para>Safe on any thread.</para>
/// </remarks>
public sealed class UdpRelay : IDisposable
{
    /// <summary>
    /// The most clients there can be, ever: one that has left keeps its place. Datagrams of others are refused and counted.
    /// </summary>
    public const int MaxClients = 64;

    private readonly IClock clock;
    private readonly RelayCore core;
    private readonly WorldThread thread;
    private readonly IPEndPoint towardsHost;

    /// <summary>Opens the relay and begins to pass on.</summary>
    /// <param name="listen">Where clients send to; port 0 takes any free one, which <see cref="LocalAddress"/> then tells.</param>
    /// <param name="host">Where the host listens.</param>
    /// <param name="profile">What each client's link does.</param>
    /// <param name="seed">The luck of all links.</param>
    /// <param name="clock">Real time, read from the relay's thread.</param>
    /// <param name="change">After how long the host sees each client at another port, again and again; null, the default, for
    /// never.</param>
    /// <exception cref="ArgumentException"><paramref name="host"/> is not the address of one machine and a port from 1 on, or is the
    /// relay's own.</exception>
    /// <exception cref="IOException">The system does not give <paramref name="listen"/>, for instance because its port is in
    /// use.</exception>
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

    /// <summary>Where clients reach the relay; on this machine only, if it listens on every address there is.</summary>
    public PeerAddress LocalAddress { get; }

    /// <summary>What went through so far; all of it once the relay is disposed, a moment less while it works.</summary>
    /// <exception cref="InvalidOperationException">The relay's thread ended by an exception, the inner one.</exception>
    public RelayTraffic Traffic
    {
        get
        {
            thread.ThrowIfFaulted();
            return core.Traffic;
        }
    }

    /// <summary>
    /// Has the host see every client at another port from now on; what it still sends to the former is lost. From any thread.
    /// </summary>
    public void ChangePorts()
    {
        core.ChangePorts();
        thread.Wake();
    }

    /// <summary>Stops at once and closes all sockets; what is still on its way is lost. Safe to call twice.</summary>
    public void Dispose()
    {
        thread.Dispose();
        core.Dispose();
    }

    /// <summary>
    /// Whether what is sent to an address of the right port comes to who listens at one: at that very address, or at any of this machine.
    /// </summary>
    private static bool IsReachedAt(IPAddress listening, IPAddress to)
    {
        bool listensOnAll = listening.Equals(IPAddress.Any) || listening.Equals(IPAddress.IPv6Any);
        return Plain(listening).Equals(Plain(to)) || (listensOnAll && IsOfThisMachine(to));

        static IPAddress Plain(IPAddress address) => address.IsIPv4MappedToIPv6 ? address.MapToIPv4() : address;
    }

    /// <summary>A socket can be bound to addresses of this machine, and to no others.</summary>
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
            return null; // the system has no more; the client's next datagram asks again
        }
    }
}
