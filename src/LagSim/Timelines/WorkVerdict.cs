namespace LagSim.Timelines;

/// <summary>What an <see cref="IWorkObserver"/> says of an advance; of two the greater holds.</summary>
internal enum WorkVerdict
{
    /// <summary>It goes on.</summary>
    GoOn,

    /// <summary>It stops after this instant.</summary>
    StopAfterInstant,

    /// <summary>It stops at once in a session's world, though an instant be done in part; elsewhere after this instant.</summary>
    StopNow,
}
