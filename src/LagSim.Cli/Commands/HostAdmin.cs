using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Net;
using System.Threading;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;

namespace LagSim.Cli.Commands;

/// <summary>The commands of <c>lagsim host --admin</c>: list and disconnect players, ban them or their addresses, remove bodies.</summary>
internal sealed class HostAdmin
{
    internal const string Syntax = "players, kick PLAYER, ban PLAYER, unban ADDRESS, remove-bodies PLAYER";

    private const int MaxNumber = SessionOptions.MaxClients + SessionOptions.MaxSpectators;

    private readonly Dictionary<string, PeerAddress> banned = []; // by the text of the command

    /// <summary>Reads lines to the end of the input, on a background thread.</summary>
    /// <param name="input">The source of the lines.</param>
    /// <param name="say">Called with each line. It must run <see cref="Do"/> on the session's thread and print the answer.</param>
    internal static void Read(TextReader input, Action<string> say)
    {
        new Thread(ReadAll) { IsBackground = true, Name = "LagSim admin" }.Start();

        void ReadAll()
        {
            while (input.ReadLine() is string line)
            {
                if (line.Trim().Length > 0)
                {
                    say(line.Trim());
                }
            }
        }
    }

    private static string Described(LinkTraffic link, IReadOnlyList<RosterMember> roster)
    {
        RosterMember? member = roster.FirstOrDefault(one => one.Number == link.Peer);
        string kind = member is null or { Role: PeerRole.Player } ? "player" : member.Role.ToString().ToLowerInvariant();
        return $"{kind} {link.Peer}{(member is { Name.Length: > 0 } ? $" {member.Name}" : "")} at {link.Address}";
    }

    /// <summary>Executes a line. For the session's thread.</summary>
    /// <returns>The result, as a sentence.</returns>
    internal string Do(string line, HostSession host)
    {
        string[] words = line.Split(' ', StringSplitOptions.RemoveEmptyEntries | StringSplitOptions.TrimEntries);
        if (words is ["players"])
        {
            return host.Links.Count == 0 ? "There is no player."
                : string.Join("; ", host.Links.Select(link => Described(link, host.Roster)));
        }

        if (words is ["unban", string address])
        {
            bool isKnown = banned.Remove(address, out PeerAddress machine);
            isKnown |= IPAddress.TryParse(address, out IPAddress? ip);
            machine = ip is null ? machine : PeerAddress.From(new IPEndPoint(ip, 0)); // also an address that is banned for a while
            return isKnown && host.Unban(machine) ? $"Players from {address} may come in again."
                : $"'{address}' is not banned; banned are: {(banned.Count == 0 ? "none" : string.Join(", ", banned.Keys.Order()))}.";
        }

        if (words is ["kick" or "ban" or "remove-bodies"])
        {
            return $"'{words[0]}' lacks the player's number; 'players' tells who is there.";
        }

        if (words is not ["kick" or "ban" or "remove-bodies", string number])
        {
            return $"'{line}' is no command; there are: {Syntax}.";
        }

        if (!byte.TryParse(number, NumberStyles.None, CultureInfo.InvariantCulture, out byte player) || player is 0 or > MaxNumber)
        {
            return $"'{number}' is no player's number; it must be 1 to {MaxNumber}.";
        }

        switch (words[0])
        {
            case "kick":
                return host.Kick(player) ? $"Player {player} is disconnected." : $"There is no player {player}.";
            case "ban":
                string? from = host.Links.Where(link => link.Peer == player).Select(link => link.Address.ToIPAddress().ToString()).FirstOrDefault();
                bool isProven = host.AdmissionOf(player) is not null;
                if (from is null || host.Ban(player) is not PeerAddress its)
                {
                    return $"There is no player {player}.";
                }

                banned[from] = its;
                return isProven ? $"Player {player} is disconnected, and its tokens let it in no more; 'unban {from}' lets it in again."
                    : $"Player {player} is disconnected, and nobody can join from {from} any more.";
            case "remove-bodies" when player > SessionOptions.MaxClients:
                return $"Player {player} is a spectator, and has no bodies.";
            default:
                try
                {
                    int bodies = host.RemoveBodiesOf(player);
                    return string.Create(CultureInfo.InvariantCulture, $"{bodies} bodies of player {player} are removed.");
                }
                catch (InvalidOperationException why)
                {
                    return why.Message;
                }
        }
    }
}
