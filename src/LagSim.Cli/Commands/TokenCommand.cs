using System;
using System.CommandLine;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim token</c>: issues a connect token, as a game's backend does.</summary>
internal static class TokenCommand
{
    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Option<string> secret = new("--secret")
        {
            Description = "The file of the issuer's secret key, created if it is missing. With it anyone can admit players.",
            HelpName = "FILE",
            Required = true,
        };
        Option<string?> host = new("--host")
        {
            Description = "The host that the token is for, as it prints itself: lagsim://HOST:PORT#FINGERPRINT."
                + " Without it no token is issued.",
            HelpName = "ADDRESS",
        };
        Option<string?> player = new("--player")
        {
            Description = "The player's identity, 1 to 64 bytes of UTF-8. One player has one place.",
            HelpName = "ID",
        };
        Option<string> name = new("--name")
        {
            Description = "The player's name, up to 64 bytes of UTF-8.",
            DefaultValueFactory = _ => "",
            HelpName = "TEXT",
        };
        Option<int> number = CommonOptions.Whole(
            "--number", "The player's number; 0 for any that is free", 0, 0, SessionOptions.MaxClients);
        Option<PlayerRights> rights = new("--rights")
        {
            Description = "What the player may do: all, act, spawn or none.",
            DefaultValueFactory = _ => PlayerRights.All,
            HelpName = "RIGHTS",
            CustomParser = result => result.Tokens[0].Value switch
            {
                "all" => PlayerRights.All,
                "act" => PlayerRights.Act,
                "spawn" => PlayerRights.Spawn,
                "none" => PlayerRights.None,
                string other => Refuse(result, $"--rights is '{other}'; it must be all, act, spawn or none."),
            },
        };
        Option<double> valid = CommonOptions.Number(
            "--valid-s", "How long the player may take to join",
            TokenIssuer.DefaultValidity.TotalSeconds, 1, TokenIssuer.MaxValidity.TotalSeconds);
        Command command = new(
            "token", "Prints the public key of an issuer of connect tokens, for host --tokens, and a token, for join --token.")
        {
            secret, host, player, name, number, rights, valid, common.Json,
        };
        command.SetAction(parsed =>
        {
            Option? alone = parsed.GetValue(host) is not null ? null
                : new Option[] { player, name, number, rights, valid }.FirstOrDefault(option => parsed.GetResult(option) is { Implicit: false });
            if (alone is not null)
            {
                throw new UsageException($"{alone.Name} needs --host, which says for which host a token is; without it none is issued.");
            }

            using TokenIssuer issuer = ReadOrDraw(parsed.GetValue(secret)!);
            string? token = null;
            if (parsed.GetValue(host) is string address)
            {
                token = Convert.ToBase64String(Issue(
                    issuer,
                    address,
                    () => new PlayerAdmission(
                        parsed.GetValue(player) ?? throw new UsageException("--player is missing: say for whom the token is."),
                        parsed.GetValue(name)!,
                        parsed.GetValue(rights),
                        (byte)parsed.GetValue(number)),
                    TimeSpan.FromSeconds(parsed.GetValue(valid))));
            }

            if (parsed.GetValue(common.Json))
            {
                JsonDocumentWriter.Write(console.Output, "token", null, null, null, null, document =>
                {
                    document.WriteString("key", issuer.Key.ToString());
                    document.WriteString("token", token);
                });
            }
            else
            {
                console.Output.WriteLine($"key {issuer.Key}");
                console.Output.WriteLine(token is null ? "no token: --host says for which host one is issued" : $"token {token}");
            }

            return ExitCode.Done;
        });
        return command;
    }

    private static byte[] Issue(TokenIssuer issuer, string address, Func<PlayerAdmission> admission, TimeSpan validity)
    {
        if (ProtectionOptions.ReadFingerprint(address, out _) is not HostFingerprint fingerprint)
        {
            throw new UsageException($"--host is '{address}', which has no fingerprint; it must be lagsim://HOST:PORT#FINGERPRINT.");
        }

        try
        {
            return issuer.Issue(admission(), fingerprint, validity);
        }
        catch (ArgumentException wrong)
        {
            throw new UsageException(Sentence.Of(wrong));
        }
    }

    private static PlayerRights Refuse(System.CommandLine.Parsing.ArgumentResult result, string why)
    {
        result.AddError(why);
        return PlayerRights.None;
    }

    private static TokenIssuer ReadOrDraw(string file) => SecretFile.ReadOrDraw(
        "--secret",
        file,
        "an issuer's secret",
        text => TokenIssuer.TryParse(text, out TokenIssuer? kept) ? kept : null,
        () =>
        {
            TokenIssuer drawn = TokenIssuer.Draw();
            return (drawn, drawn.ToSecretText());
        });
}
