namespace LagSim.Harness.Verification.Stalls;

/// <summary>The kinds of disturbances from outside a session.</summary>
public enum StallKind
{
    /// <summary>The host's process stalls for a while, as after SIGSTOP.</summary>
    HostFrozen,

    /// <summary>The host's process is killed, and restarted on the same port after a while, with a new world.</summary>
    HostKilled,

    /// <summary>A client's process stalls for a while.</summary>
    ClientFrozen,

    /// <summary>A client's process is killed, and restarted after a while, from another port, with the pass that was kept.</summary>
    ClientKilled,

    /// <summary>A client's address, as the host sees it, changes every 10 s, as behind a NAT that forgets mappings.</summary>
    PortChanges,
}
