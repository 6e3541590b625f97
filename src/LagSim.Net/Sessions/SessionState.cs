namespace LagSim.Net.Sessions;

/// <summary>Where a peer stands in its session.</summary>
public enum SessionState
{
    /// <summary>A joiner asks to be let in.</summary>
    Joining,

    /// <summary>A joiner measures how far its clock is from the host's.</summary>
    Synchronising,

    /// <summary>The shared time is known; the start is not, or not all expected peers are there.</summary>
    Waiting,

    /// <summary>There is a world, simulated ahead of the shared time.</summary>
    Running,

    /// <summary>It is over; the world stays readable.</summary>
    Ended,
}
