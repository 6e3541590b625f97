namespace LagSim.Net.Sessions;

/// <summary>What happened to a member of a session's roster.</summary>
public enum RosterChangeKind
{
    /// <summary>It is in now.</summary>
    Came = 1,

    /// <summary>It has another name or role, fell silent, or is heard again.</summary>
    Changed = 2,

    /// <summary>It is not in any more.</summary>
    Gone = 3,
}
