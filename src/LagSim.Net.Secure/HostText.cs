using System;
using System.Net;
using System.Net.Sockets;

namespace LagSim.Net.Protection;

/// <summary>A host in an address, as text: an IPv4 or IPv6 address, or a name.</summary>
/// <remarks>
/// The zone of a link-local address stays as it is written, by name or by number. The system knows zones by number alone, and which number a
/// name has differs from machine to machine and from day to day.
/// </remarks>
internal static class HostText
{
    /// <summary>The one spelling of a host; null if the text is none.</summary>
    internal static string? Canonical(string host)
    {
        if (host.IndexOf(':') >= 0)
        {
            return TryReadV6(host, out IPAddress? six, out string zone) ? zone.Length == 0 ? six!.ToString() : $"{six}%{zone}" : null;
        }

        foreach (char c in host)
        {
            if (c is not ((>= 'a' and <= 'z') or (>= '0' and <= '9') or '-' or '.'))
            {
                return null;
            }
        }

        bool isNumeric = host.Length > 0 && host[host.Length - 1] is >= '0' and <= '9';
        if (isNumeric && IPAddress.TryParse(host, out IPAddress? four))
        {
            return four.ToString();
        }

        return Uri.CheckHostName(host) == UriHostNameType.Dns ? host : null;
    }

    /// <summary>Reads an IPv6 address without brackets.</summary>
    /// <param name="text">The text.</param>
    /// <param name="address">The address, without its zone; null if the text is none.</param>
    /// <param name="zone">The zone of a link-local address; empty for none.</param>
    internal static bool TryReadV6(string text, out IPAddress? address, out string zone)
    {
        int percent = text.IndexOf('%');
        zone = percent < 0 ? "" : text.Substring(percent + 1);
        bool isOne = IPAddress.TryParse(percent < 0 ? text : text.Substring(0, percent), out address)
            && address.AddressFamily == AddressFamily.InterNetworkV6 && (percent < 0 || (address.IsIPv6LinkLocal && IsZone(zone)));
        address = isOne ? address : null;
        return isOne;
    }

    /// <summary>Whether a text can be a zone: what an address on the web may have there (RFC 6874).</summary>
    internal static bool IsZone(string text)
    {
        foreach (char c in text)
        {
            if (c is not ((>= 'a' and <= 'z') or (>= 'A' and <= 'Z') or (>= '0' and <= '9') or '-' or '.' or '_' or '~'))
            {
                return false;
            }
        }

        return text.Length > 0;
    }
}
