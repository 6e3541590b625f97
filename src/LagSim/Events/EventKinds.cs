namespace LagSim.Events;

/// <summary>Which kinds of events are whose.</summary>
internal static class EventKinds
{
    /// <summary>How many numbers from <see cref="EventKind.Spawn"/> on the kinds of players' events take.</summary>
    internal const int OfPlayersCount = EventKind.Command - EventKind.Spawn + 1;

    /// <summary>Whether it is what a player does, and so comes from outside.</summary>
    internal static bool IsOfPlayers(EventKind kind) => kind is (>= EventKind.Spawn and <= EventKind.Remove) or EventKind.SetFilter or EventKind.Command;
}
