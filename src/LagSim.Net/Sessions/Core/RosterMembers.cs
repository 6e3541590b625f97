using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>What an entry of a roster on the wire says to the program.</summary>
internal static class RosterMembers
{
    /// <summary>The member that has a number.</summary>
    internal static RosterMember Of(in RosterEntry entry) => new(
        entry.Number, entry.Visit, (PeerRole)entry.Role, entry.Name,
        entry.SilentSince == SimTime.MinValue ? null : (SimTime?)entry.SilentSince);
}
