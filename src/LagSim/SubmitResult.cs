namespace LagSim;

/// <summary>What became of an external event that was submitted.</summary>
public enum SubmitResult
{
    /// <summary>
    /// It lies ahead of what is simulated and happens when its time comes. Whether it then has an effect depends on what it meets; ask
    /// <see cref="Simulation.TookEffect"/>.
    /// </summary>
    Queued,

    /// <summary>
    /// It lay inside what was simulated already: what it can have touched is taken back from there on, and simulated again by the next
    /// advance.
    /// </summary>
    RolledBack,

    /// <summary>The same event (time, kind, body, peer, sequence) is there already; nothing changed.</summary>
    Duplicate,

    /// <summary>It lies before the history that is kept; nothing changed.</summary>
    TooOld,
}
