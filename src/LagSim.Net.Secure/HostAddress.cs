using System;
using System.Globalization;
using System.Net;

namespace LagSim.Net.Protection;

/// <summary>
/// Where a host is and who it is, in one line: <c>lagsim://HOST:PORT#FINGERPRINT</c>. It is all that a client needs, and no secret.
/// </summary>
/// <remarks>
/// HOST is an IPv4 address, an IPv6 address in brackets, or a name in lower case. A link-local IPv6 address may have a zone, as in
/// <c>[fe80::1%eth0]</c>: by which of its networks a machine reaches it. There is one spelling of each address: what
/// <see cref="ToString"/> gives is the only text that <see cref="TryParse"/> takes. Immutable, safe on any thread.
/// </remarks>
public sealed class HostAddress : IEquatable<HostAddress>
{
    private const string Scheme = "lagsim://";

    /// <summary>Creates an address.</summary>
    /// <param name="host">An IP address without brackets, link-local ones with a zone too, or a name of lower-case letters, digits, hyphens and dots.</param>
    /// <param name="port">The UDP port, 1 to 65,535.</param>
    /// <param name="fingerprint">The host's fingerprint.</param>
    /// <exception cref="ArgumentException">The host or the fingerprint is none.</exception>
    /// <exception cref="ArgumentOutOfRangeException">The port is out of range.</exception>
    public HostAddress(string host, int port, HostFingerprint fingerprint)
    {
        Host = HostText.Canonical(host ?? throw new ArgumentNullException(nameof(host)))
            ?? throw new ArgumentException(
                $"'{host}' is neither an IP address nor a name of lower-case letters, digits, hyphens and dots.", nameof(host));
        if (port is < 1 or > IPEndPoint.MaxPort)
        {
            throw new ArgumentOutOfRangeException(nameof(port), port, $"A host's UDP port is a number from 1 to {IPEndPoint.MaxPort}.");
        }

        if (fingerprint == default)
        {
            throw new ArgumentException("The fingerprint is the default, which is no host's.", nameof(fingerprint));
        }

        Port = port;
        Fingerprint = fingerprint;
    }

    /// <summary>The IP address, without brackets, with its zone if it has one; or the name.</summary>
    public string Host { get; }

    /// <summary>The UDP port.</summary>
    public int Port { get; }

    /// <summary>The host's fingerprint.</summary>
    public HostFingerprint Fingerprint { get; }

    /// <summary>Reads an address.</summary>
    /// <exception cref="FormatException">The text is none, with a sentence that says what is wrong.</exception>
    /// <exception cref="ArgumentNullException">The text is null.</exception>
    public static HostAddress Parse(string text) =>
        Read(text ?? throw new ArgumentNullException(nameof(text)), out string? error) ?? throw new FormatException(error);

    /// <summary>Reads an address.</summary>
    /// <param name="text">The text.</param>
    /// <param name="address">The address; null if the text is none.</param>
    /// <returns>False if the text is none. Never throws.</returns>
    public static bool TryParse(string? text, out HostAddress? address)
    {
        address = text is null ? null : Read(text, out _);
        return address is not null;
    }

    /// <inheritdoc/>
    public bool Equals(HostAddress? other) =>
        other is not null && Host == other.Host && Port == other.Port && Fingerprint == other.Fingerprint;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => Equals(obj as HostAddress);

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Host, Port, Fingerprint);

    /// <summary>The one spelling of this address.</summary>
    public override string ToString() =>
        Host.IndexOf(':') >= 0
            ? FormattableString.Invariant($"{Scheme}[{Host}]:{Port}#{Fingerprint}")
            : FormattableString.Invariant($"{Scheme}{Host}:{Port}#{Fingerprint}");

    private static HostAddress? Read(string text, out string? error)
    {
        error = $"'{text}' is not of the form lagsim://HOST:PORT#FINGERPRINT";
        if (!text.StartsWith(Scheme, StringComparison.Ordinal))
        {
            error += $": it does not begin with '{Scheme}'.";
            return null;
        }

        int hash = text.IndexOf('#');
        if (hash < 0 || !HostFingerprint.TryParse(text.Substring(hash + 1), out HostFingerprint fingerprint) || fingerprint == default)
        {
            error += $": after '#' come the {HostFingerprint.TextLength} hexadecimal digits, in lower case, that the host prints.";
            return null;
        }

        string place = text.Substring(Scheme.Length, hash - Scheme.Length);
        int colon = place.LastIndexOf(':');
        string digits = colon < 0 ? "" : place.Substring(colon + 1);
        if (!int.TryParse(digits, NumberStyles.None, CultureInfo.InvariantCulture, out int port) || port is < 1 or > IPEndPoint.MaxPort)
        {
            error += $": the port must be a number from 1 to {IPEndPoint.MaxPort}.";
            return null;
        }

        string host = place.Substring(0, colon);
        bool isBracketed = host.Length > 1 && host[0] == '[' && host[host.Length - 1] == ']';
        string? canonical = HostText.Canonical(isBracketed ? host.Substring(1, host.Length - 2) : host);
        HostAddress? address = canonical is null ? null : new HostAddress(canonical, port, fingerprint);
        if (address?.ToString() != text)
        {
            error += address is null
                ? $": '{host}' is neither an IP address nor a name of lower-case letters, digits, hyphens and dots."
                : $": its one spelling is '{address}'.";
            return null;
        }

        error = null;
        return address;
    }
}
