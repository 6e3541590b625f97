namespace LagSim.Harness.Verification.Stalls;

/// <summary>What happens to a peer that is no fault of the session's.</summary>
public enum StallKind
{
    /// <summary>The host's process stands still for a while, as after SIGSTOP.</summary>
    HostFrozen,

    /// <summary>The host's process is killed, and started again on the same port after a while, with a new world.</summary>
    HostKilled,

    /// <summary>A client's process stands still for a while.</summary>
    ClientFrozen,

    /// <summary>A client's process is killed, and started again after a while, from another port, with the pass that was kept.</summary>
    ClientKilled,

    /// <summary>The address that the host sees of a client changes every 10 s, as behind a translator that forgets.</summary>
    PortChanges,
}
