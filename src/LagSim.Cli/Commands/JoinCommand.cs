using System;
using System.Collections.Generic;
using System.CommandLine;
using System.IO;
using System.Linq;
using System.Net;
using LagSim.Cli.Output;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Play;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim join</c>: joins a hosted session, at its start or later.</summary>
internal static class JoinCommand
{
    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        SessionArguments shared = new();
        Argument<string> host = new("ADDRESS")
        {
            Description = "The line that the host prints, lagsim://192.168.0.7:5000#FINGERPRINT. Without the fingerprint, as"
                + " 192.168.0.7:5000, [::1]:5000 or some.name:5000, the host that answers first is trusted, remembered, and its fingerprint printed."
                + " If a name has several addresses, they are tried a quarter of a second apart, and the first that answers is joined. ws://192.168.0.7:8080 joins over a WebSocket, where UDP does not get through.",
        };
        Option<string?> token = new("--token")
        {
            Description = "The connect token that the host needs, as lagsim token prints it; - reads it from standard input.",
            HelpName = "TOKEN",
        };
        HostTrust trust = new();
        Option<string?> pass = CommonOptions.File(
            "--pass", "Come back as the same player, after a restart too: the host keeps the number for a while (its --rejoin-s) when this client leaves, and the file holds the player's pass, and is created if it is missing. Keep it secret: it is all that is needed to take the player's place.");
        Command command = new(
            "join",
            "Joins a session; the scene comes from the host. Exits with 0 if this peer stays for --for-s or, without it, until the host ends the session; with 3"
                + " if the session ends earlier, if --for-s was over before this peer came in, if a --do was refused or not done, or if --pass could not be kept."
                + " The line below each T line gives the host's clock minus this one's, the most by which that may be wrong, and half a round trip.")
        {
            host, pass, token,
        };
        trust.AddTo(command);
        shared.AddTo(command);
        common.AddSeedAndJsonTo(command, isSeedDrawnFrom: false);
        command.SetAction(parsed =>
        {
            if (shared.ReadsInput(parsed) && parsed.GetValue(token) == "-")
            {
                throw new UsageException("--key and --token are both '-'; only one of them can come from standard input.");
            }

            SessionRequest request = shared.Read(parsed, console.Input);
            ClientOptions options = ClientOptions.From(request.Options) with { Rules = AirHockeyGame.AllRules() };
            string? passFile = parsed.GetValue(pass);
            if (passFile is not null)
            {
                ThrowIfSame(passFile, request.RecordFile);
                options = options with { Pass = PassFile.Read(passFile) };
                SecretFile.ThrowIfNotWritable("--pass", passFile, "a pass"); // report this before joining
            }

            HostFingerprint? fingerprint = ProtectionOptions.ReadFingerprint(parsed.GetValue(host)!, out string place);
            IReadOnlyList<IPEndPoint> there = WebSocketText.Is(place) ? [] : EndPointText.ResolveAll(place, "join", console.Stop);
            trust.Read(parsed, fingerprint, place, there.Count == 0 ? WebSocketText.Parse(place).IsLoopback : there.All(one => IPAddress.IsLoopback(one.Address)));
            SecureClient? protection = trust.Protection;
            options = options with { Protection = protection, Token = Token(parsed.GetValue(token), trust.Wanted, console.Input) };
            if (protection is null)
            {
                ProtectionOptions.Warn(console);
            }

            options = options with { OtherAddresses = [.. there.Skip(1).Select(PeerAddress.From)], HostName = there.Count == 0 ? place : null };
            request = request with { Options = options, Host = place };
            using UdpPort? udp = there.Count == 0 ? null
                : new UdpPort(UdpDestination.Facing(there[0].Address, [.. there.Skip(1).Select(other => other.Address)]));
            using WebSocketClientPort? socket = udp is null ? new WebSocketClientPort(WebSocketText.Parse(place)) : null;
            CarrierInUse carrier = udp is null ? CarrierInUse.Of(socket!) : CarrierInUse.Of(udp);
            PeerAddress address = udp is null ? WebSocketClientPort.Host : PeerAddress.From(there[0]);
            ClientSession session = new(null, carrier.Port, new StopwatchClock(), options, address, Session.DrawNumber());
            bool isPassKept = true;
            if (passFile is not null)
            {
                session.KeepsPlace = true; // a pass is kept to come back with
                PlayerPass former = options.Pass;
                session.PassGiven += given =>
                {
                    if (former.Number > 0 && given != former)
                    {
                        string kept = PassFile.KeepFormer(passFile) is string other ? $"; the former one is in '{other}'" : "";
                        console.Error.WriteLine($"The host does not know the pass of player {former.Number} in '{passFile}'; this is player {given.Number} of its session, whose pass is kept there now{kept}.");
                    }

                    isPassKept = Keep(console, passFile, given);
                    former = given;
                };
            }

            if (protection is not null && trust.Wanted is null)
            {
                session.PassGiven += TellTrustOnce;
            }

            session.HostKeyChanged += () => console.Error.WriteLine(trust.Follow(Whole()));
            SessionPrinter printer = new(console, parsed.GetValue(common.Json), "join", parsed.GetValue(common.Seed), request.Seconds, request.RecordFile)
            {
                Server = udp is null ? place : null,
            };
            using SessionRunner runner = new(session, carrier, request, printer, console.Stop);
            int code = runner.Run();
            if (code == ExitCode.Input && session.Peer == 0 && trust.WhyRefused() is string why)
            {
                console.Error.WriteLine(why);
            }

            if (session.RefusedFor == RefusalReason.WrongKey && options.ConnectKey.Length == 0)
            {
                console.Error.WriteLine("This host needs a key: --key TEXT, or --key-file FILE.");
            }

            return code == ExitCode.Done && !isPassKept ? ExitCode.Input : code;

            void TellTrustOnce(PlayerPass given)
            {
                session.PassGiven -= TellTrustOnce;
                console.Error.WriteLine(trust.Remember(Whole()));
            }

            string Whole() => udp is null ? $"{place}#{protection!.Host!.Value}"
                : new HostAddress(EndPointText.Write(Joined()), there[0].Port, protection!.Host!.Value).ToString();

            // A session's address has no zone; the one that it was made from has.
            IPAddress Joined() => there.FirstOrDefault(one => PeerAddress.From(one) == session.HostAddress)?.Address ?? session.HostAddress.ToIPAddress();
        });
        return command;
    }

    /// <exception cref="UsageException">It is no token, or there is no fingerprint with it.</exception>
    private static byte[] Token(string? text, HostFingerprint? fingerprint, TextReader input)
    {
        if (text is null)
        {
            return [];
        }

        if (fingerprint is null)
        {
            throw new UsageException("--token needs an address with a fingerprint: whoever answers first could take the token.");
        }

        text = text == "-" ? ReadToken(input) : text;
        byte[] token = new byte[text.Length];
        return Convert.TryFromBase64String(text, token, out int length) && length is > 0 and <= IHostProtection.MaxTokenBytes
            ? token[..length]
            : throw new UsageException(
                $"--token is not a connect token: it has {text.Length} characters, and must be 1 to {IHostProtection.MaxTokenBytes} bytes"
                    + " in base64.");
    }

    /// <summary>
    /// Reads a line with a token alone, or what <c>lagsim token</c> prints, where the token comes after that word. Reads no more than that,
    /// as the input may have no end.
    /// </summary>
    private static string ReadToken(TextReader input)
    {
        char[] read = new char[1_000]; // twice what that prints
        string[] lines = new string(read, 0, input.ReadBlock(read))
            .Split('\n', StringSplitOptions.TrimEntries | StringSplitOptions.RemoveEmptyEntries);
        const string word = "token ";
        return Array.Find(lines, line => line.StartsWith(word, StringComparison.Ordinal)) is string named ? named[word.Length..]
            : lines.Length > 0 ? lines[0]
            : "";
    }

    /// <summary>Refuses a recording that would overwrite the pass.</summary>
    private static void ThrowIfSame(string passFile, string? recordFile)
    {
        if (recordFile is not null && Path.GetFullPath(passFile) == Path.GetFullPath(recordFile))
        {
            throw new UsageException($"--pass and --record are both '{passFile}'; they must be different files.");
        }
    }

    /// <returns>Whether the file has it.</returns>
    private static bool Keep(ToolConsole console, string file, PlayerPass given)
    {
        try
        {
            SecretFile.Write(file, given.ToString());
            return true;
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException)
        {
            console.Error.WriteLine($"The player's pass was not kept: {failure.Message}"); // the session continues without it
            return false;
        }
    }
}
