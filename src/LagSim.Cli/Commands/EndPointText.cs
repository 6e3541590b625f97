using System;
using System.Globalization;
using System.Linq;
using System.Net;
using System.Net.Sockets;
using System.Threading;
using LagSim.Cli.Output;
using LagSim.Net.Carriers;

namespace LagSim.Cli.Commands;

/// <summary>The address of a host as a user writes it: <c>ADDRESS:PORT</c>, <c>[IPv6]:PORT</c> or <c>NAME:PORT</c>.</summary>
internal static class EndPointText
{
    /// <summary>Parses the text.</summary>
    /// <exception cref="UsageException">The text does not have this form.</exception>
    internal static (string Host, int Port) Parse(string text)
    {
        int colon = text.LastIndexOf(':');
        string host = colon < 0 ? "" : text[..colon];
        bool isBracketed = host.Length > 2 && host[0] == '[' && host[^1] == ']';
        bool isHost = isBracketed
            ? IPAddress.TryParse(host[1..^1], out IPAddress? address) && address.AddressFamily == AddressFamily.InterNetworkV6
            : host.Length > 0 && !host.Any(c => c is ':' or '[' or ']' || char.IsWhiteSpace(c));
        if (!isHost)
        {
            throw new UsageException($"'{text}' does not say where the host is: write ADDRESS:PORT, as 192.168.0.7:5000, [::1]:5000 or some.name:5000.");
        }

        return int.TryParse(text[(colon + 1)..], NumberStyles.None, CultureInfo.InvariantCulture, out int port) && port is > 0 and <= 65535
            ? (isBracketed ? host[1..^1] : host, port)
            : throw new UsageException($"The port in '{text}' is '{text[(colon + 1)..]}'; it must be a whole number between 1 and 65535.");
    }

    /// <summary>Resolves the address. Of several addresses of a name it returns the first, IPv4 before IPv6.</summary>
    /// <param name="text">The text that the user wrote.</param>
    /// <param name="purpose">The use of the host, as a verb, for messages.</param>
    /// <param name="stop">Cancels the name lookup.</param>
    /// <exception cref="UsageException">The text does not have the form.</exception>
    /// <exception cref="InputException">The name is unknown, or the address cannot belong to a machine.</exception>
    /// <exception cref="OperationCanceledException">The user has asked for an end.</exception>
    internal static IPEndPoint Resolve(string text, string purpose, CancellationToken stop)
    {
        IPEndPoint found = Find(text, stop);
        return UdpDestination.IsOneMachine(found, purpose, out string? error) ? found : throw new InputException(error);
    }

    private static IPEndPoint Find(string text, CancellationToken stop)
    {
        (string host, int port) = Parse(text);
        if (IPAddress.TryParse(host, out IPAddress? literal))
        {
            return new IPEndPoint(literal, port);
        }

        try
        {
            IPAddress[] found = Dns.GetHostAddressesAsync(host, stop).GetAwaiter().GetResult();
            IPAddress? address = found.FirstOrDefault(a => a.AddressFamily == AddressFamily.InterNetwork)
                ?? found.FirstOrDefault(a => a.AddressFamily == AddressFamily.InterNetworkV6);
            return address is null ? throw new InputException($"The host '{host}' has no IP address.") : new IPEndPoint(address, port);
        }
        catch (Exception failure) when (failure is SocketException or ArgumentException)
        {
            throw new InputException($"The host '{host}' is not known: {failure.Message}.", failure);
        }
    }

    /// <summary>An address to bind to.</summary>
    /// <exception cref="UsageException">The text is no such address.</exception>
    internal static IPAddress ParseLocal(string option, string text) =>
        !text.Contains('[', StringComparison.Ordinal) && IPAddress.TryParse(text, out IPAddress? address)
            ? address
            : throw new UsageException($"{option} is '{text}'; it must be an IP address of this machine, as 127.0.0.1, or 0.0.0.0 or :: for all.");
}
