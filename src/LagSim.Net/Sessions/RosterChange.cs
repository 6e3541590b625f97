namespace LagSim.Net.Sessions;

/// <summary>One change of a session's roster.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public readonly struct RosterChange
{
    internal RosterChange(RosterChangeKind kind, RosterMember member)
    {
        Kind = kind;
        Member = member;
    }

    /// <summary>What happened.</summary>
    public RosterChangeKind Kind { get; }

    /// <summary>The member: as it is now, or as it was before it went.</summary>
    public RosterMember Member { get; }

    /// <summary>What happened, and to whom.</summary>
    public override string ToString() => $"{Kind.ToString().ToLowerInvariant()}: {Member}";
}
