namespace LagSim.Play;

/// <summary>Whether a player of a game is there.</summary>
internal enum PlayerPresence
{
    /// <summary>It is heard.</summary>
    Here,

    /// <summary>It has been silent for half the host's timeout: its tab hangs, say, or its phone sleeps.</summary>
    Silent,

    /// <summary>It has left or was lost. The host may keep its place, for it to come back.</summary>
    Away,

    /// <summary>This peer has never been told of it: the place waits for its first player, or its player had left before this peer
    /// came.</summary>
    NotYet,
}
