using System;
using System.CommandLine;
using System.Globalization;
using System.Linq;
using System.Net;
using LagSim.Cli.Output;
using LagSim.Cli.Web;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim host</c>: hosts a session for others to join.</summary>
internal static class HostCommand
{
    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        SessionArguments shared = new();
        WebOptions web = new();
        Option<string> scene = new("--scene") { Description = HostedScene.Text, HelpName = "SCENE", Required = true };
        Option<int> port = CommonOptions.Whole("--port", "The UDP port; 0 picks a free one", 0, 0, 65535);
        Option<string> address = new("--address")
        {
            Description = "The address of this machine to listen on; 0.0.0.0 or :: for all of them, so that other machines can join.",
            DefaultValueFactory = _ => IPAddress.Loopback.ToString(),
            HelpName = "ADDRESS",
        };
        Option<int> clients = CommonOptions.Whole(
            "--joiners", "Start once this many clients have joined; more may join at any time", 0, 0, SessionOptions.MaxClients);
        clients.Aliases.Add("--clients");
        Option<double> history = CommonOptions.Number(
            "--history-s", "How late an event may arrive in any case and still count when it was done", 1, 0.05, 5);
        Option<double?> longest = CommonOptions.NumberOr(
            "by default three times --history-s, 5 at the most", "--longest-history-s",
            "How late those of a player may arrive whose link holds them back; from --history-s on", 0.05, 5);
        Option<double?> rate = CommonOptions.NumberOr(
            "by default what the events need and the link carries", "--max-bytes-per-s",
            "How many bytes a second each client is sent in the mean", 4_000, 100_000_000);
        Option<bool> early = new("--confirm-early")
        {
            Description = "Make what has happened final as soon as the players' links allow, rather than after --history-s;"
                + " costs some 3 KB/s on each link.",
        };
        Option<int> perAddress = CommonOptions.Whole(
            "--per-address", "How many clients may join from one address, numbers that are kept counted; 0 means half of the places, or --joiners if that is more",
            0, 0, SessionOptions.MaxClients);
        Option<double> budget = CommonOptions.Number(
            "--budget",
            "What each player's actions may cost before it is disconnected, as a multiple of the default, a tenth of a core; 0: no limit",
            1, 0, 1000);
        Option<string?> identity = CommonOptions.File(
            "--identity", "Keep the host's identity in this file, so that its fingerprint stays the same; it is created if it is missing;"
                + " lagsim key changes its key. Keep it secret: with it anyone can pose as this host. By default the host has a new identity each time.");
        Option<string?> tokens = new("--tokens")
        {
            Description = "Let in only who has a connect token of the issuer with this public key, the 64 digits that lagsim token prints.",
            HelpName = "KEY",
        };
        Option<bool> unprotected = ProtectionOptions.Unprotected();
        Option<bool> admin = new("--admin")
        {
            Description = $"Read commands from standard input while the session runs, one a line: {HostAdmin.Syntax}."
                + " 'ban' shuts out for as long as the session lasts: with --tokens that player alone, otherwise everyone at its address.",
        };
        Command command = new("host", "Opens a session that others join over UDP, and takes part in it. Ctrl-C ends it for everyone.")
        {
            scene, port, address, clients, history, longest, rate, early, perAddress, budget, identity, tokens, unprotected, admin,
        };
        shared.AddTo(command);
        web.AddTo(command);
        common.AddSeedAndJsonTo(command, isSeedDrawnFrom: false);
        command.SetAction(parsed =>
        {
            IPAddress local = EndPointText.ParseLocal("--address", parsed.GetValue(address)!);
            Scene loaded = HostedScene.Load(parsed.GetValue(scene)!, parsed.GetValue(common.Seed));
            SessionRequest request = shared.Read(parsed, console.Input);
            foreach (ScriptedAction action in request.Actions)
            {
                action.ActionIn(loaded, self: 0);
            }

            WebRequest? browsers = web.Read(parsed);
            if (browsers is not null && parsed.GetValue(tokens) is not null)
            {
                throw new UsageException("--web contradicts --tokens: the page has no token to show. Use a --key instead.");
            }

            using HostIdentity? self = Identity(parsed.GetValue(unprotected), parsed.GetValue(identity), parsed.GetValue(tokens));
            HostOptions options = HostOptions.From(request.Options) with
            {
                Protection = self is null ? null : new SecureHost(self, Key(parsed.GetValue(tokens))),
                PlayerBudget = HarmCommand.Budget(parsed.GetValue(budget)),
                ConfirmsEarly = parsed.GetValue(early),
                ExpectedClients = parsed.GetResult(clients)?.Implicit != false ? HostedScene.ExpectedClients(loaded) : parsed.GetValue(clients),
                Window = request.Options.Window.WithHistory(SimDuration.FromSeconds(parsed.GetValue(history))),
                MaxBytesPerSecond = (int?)parsed.GetValue(rate),
            };
            if (parsed.GetValue(longest) is double seconds)
            {
                options = seconds >= parsed.GetValue(history) ? options with { LongestHistory = SimDuration.FromSeconds(seconds) }
                    : throw new UsageException(string.Create(
                        CultureInfo.InvariantCulture, $"--longest-history-s is '{seconds}'; it must be at least --history-s, {parsed.GetValue(history)}."));
            }

            if (parsed.GetValue(perAddress) is int most and > 0)
            {
                options = options with { MaxClientsPerAddress = most };
            }

            request = request with { Options = options };
            using UdpPort udp = new(new IPEndPoint(local, parsed.GetValue(port)));
            using WebSocketHostPort? sockets = browsers is null ? null : new WebSocketHostPort();
            CarrierInUse carrier = sockets is null ? CarrierInUse.Of(udp) : CarrierInUse.Of(udp, sockets);
            HostSession session = Open(loaded, carrier.Port, options);
            using HostPage? page = browsers is null ? null
                : OpenPage(new SessionDoor(sockets!, loaded, self?.Fingerprint, options), browsers, local, console);
            bool json = parsed.GetValue(common.Json);
            int udpPort = udp.LocalAddress.ToEndPoint().Port;
            SessionPrinter printer = new(console, json, "host", parsed.GetValue(common.Seed), request.Seconds, request.RecordFile)
            {
                ListeningOn = EndPointText.Write(new IPEndPoint(local, udpPort)),
                Page = page?.Address,
                Addresses = self is null ? [] : [.. ReachableAddresses.Of(local)
                    .Select(reachable => new HostAddress(EndPointText.Write(reachable), udpPort, self.Fingerprint).ToString())],
            };
            printer.Line($"listening on {printer.ListeningOn}");
            foreach (string reachable in printer.Addresses)
            {
                printer.Line(reachable);
            }

            foreach (FormerHostKey former in self?.FormerKeys.Where(key => key.Until > DateTimeOffset.UtcNow) ?? [])
            {
                printer.Line($"also known as {KeyCommand.Text(former)}");
            }

            if (page is not null)
            {
                TellPage(page, printer, json);
            }

            if (self is null)
            {
                ProtectionOptions.Warn(console);
            }

            using SessionRunner runner = new(session, carrier, request, printer, console.Stop);
            if (parsed.GetValue(admin))
            {
                HostAdmin commands = new();
                HostAdmin.Read(console.Input, line => runner.Have(peer => commands.Do(line, (HostSession)peer)));
            }

            return runner.Run();
        });
        return command;
    }

    private static HostPage OpenPage(SessionDoor door, WebRequest browsers, IPAddress local, ToolConsole console) => HostPage.Start(
        door, new IPEndPoint(local, browsers.Port), ReachableAddresses.Of(local), browsers.Origins, browsers.Certificate, console.Error, console.Stop);

    private static void TellPage(HostPage page, SessionPrinter printer, bool json)
    {
        printer.Line($"browsers join at {page.Address}");
        foreach (string row in json ? [] : page.Picture())
        {
            printer.Line(row);
        }
    }

    /// <exception cref="UsageException">The options contradict each other.</exception>
    private static HostIdentity? Identity(bool isUnprotected, string? file, string? tokens) =>
        isUnprotected && tokens is not null ? throw new UsageException("--unprotected contradicts --tokens; leave out one of them.") :
        isUnprotected && file is not null ? throw new UsageException("--unprotected contradicts --identity; leave out one of them.")
        : isUnprotected ? null
        : file is null ? HostIdentity.Draw()
        : SecretFile.ReadOrDraw(
            "--identity",
            file,
            "a host's identity",
            text => HostIdentity.TryParse(text, out HostIdentity? kept) ? kept : null,
            () =>
            {
                HostIdentity drawn = HostIdentity.Draw();
                return (drawn, drawn.ToSecretText());
            });

    /// <exception cref="UsageException">The text is no key.</exception>
    private static TokenKey? Key(string? text) =>
        text is null ? null
        : TokenKey.TryParse(text, out TokenKey? key) ? key
        : throw new UsageException($"--tokens is '{text}'; it must be the public key of an issuer, 64 hexadecimal digits in lower case.");

    private static HostSession Open(Scene scene, IDatagramPort carrier, HostOptions options)
    {
        try
        {
            return new HostSession(scene, carrier, new StopwatchClock(), options, Session.DrawNumber());
        }
        catch (Exception failure) when (failure is ArgumentException or SceneException)
        {
            throw new InputException(Sentence.Of(failure), failure);
        }
    }
}
