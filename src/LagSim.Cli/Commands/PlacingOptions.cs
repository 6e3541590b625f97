using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Cli.Commands;

/// <summary>What <c>--do</c> says of a place besides where it is: <c>/skip</c>, <c>/beside</c>, <c>/players=0+2</c>.</summary>
internal readonly struct PlacingOptions
{
    private const string OfPlayers = "players=";
    private const int Self = -1;

    private readonly int[]? players;

    private PlacingOptions(WhenOccupied whenOccupied, int[]? players)
    {
        WhenOccupied = whenOccupied;
        this.players = players;
    }

    /// <summary>What becomes of it if another body or static geometry is there.</summary>
    internal WhenOccupied WhenOccupied { get; }

    /// <summary>Whose a spawned body is; everyone's if nothing is said.</summary>
    /// <param name="self">The number of the peer that spawns it.</param>
    internal PeerSet PlayersOf(byte self) => players is null ? PeerSet.Everyone : PeerSet.Of([.. players.Select(one => one == Self ? self : one)]);

    /// <summary>Parses the options of a kind of action.</summary>
    /// <param name="options">Each without its slash.</param>
    /// <param name="kind">The kind of action, as <c>--do</c> writes it.</param>
    /// <param name="wrong">The exception for what is wrong.</param>
    /// <exception cref="UsageException">One is none, or not for that kind.</exception>
    internal static PlacingOptions Parse(IEnumerable<string> options, string kind, Func<string, UsageException> wrong)
    {
        PlacingOptions read = default;
        foreach (string option in options)
        {
            bool isOfPlayers = option.StartsWith(OfPlayers, StringComparison.Ordinal);
            if (!isOfPlayers && option is not ("skip" or "beside"))
            {
                throw wrong($"'/{option}' must be one of /skip, /beside, /players=NUMBERS");
            }

            if (kind != "spawn" && (kind != "teleport" || isOfPlayers))
            {
                throw wrong($"'/{option}' is not for {kind}, but for {(isOfPlayers ? "spawn" : "spawn and teleport")}");
            }

            if (isOfPlayers ? read.players is not null : read.WhenOccupied != WhenOccupied.Overlap)
            {
                throw wrong($"'/{option}' comes after another of its kind; one is allowed");
            }

            read = isOfPlayers ? new(read.WhenOccupied, Players(option[OfPlayers.Length..], wrong))
                : new(option == "skip" ? WhenOccupied.Skip : WhenOccupied.Beside, read.players);
        }

        return read;
    }

    private static int[] Players(string text, Func<string, UsageException> wrong) => [.. text.Split('+').Select(one =>
        one == "me" ? Self
        : byte.TryParse(one, NumberStyles.None, CultureInfo.InvariantCulture, out byte number) && number <= PeerSet.MaxPeer ? number
        : throw wrong($"'{one}' in /players={text} must be me, or a player's number from 0 to {PeerSet.MaxPeer}"))];
}
