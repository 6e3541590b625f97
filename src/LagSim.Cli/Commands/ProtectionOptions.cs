using System.CommandLine;
using LagSim.Cli.Output;
using LagSim.Net.Protection;

namespace LagSim.Cli.Commands;

/// <summary>How the tool protects sessions over real sockets: it does, unless it is told not to.</summary>
internal static class ProtectionOptions
{
    /// <summary>The option that turns protection off.</summary>
    internal static Option<bool> Unprotected() => new("--unprotected")
    {
        Description = "Encrypt and authenticate nothing. Anyone on the path can then read, change and forge what is sent. Both ends must"
            + " say so.",
    };

    /// <summary>The same for experiments that have both ends in this process.</summary>
    internal static Option<bool> UnprotectedExperiment() => new("--unprotected")
    {
        Description = "In real time: encrypt and authenticate nothing, to compare what protection costs. In virtual time nothing ever is.",
    };

    /// <summary>Says loudly that a session is not protected.</summary>
    internal static void Warn(ToolConsole console) => console.Error.WriteLine(
        "NOT PROTECTED: anyone on the path can read this session, act in any player's name, and be its host. Leave out --unprotected to"
            + " change that.");

    /// <summary>Reads the fingerprint of an address, if it has one.</summary>
    /// <param name="text">What the user wrote: <c>lagsim://HOST:PORT#FINGERPRINT</c>, or <c>HOST:PORT</c>.</param>
    /// <param name="place">Receives <c>HOST:PORT</c>.</param>
    /// <returns>The fingerprint; null if there is none.</returns>
    /// <exception cref="UsageException">The text begins like an address with a fingerprint, and is none, or it is that of a page.</exception>
    internal static HostFingerprint? ReadFingerprint(string text, out string place)
    {
        text = text.Trim(); // as it was pasted
        WebSocketText.ThrowIfOfPage(text);
        if (WebSocketText.Is(text))
        {
            return WebSocketText.ReadFingerprint(text, out place);
        }

        if (!text.Contains("://", System.StringComparison.Ordinal) && !text.Contains('#', System.StringComparison.Ordinal))
        {
            place = text;
            return null;
        }

        try
        {
            HostAddress address = HostAddress.Parse(text);
            place = text["lagsim://".Length..text.IndexOf('#', System.StringComparison.Ordinal)];
            return address.Fingerprint;
        }
        catch (System.FormatException wrong)
        {
            throw new UsageException(wrong.Message);
        }
    }
}
