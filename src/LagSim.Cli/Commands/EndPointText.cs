using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Net;
using System.Net.NetworkInformation;
using System.Net.Sockets;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Cli.Output;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;

namespace LagSim.Cli.Commands;

/// <summary>The address of a host as a user writes it: <c>ADDRESS:PORT</c>, <c>[IPv6]:PORT</c> or <c>NAME:PORT</c>.</summary>
internal static class EndPointText
{
    /// <summary>The most addresses of one name that are tried.</summary>
    internal const int MaxTried = 6;

    /// <summary>Looks a name up, as <see cref="Dns"/> does.</summary>
    internal delegate Task<IPAddress[]> Lookup(string name, CancellationToken stop);

    /// <summary>Parses the text.</summary>
    /// <exception cref="UsageException">The text does not have this form.</exception>
    internal static (string Host, int Port) Parse(string text)
    {
        int colon = text.LastIndexOf(':');
        string host = colon < 0 ? "" : text[..colon];
        bool isBracketed = host.Length > 2 && host[0] == '[' && host[^1] == ']';
        bool isHost = isBracketed ? HostText.TryReadV6(host[1..^1], out _, out _)
            : host.Length > 0 && !host.Any(c => c is ':' or '[' or ']' || char.IsWhiteSpace(c));
        if (!isHost)
        {
            throw new UsageException($"'{text}' does not say where the host is: write ADDRESS:PORT, as 192.168.0.7:5000, [::1]:5000 or some.name:5000.");
        }

        return int.TryParse(text[(colon + 1)..], NumberStyles.None, CultureInfo.InvariantCulture, out int port) && port is > 0 and <= 65535
            ? (isBracketed ? host[1..^1] : host, port)
            : throw new UsageException($"The port in '{text}' is '{text[(colon + 1)..]}'; it must be a whole number between 1 and 65535.");
    }

    /// <summary>The one spelling of an address that a user may write in several ways.</summary>
    /// <exception cref="UsageException">The text does not have the form.</exception>
    internal static string Spelling(string text)
    {
        (string host, int port) = Parse(text);
        host = !HostText.TryReadV6(host, out IPAddress? address, out _) ? host.ToLowerInvariant()
            : address!.IsIPv4MappedToIPv6 ? address.MapToIPv4().ToString() : $"[{HostText.Canonical(host)}]";
        return string.Create(CultureInfo.InvariantCulture, $"{host}:{port}");
    }

    /// <summary>An address as text, its zone by name where it has one and the system tells it.</summary>
    internal static string Write(IPAddress address) => address.AddressFamily == AddressFamily.InterNetworkV6 && address.ScopeId != 0
        ? $"{new IPAddress(address.GetAddressBytes())}%{ZoneOf(address.ScopeId)}" : address.ToString();

    /// <summary>An address and port as text; see <see cref="Write(IPAddress)"/>.</summary>
    internal static string Write(IPEndPoint place) => string.Create(
        CultureInfo.InvariantCulture, $"{(place.AddressFamily == AddressFamily.InterNetworkV6 ? $"[{Write(place.Address)}]" : Write(place.Address))}:{place.Port}");

    /// <summary>Resolves the address. Of several addresses of a name it returns the first, IPv4 before IPv6.</summary>
    /// <param name="text">The text that the user wrote.</param>
    /// <param name="purpose">The use of the host, as a verb, for messages.</param>
    /// <param name="stop">Cancels the name lookup.</param>
    /// <exception cref="UsageException">The text does not have the form.</exception>
    /// <exception cref="InputException">The name is unknown, or the address cannot belong to a machine.</exception>
    /// <exception cref="OperationCanceledException">The user has asked for an end.</exception>
    internal static IPEndPoint Resolve(string text, string purpose, CancellationToken stop) => First(ResolveAll(text, purpose, stop));

    /// <summary>The one to take where only one can be: IPv4 before IPv6.</summary>
    internal static IPEndPoint First(IEnumerable<IPEndPoint> found) => found.OrderBy(one => one.AddressFamily != AddressFamily.InterNetwork).First();

    /// <summary>Resolves the address, to all those that a name has, in the order in which to try them.</summary>
    /// <remarks>The system's own first, and then one of each kind in turn, so that a kind that is broken costs one try (RFC 8305, 4).</remarks>
    /// <inheritdoc cref="Resolve(string, string, CancellationToken)"/>
    internal static IReadOnlyList<IPEndPoint> ResolveAll(string text, string purpose, CancellationToken stop, Lookup? lookup = null)
    {
        IPEndPoint[] found = Find(text, lookup ?? Dns.GetHostAddressesAsync, stop);
        string? error = null;
        IPEndPoint[] machines = [.. found.Where(one => UdpDestination.IsOneMachine(one, purpose, out error))];
        return machines.Length > 0 ? machines : throw new InputException(error!);
    }

    private static IPEndPoint[] Find(string text, Lookup lookup, CancellationToken stop)
    {
        (string host, int port) = Parse(text);
        if (Literal(host) is IPAddress literal)
        {
            return [new IPEndPoint(literal, port)];
        }

        try
        {
            IPAddress[] found = lookup(host, stop).GetAwaiter().GetResult();
            IPEndPoint[] usable = [.. found
                .Where(one => one.AddressFamily is AddressFamily.InterNetwork || (one.AddressFamily == AddressFamily.InterNetworkV6 && Socket.OSSupportsIPv6))
                .Select(Unmapped).Distinct().Select(one => new IPEndPoint(one, port))];
            return usable.Length == 0 ? throw new InputException($"The host '{host}' has no IP address.") : InTurn(usable);
        }
        catch (Exception failure) when (failure is SocketException or ArgumentException)
        {
            throw new InputException($"The host '{host}' is not known: {failure.Message}.", failure);
        }
    }

    /// <summary>The address that a text is; null for a name.</summary>
    /// <exception cref="InputException">It has a zone that this machine does not have.</exception>
    private static IPAddress? Literal(string host)
    {
        if (!HostText.TryReadV6(host, out IPAddress? address, out string zone))
        {
            return IPAddress.TryParse(host, out address) ? address : null;
        }

        return zone.Length == 0 ? Unmapped(address!)
            : IPAddress.TryParse(host, out IPAddress? zoned) && zoned.ScopeId != 0 ? zoned
            : throw new InputException($"'{host}' is in the zone '{zone}', and this machine has no network interface of that name or number.");
    }

    /// <summary>An IPv4 address that is written as one of IPv6 is reached over IPv4.</summary>
    private static IPAddress Unmapped(IPAddress address) => address.IsIPv4MappedToIPv6 ? address.MapToIPv4() : address;

    private static string ZoneOf(long number)
    {
        NetworkInterface? face = null;
        try
        {
            face = Array.Find(NetworkInterface.GetAllNetworkInterfaces(), one =>
                one.Supports(NetworkInterfaceComponent.IPv6) && one.GetIPProperties().GetIPv6Properties().Index == number);
        }
        catch (NetworkInformationException)
        {
            // A system that does not tell.
        }

        return face is not null && !OperatingSystem.IsWindows() && HostText.IsZone(face.Name) ? face.Name : number.ToString(CultureInfo.InvariantCulture);
    }

    /// <summary>One of each kind in turn, in the order in which they come, and not too many.</summary>
    private static IPEndPoint[] InTurn(IPEndPoint[] found)
    {
        ILookup<bool, IPEndPoint> kinds = found.ToLookup(one => one.AddressFamily == found[0].AddressFamily);
        return [.. kinds[true].Select((one, at) => (one, at: 2 * at)).Concat(kinds[false].Select((one, at) => (one, at: (2 * at) + 1)))
            .OrderBy(pair => pair.at).Select(pair => pair.one).Take(MaxTried)];
    }

    /// <summary>An address to bind to.</summary>
    /// <exception cref="UsageException">The text is no such address.</exception>
    internal static IPAddress ParseLocal(string option, string text) =>
        !text.Contains('[', StringComparison.Ordinal) && IPAddress.TryParse(text, out IPAddress? address)
            ? Unmapped(address)
            : throw new UsageException($"{option} is '{text}'; it must be an IP address of this machine, as 127.0.0.1, or 0.0.0.0 or :: for all.");
}
