using System;
using LagSim.Cli.Output;
using LagSim.Cli.Web;
using LagSim.Net.Protection;

namespace LagSim.Cli.Commands;

/// <summary>The address of a host's WebSocket as a user writes it: <c>ws://ADDRESS:PORT</c> or <c>wss://NAME</c>, with the fingerprint after
/// <c>#</c> if it is known.</summary>
internal static class WebSocketText
{
    /// <summary>Whether a text is meant as one.</summary>
    internal static bool Is(string text) =>
        text.StartsWith("ws://", StringComparison.Ordinal) || text.StartsWith("wss://", StringComparison.Ordinal);

    /// <summary>Refuses the address of a host's page, which browsers open.</summary>
    /// <exception cref="UsageException">The text is one.</exception>
    internal static void ThrowIfOfPage(string text)
    {
        if (text.StartsWith("http://", StringComparison.Ordinal) || text.StartsWith("https://", StringComparison.Ordinal))
        {
            throw new UsageException($"'{text}' is the address of a page, for browsers; a native peer joins it as ws{text[4..]}.");
        }
    }

    /// <summary>Reads the address, without a fingerprint. Without a path it is that of the tool's own hosts.</summary>
    /// <exception cref="UsageException">The text is none.</exception>
    internal static Uri Parse(string text)
    {
        if (!Uri.TryCreate(text, UriKind.Absolute, out Uri? address) || address.Host.Length == 0)
        {
            throw new UsageException($"'{text}' does not say where the host is: write ws://ADDRESS:PORT, as ws://192.168.0.7:8080.");
        }

        return address.PathAndQuery == "/" ? new Uri(address, SessionDoor.Path) : address;
    }

    /// <summary>Takes the fingerprint off an address.</summary>
    /// <exception cref="UsageException">After <c>#</c> comes something else.</exception>
    internal static HostFingerprint? ReadFingerprint(string text, out string place)
    {
        int hash = text.IndexOf('#', StringComparison.Ordinal);
        place = hash < 0 ? text : text[..hash];
        Parse(place);
        return hash < 0 ? null
            : HostFingerprint.TryParse(text[(hash + 1)..], out HostFingerprint fingerprint) && fingerprint != default ? fingerprint
            : throw new UsageException(
                $"'{text}' has no fingerprint after '#': there come the {HostFingerprint.TextLength} hexadecimal digits, in lower case, that the host prints.");
    }
}
