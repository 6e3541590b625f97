using System;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>A peer that is in the session, as every peer's <see cref="Session.Roster"/> shows it.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class RosterMember : IEquatable<RosterMember>
{
    internal RosterMember(byte number, uint visit, PeerRole role, string name, SimTime? silentSince)
    {
        Number = number;
        Visit = visit;
        Role = role;
        Name = name;
        SilentSince = silentSince;
    }

    /// <summary>
    /// Its number: 0 for the host, then players and bots up to <see cref="SessionOptions.MaxClients"/>, then spectators.
    /// </summary>
    public byte Number { get; }

    /// <summary>What it calls itself; may be empty, and is not proved unless the host admits by connect tokens.</summary>
    public string Name { get; }

    /// <summary>As what it takes part.</summary>
    public PeerRole Role { get; }

    /// <summary>
    /// Null while it is heard. Of a peer that has been silent for half the <see cref="SessionOptions.Timeout"/>, the shared time at which
    /// it was last heard: by the host, and the host by this peer.
    /// </summary>
    public SimTime? SilentSince { get; }

    /// <summary>Distinguishes those who have the number one after the other.</summary>
    internal uint Visit { get; }

    /// <summary>Whether it is the same peer as another member, whatever else has changed.</summary>
    internal bool IsSamePeer(RosterMember other) => Number == other.Number && Visit == other.Visit;

    /// <summary>Same peer, name, role and silence.</summary>
    public bool Equals(RosterMember? other) => other is not null && IsSamePeer(other) && Role == other.Role
        && string.Equals(Name, other.Name, StringComparison.Ordinal) && SilentSince == other.SilentSince;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => Equals(obj as RosterMember);

    /// <inheritdoc/>
    public override int GetHashCode() => Number;

    /// <summary>Number, role and name.</summary>
    public override string ToString() => FormattableString.Invariant(
        $"{Number} {Role.ToString().ToLowerInvariant()}{(Name.Length > 0 ? " " : "")}{Name}");
}
