namespace LagSim.Events;

/// <summary>As what a peer takes part in a session. The numbers travel; never renumber.</summary>
public enum PeerRole : byte
{
    /// <summary>A person who plays.</summary>
    Player = 1,

    /// <summary>A peer that watches: it has the whole world and takes no player's place. What it does is refused.</summary>
    Spectator = 2,

    /// <summary>A program that plays, in a player's place.</summary>
    Bot = 3,
}
