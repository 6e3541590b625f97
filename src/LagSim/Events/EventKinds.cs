namespace LagSim.Events;

/// <summary>Which kinds of events are whose.</summary>
internal static class EventKinds
{
    /// <summary>How many numbers from <see cref="EventKind.Spawn"/> on the kinds of players' events take.</summary>
    internal const int OfPlayersCount = EventKind.Command - EventKind.Spawn + 1;

    /// <summary>Whether it comes from outside: what a player does, or what the host says of one.</summary>
    internal static bool IsExternal(EventKind kind) => IsOfPlayers(kind) || kind == EventKind.Player;

    /// <summary>Whether it is done to no body, and only rules hear of it.</summary>
    internal static bool IsForRules(EventKind kind) => kind is EventKind.Command or EventKind.Player;

    /// <summary>Whether it is what a player does.</summary>
    internal static bool IsOfPlayers(EventKind kind) => kind is (>= EventKind.Spawn and <= EventKind.Remove) or EventKind.SetFilter or EventKind.Command;
}
