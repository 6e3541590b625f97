using System;
using System.CommandLine;
using System.IO;
using LagSim.Cli.Output;
using LagSim.Net.Protection;

namespace LagSim.Cli.Commands;

/// <summary>Which host <c>lagsim join</c> trusts: that of the fingerprint it was given, the one that answered there before, or whichever answers.</summary>
internal sealed class HostTrust
{
    private readonly Option<bool> unprotected = ProtectionOptions.Unprotected();
    private readonly Option<string?> file = CommonOptions.File(
        "--known-hosts", "Remember in this file which host answered at an address that has no fingerprint, and refuse another one there. By default"
            + $" that is {KnownHosts.UsualFile ?? "no file"}, and hosts on this machine are not remembered.");

    private readonly Option<bool> anew = new("--trust-new")
    {
        Description = "Trust the host that answers even if another answered at this address before, and remember it instead.",
    };

    private string place = "";
    private KnownHosts? hosts;
    private int line;

    /// <summary>The protection of the session; null for none.</summary>
    internal SecureClient? Protection { get; private set; }

    /// <summary>The fingerprint of the host that is joined and no other; null to trust the first that answers.</summary>
    internal HostFingerprint? Wanted { get; private set; }

    internal void AddTo(Command command)
    {
        command.Options.Add(unprotected);
        command.Options.Add(file);
        command.Options.Add(anew);
    }

    /// <summary>Reads the options, and the file.</summary>
    /// <param name="parsed">The command line.</param>
    /// <param name="fingerprint">The fingerprint of the address; null if it has none.</param>
    /// <param name="address">The address without it, as the user wrote it.</param>
    /// <param name="isThisMachine">Whether that is this machine itself.</param>
    /// <exception cref="UsageException">The options contradict each other.</exception>
    /// <exception cref="InputException">A line of the file is none.</exception>
    /// <exception cref="IOException">The file cannot be read.</exception>
    internal void Read(ParseResult parsed, HostFingerprint? fingerprint, string address, bool isThisMachine)
    {
        string? named = parsed.GetValue(file);
        bool isAnew = parsed.GetValue(anew);
        string? memory = isAnew ? "--trust-new" : named is not null ? "--known-hosts" : null;
        if (parsed.GetValue(unprotected))
        {
            throwIf(fingerprint is not null, "--unprotected contradicts an address with a fingerprint; write ADDRESS:PORT alone.");
            throwIf(memory is not null, $"--unprotected contradicts {memory}: without protection no host proves who it is.");
            return;
        }

        throwIf(fingerprint is not null && memory is not null, $"{memory} contradicts an address with a fingerprint, which says whom to trust.");
        place = WebSocketText.Is(address) ? address.ToLowerInvariant().TrimEnd('/') : EndPointText.Spelling(address); // however it is spelled
        Wanted = fingerprint;
        hosts = fingerprint is null && (named ?? (isThisMachine ? null : KnownHosts.UsualFile)) is string used ? new KnownHosts(used) : null;
        if (!isAnew && hosts?.Find(place) is (HostFingerprint known, int at))
        {
            (Wanted, line) = (known, at);
        }

        Protection = Wanted is HostFingerprint wanted ? new SecureClient(wanted) : SecureClient.TrustOnFirstUse();

        static void throwIf(bool isSo, string why)
        {
            if (isSo)
            {
                throw new UsageException(why);
            }
        }
    }

    /// <summary>Remembers the host that has proved itself, and returns what to tell of it.</summary>
    /// <param name="whole">The address with the fingerprint, to join from then on.</param>
    internal string Remember(string whole)
    {
        string told = $"Trusting the host that answered first. If it is the right one, join it as {whole} from now on.";
        return Keep(told, $"It is remembered in '{hosts?.File}'; another one at {place} will be refused.");
    }

    /// <summary>Remembers the new key of a host that has changed it, and returns what to tell of it.</summary>
    /// <param name="whole">The address with the new fingerprint, to join from then on.</param>
    internal string Follow(string whole) => Keep(
        $"The host has changed its key, and its former one vouches for the new. Join it as {whole} from now on.",
        $"It is remembered in '{hosts?.File}' in place of the former.");

    /// <summary>Remembers the host, if hosts are remembered.</summary>
    private string Keep(string told, string kept)
    {
        if (hosts is null)
        {
            return told;
        }

        try
        {
            hosts.Remember(place, Protection!.Host!.Value);
            return $"{told} {kept}";
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException or InputException)
        {
            return $"{told} It is not remembered: {failure.Message}";
        }
    }

    /// <summary>Why the host that is remembered was not joined, and what to do; null if that is not the reason.</summary>
    internal string? WhyRefused() => line == 0 || Protection?.Other is not HostFingerprint other ? null
        : $"Line {line} of '{hosts!.File}' says that the host at {place} has the fingerprint {Wanted}; the one that answers shows {other}. It is another host,"
            + " or one that was started without its --identity, or somebody in between. If you know that it is the right one, delete that line, or join it once with --trust-new.";
}
