namespace LagSim.Net.Sessions;

/// <summary>Where a peer stands in its session.</summary>
public enum SessionState
{
    /// <summary>A client asks to be let in.</summary>
    Joining,

    /// <summary>A client measures how far its clock is from the host's.</summary>
    Synchronising,

    /// <summary>The shared time is known; the start is not, or not all expected peers are there.</summary>
    Waiting,

    /// <summary>There is a world, simulated ahead of the shared time.</summary>
    Running,

    /// <summary>
    ///  A client that lost its host, or its world, asks to be let in again. What it knew stays readable and stands still, and nothing can
    /// be done.
    /// </summary>
    Rejoining,

    /// <summary>It is over; the world stays readable.</summary>
    Ended,
}
