namespace LagSim.Net.Sessions;

/// <summary>The state of a peer in its session.</summary>
public enum SessionState
{
    /// <summary>A client asks to be let in.</summary>
    Joining,

    /// <summary>A client measures the offset of its clock from the host's.</summary>
    Synchronising,

    /// <summary>The shared time is known; the start is not, or expected peers are missing.</summary>
    Waiting,

    /// <summary>There is a world, simulated ahead of the shared time.</summary>
    Running,

    /// <summary>
    /// A client that lost its host or its world asks to be let in again. Its old world stays readable and stands still, and no action is
    /// possible.
    /// </summary>
    Rejoining,

    /// <summary>The session is over; the world stays readable.</summary>
    Ended,
}
