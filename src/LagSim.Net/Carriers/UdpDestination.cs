using System;
using System.Diagnostics.CodeAnalysis;
using System.Net;
using System.Net.Sockets;

namespace LagSim.Net.Carriers;

/// <summary>Checks an address given by a user, and chooses the local address to reach it from.</summary>
internal static class UdpDestination
{
    /// <summary>
    /// Whether it is the address of one machine, and a port from 1 on. A port that listens on "all addresses" can be reached at each of
    /// them, but not at that.
    /// </summary>
    /// <param name="endpoint">The address and port.</param>
    /// <param name="purpose">The purpose, as a verb; part of the error sentence.</param>
    /// <param name="error">If not, a sentence that names the address and says what is allowed.</param>
    /// <exception cref="ArgumentNullException">The endpoint is null.</exception>
    public static bool IsOneMachine(IPEndPoint endpoint, string purpose, [NotNullWhen(false)] out string? error)
    {
        if (endpoint is null)
        {
            throw new ArgumentNullException(nameof(endpoint));
        }

        IPAddress address = endpoint.Address.IsIPv4MappedToIPv6 ? endpoint.Address.MapToIPv4() : endpoint.Address;
        bool isNone = endpoint.Port == 0 || address.Equals(IPAddress.Any) || address.Equals(IPAddress.IPv6Any) || address.Equals(IPAddress.Broadcast);
        error = isNone ? $"'{endpoint}' is no host to {purpose}: it takes the address of one machine and a port from 1 to {IPEndPoint.MaxPort}." : null;
        return !isNone;
    }

    /// <summary>
    /// Returns the local address, with any free port, from which a machine is reached at one of its addresses: loopback reaches loopback
    /// only, and a port on all of IPv6 reaches both kinds.
    /// </summary>
    /// <exception cref="ArgumentNullException">The address is null.</exception>
    public static IPEndPoint Facing(IPAddress machine, params IPAddress[] others)
    {
        if (machine is null)
        {
            throw new ArgumentNullException(nameof(machine));
        }

        bool isLoopback = IPAddress.IsLoopback(machine) && Array.TrueForAll(others, IPAddress.IsLoopback);
        bool v6 = machine.AddressFamily == AddressFamily.InterNetworkV6;
        if (!Array.TrueForAll(others, other => other.AddressFamily == machine.AddressFamily))
        {
            return new IPEndPoint(IPAddress.IPv6Any, 0); // also for the two loopbacks: no port is bound to both alone
        }

        return new IPEndPoint(
            isLoopback ? (v6 ? IPAddress.IPv6Loopback : IPAddress.Loopback) : (v6 ? IPAddress.IPv6Any : IPAddress.Any), 0);
    }
}
