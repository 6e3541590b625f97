using System;
using System.Collections.Generic;

namespace LagSim.Net.Sessions.Core;

/// <summary>The peers of the session as far as this peer knows, by ascending number.</summary>
/// <remarks>Replaced on the session's thread; read from any thread.</remarks>
internal sealed class PeerRoster
{
    private volatile IReadOnlyList<RosterMember> members = Array.Empty<RosterMember>();

    /// <summary>Raised for each change: first those who are gone, then the others, by ascending number.</summary>
    internal event Action<RosterChange>? Changed;

    /// <summary>The members; an immutable list.</summary>
    internal IReadOnlyList<RosterMember> Members => members;

    /// <summary>Replaces all members at once, and then raises the differences.</summary>
    /// <param name="next">The members, by ascending number.</param>
    internal void Replace(List<RosterMember> next)
    {
        IReadOnlyList<RosterMember> before = members;
        members = next.AsReadOnly();
        foreach (RosterMember one in before)
        {
            if (!next.Exists(one.IsSamePeer))
            {
                Changed?.Invoke(new RosterChange(RosterChangeKind.Gone, one));
            }
        }

        foreach (RosterMember one in next)
        {
            RosterMember? former = Find(before, one);
            if (former is null || !former.Equals(one))
            {
                Changed?.Invoke(new RosterChange(former is null ? RosterChangeKind.Came : RosterChangeKind.Changed, one));
            }
        }
    }

    private static RosterMember? Find(IReadOnlyList<RosterMember> some, RosterMember one)
    {
        foreach (RosterMember candidate in some)
        {
            if (candidate.IsSamePeer(one))
            {
                return candidate;
            }
        }

        return null;
    }
}
