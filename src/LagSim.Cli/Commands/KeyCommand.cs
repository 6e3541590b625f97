using System;
using System.CommandLine;
using System.Globalization;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Net.Protection;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim key</c>: prints by which keys a host is known, and changes its key.</summary>
internal static class KeyCommand
{
    private const double UsualDays = 30;

    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Option<string> file = new("--identity")
        {
            Description = "The file of the host's identity, as for host --identity.",
            HelpName = "FILE",
            Required = true,
        };
        Option<bool> change = new("--change")
        {
            Description = "Draw a new key, and keep the former one in the file for --keep-days: clients that know the host by it join all the same, and are"
                + " told the new fingerprint. Restart the host afterwards.",
        };
        Option<double> days = CommonOptions.Number(
            "--keep-days", "With --change: for how many days the host still answers to the former key; 0: not at all", UsualDays, 0, HostIdentity.MaxKept.TotalDays);
        Option<bool> forget = new("--forget-former")
        {
            Description = "Forget the former keys now, for instance since they were stolen: clients that know only those do not join any more.",
        };
        Command command = new("key", "Prints the fingerprints by which clients know a host, and changes its key.")
        {
            file, change, days, forget, common.Json,
        };
        command.SetAction(parsed =>
        {
            bool isChange = parsed.GetValue(change), isForgotten = parsed.GetValue(forget);
            if (isChange && isForgotten)
            {
                throw new UsageException("--change contradicts --forget-former; --change --keep-days 0 keeps no former key.");
            }

            if (!isChange && parsed.GetResult(days)?.Implicit == false)
            {
                throw new UsageException("--keep-days needs --change.");
            }

            string name = parsed.GetValue(file)!;
            using HostIdentity kept = Read(name);
            using HostIdentity now = isChange ? Changed(kept, TimeSpan.FromDays(parsed.GetValue(days))) : isForgotten ? kept.ForgetFormerKeys() : kept;
            if (now != kept)
            {
                SecretFile.ThrowIfNotWritable("--identity", name, "a host's identity");
                SecretFile.Tell("--identity", name, () => SecretFile.Write(name, now.ToSecretText()), "The host's key is what it was.");
            }

            Print(console, now, parsed.GetValue(common.Json));
            return ExitCode.Done;
        });
        return command;
    }

    /// <summary>A former key and its end, in words.</summary>
    internal static string Text(FormerHostKey key) => $"{key.Fingerprint} until {Until(key)}";

    private static string Until(FormerHostKey key) => key.Until.UtcDateTime.ToString("yyyy-MM-dd'T'HH:mm:ss'Z'", CultureInfo.InvariantCulture);

    private static HostIdentity Read(string file) =>
        SecretFile.Read(file) is not string text ? throw new InputException($"--identity is '{file}'; there is no such file.")
        : HostIdentity.TryParse(text, out HostIdentity? identity) ? identity!
        : throw new InputException($"--identity is '{file}', which does not hold a host's identity: 64 hexadecimal digits in lower case.");

    private static HostIdentity Changed(HostIdentity kept, TimeSpan keep)
    {
        try
        {
            return kept.ChangeKey(keep);
        }
        catch (InvalidOperationException full)
        {
            throw new InputException($"{full.Message} Use --forget-former first, or --keep-days 0.", full);
        }
    }

    private static void Print(ToolConsole console, HostIdentity identity, bool isJson)
    {
        FormerHostKey[] served = [.. identity.FormerKeys.Where(key => key.Until > DateTimeOffset.UtcNow)];
        if (!isJson)
        {
            console.Output.WriteLine($"fingerprint {identity.Fingerprint}");
            foreach (FormerHostKey key in served)
            {
                console.Output.WriteLine($"former {Text(key)}");
            }

            return;
        }

        JsonDocumentWriter.Write(console.Output, "key", null, null, null, null, document =>
        {
            document.WriteString("fingerprint", identity.Fingerprint.ToString());
            document.WriteStartArray("former");
            foreach (FormerHostKey key in served)
            {
                document.WriteStartObject();
                document.WriteString("fingerprint", key.Fingerprint.ToString());
                document.WriteString("until", Until(key));
                document.WriteEndObject();
            }

            document.WriteEndArray();
        });
    }
}
