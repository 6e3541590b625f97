// Air hockey for two to four players, from the LagSim packages alone: a game whose rules are part of the world.
//   dotnet run -c Release --project samples/AirHockey -- --bots            bots play over every link, all with one history
//   dotnet run -c Release --project samples/AirHockey -- --bots --broken   rules that keep a field: seen, exit code 1
//   dotnet run -c Release --project samples/AirHockey -- --watch awful 4   four bots over a link, as the last of them sees it
//   dotnet run -c Release --project samples/AirHockey -- host 5000 2       a host, and how many play
//   dotnet run -c Release --project samples/AirHockey -- join 127.0.0.1:5000
using System;
using System.Globalization;
using System.IO;
using System.Net;
using AirHockey;
using LagSim.Testing.Links;

const string Usage = "--bots [--broken], --watch [LINK [PLAYERS]], host [PORT [PLAYERS]], or join ADDRESS:PORT";
Console.OutputEncoding = System.Text.Encoding.UTF8;
switch (args)
{
    case ["--bots"]:
        return BotTable.Print(() => new AirHockeyRules());
    case ["--bots", "--broken"]:
        return BotTable.Print(() => new BrokenRules());
    case ["--watch", .. { Length: <= 2 } how]:
        if (!LinkProfiles.TryGet(how is [string name, ..] ? name : "4g", out LinkProfile? link, out string? unknown))
        {
            return Refuse(unknown);
        }

        return TryReadPlayers(how, out int players) ? Watch.Play(link, players) : RefusePlayers(how[1]);
    case ["host", .. { Length: <= 2 } how]:
        if (!TryReadNumber(how is [string port, ..] ? port : "0", 0, IPEndPoint.MaxPort, out int number))
        {
            return Refuse($"The port '{how[0]}' must be a number from 0 (any that is free) to {IPEndPoint.MaxPort}.");
        }

        return TryReadPlayers(how, out int seats) ? Try(() => LiveGame.Host(number, seats)) : RefusePlayers(how[1]);
    case ["join", string address]:
        return IPEndPoint.TryParse(address, out IPEndPoint? host) && host.Port > 0
            ? Try(() => LiveGame.Join(host))
            : Refuse($"The host '{address}' must be an address and a port, such as 127.0.0.1:5000.");
    default:
        return Refuse(args is [] ? $"Say what to do: {Usage}." : $"'{string.Join(' ', args)}' must be {Usage}.");
}

static bool TryReadPlayers(string[] how, out int players) =>
    TryReadNumber(how is [_, string many] ? many : "2", Table.MinPlayers, Table.MaxPlayers, out players);

static bool TryReadNumber(string text, int least, int most, out int number) =>
    int.TryParse(text, NumberStyles.None, CultureInfo.InvariantCulture, out number) && number >= least && number <= most;

static int RefusePlayers(string text) => Refuse($"The number of players '{text}' must be {Table.MinPlayers} to {Table.MaxPlayers}.");

static int Refuse(string sentence)
{
    Console.Error.WriteLine(sentence);
    return 2;
}

static int Try(Func<int> play)
{
    try
    {
        return play();
    }
    catch (Exception failed) when (failed is IOException or ArgumentException)
    {
        Console.Error.WriteLine(failed.Message);
        return 3;
    }
}
