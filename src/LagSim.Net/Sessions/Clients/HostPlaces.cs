using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>Where the host may be, and what sentences call it.</summary>
internal sealed class HostPlaces
{
    /// <summary>How long each further address of the host waits for the one before it (RFC 8305, 8).</summary>
    private static readonly SimDuration AttemptDelay = SimDuration.FromMilliseconds(250);

    private readonly List<PeerAddress> candidates; // what may be the host's address; the only one once it has answered
    private readonly string? name;

    /// <param name="first">The address that is asked first.</param>
    /// <param name="others">Others that may be the host's.</param>
    /// <param name="name">What a person calls its place; null for its address.</param>
    internal HostPlaces(PeerAddress first, IEnumerable<PeerAddress> others, string? name)
    {
        candidates = new List<PeerAddress> { first };
        candidates.AddRange(others);
        this.name = name;
    }

    internal PeerAddress First => candidates[0];

    /// <summary>What sentences call the host: an address is told only where it says something to a person.</summary>
    internal string Name => name is not null ? $"host at {name}" : First.IsVirtual ? "host" : $"host at {string.Join(" or ", candidates)}";

    internal bool Has(PeerAddress address) => candidates.Contains(address);

    /// <summary>Which addresses to ask after a time without an answer: the first at once, each further one a while after the one before.</summary>
    internal IEnumerable<PeerAddress> ToAsk(SimDuration asked)
    {
        for (int n = 0; n < candidates.Count && asked >= AttemptDelay * n; n++)
        {
            yield return candidates[n];
        }
    }

    internal void Choose(PeerAddress host)
    {
        candidates.Clear();
        candidates.Add(host);
    }
}
