using System.Collections.Generic;
using System.Linq;
using System.Net;
using System.Net.NetworkInformation;

namespace LagSim.Cli.Commands;

/// <summary>The addresses at which others reach a host that listens on a local address.</summary>
internal static class ReachableAddresses
{
    /// <summary>
    /// The address itself; for one that stands for all, this machine's of its family, of the loopback only if there is no other.
    /// </summary>
    internal static IReadOnlyList<IPAddress> Of(IPAddress local)
    {
        if (!local.Equals(IPAddress.Any) && !local.Equals(IPAddress.IPv6Any))
        {
            return [local];
        }

        List<IPAddress> all;
        try
        {
            all = NetworkInterface.GetAllNetworkInterfaces()
                .Where(face => face.OperationalStatus == OperationalStatus.Up)
                .SelectMany(face => face.GetIPProperties().UnicastAddresses)
                .Select(unicast => unicast.Address)
                .Where(address => address.AddressFamily == local.AddressFamily && !address.IsIPv6LinkLocal)
                .ToList();
        }
        catch (NetworkInformationException)
        {
            all = []; // a system that does not tell
        }

        List<IPAddress> outward = all.FindAll(address => !IPAddress.IsLoopback(address));
        return outward.Count > 0 ? outward : [local.Equals(IPAddress.Any) ? IPAddress.Loopback : IPAddress.IPv6Loopback];
    }
}
