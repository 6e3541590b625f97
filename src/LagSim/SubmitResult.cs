namespace LagSim;

/// <summary>The result of submitting an external event.</summary>
public enum SubmitResult
{
    /// <summary>
    /// It lies ahead of what is simulated and happens when its time comes. Whether it then has an effect depends on what it meets; ask
    /// <see cref="Simulation.TookEffect"/>.
    /// </summary>
    Queued,

    /// <summary>
    /// Its time was simulated already: the paths that it can have touched are undone from there on, and the next advance simulates them
    /// again.
    /// </summary>
    RolledBack,

    /// <summary>The same event (time, kind, body, peer, sequence) is there already; nothing changed.</summary>
    Duplicate,

    /// <summary>It lies before the history that is kept; nothing changed.</summary>
    TooOld,
}
