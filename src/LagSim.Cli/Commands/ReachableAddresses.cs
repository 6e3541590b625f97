using System;
using System.Collections.Generic;
using System.Linq;
using System.Net;
using System.Net.NetworkInformation;
using System.Net.Sockets;

namespace LagSim.Cli.Commands;

/// <summary>The addresses at which others reach a host that listens on a local address.</summary>
internal static class ReachableAddresses
{
    /// <summary>
    /// The address itself; for one that stands for all, this machine's, of the loopback only if there is no other. On <c>::</c> a host is
    /// reached by both kinds: those of IPv6 come first.
    /// </summary>
    internal static IReadOnlyList<IPAddress> Of(IPAddress local) => Of(local, OfThisMachine);

    /// <inheritdoc cref="Of(IPAddress)"/>
    /// <param name="local">The address that a host listens on.</param>
    /// <param name="ofThisMachine">Returns all addresses of this machine.</param>
    internal static IReadOnlyList<IPAddress> Of(IPAddress local, Func<IEnumerable<IPAddress>> ofThisMachine)
    {
        if (!local.Equals(IPAddress.Any) && !local.Equals(IPAddress.IPv6Any))
        {
            return [local];
        }

        AddressFamily[] kinds = local.Equals(IPAddress.Any)
            ? [AddressFamily.InterNetwork] : [AddressFamily.InterNetworkV6, AddressFamily.InterNetwork];
        IPAddress[] outward = [.. ofThisMachine().Where(address => !address.IsIPv6LinkLocal && !IPAddress.IsLoopback(address))];
        IPAddress[] reachable = [.. kinds.SelectMany(kind => outward.Where(address => address.AddressFamily == kind))];
        return reachable.Length > 0 ? reachable
            : [.. kinds.Select(kind => kind == AddressFamily.InterNetwork ? IPAddress.Loopback : IPAddress.IPv6Loopback)];
    }

    private static IEnumerable<IPAddress> OfThisMachine()
    {
        try
        {
            return [.. NetworkInterface.GetAllNetworkInterfaces()
                .Where(face => face.OperationalStatus == OperationalStatus.Up)
                .SelectMany(face => face.GetIPProperties().UnicastAddresses)
                .Select(unicast => unicast.Address)];
        }
        catch (NetworkInformationException)
        {
            return []; // a system that does not tell
        }
    }
}
