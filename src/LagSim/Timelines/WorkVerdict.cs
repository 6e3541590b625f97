namespace LagSim.Timelines;

/// <summary>The verdict of an <see cref="IWorkObserver"/> on an advance; of two the greater counts.</summary>
internal enum WorkVerdict
{
    /// <summary>The advance continues.</summary>
    GoOn,

    /// <summary>It stops after this instant.</summary>
    StopAfterInstant,

    /// <summary>It stops at once in a session's world, even if an instant is done in part; elsewhere after this instant.</summary>
    StopNow,
}
