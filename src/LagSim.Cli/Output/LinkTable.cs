using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>Every link of the session so far, with samples of its traffic.</summary>
internal sealed class LinkTable
{
    private readonly List<LinkRow> rows = [];

    /// <summary>The links, including those that are gone, in the order of arrival.</summary>
    internal IReadOnlyList<LinkRow> Rows => rows;

    /// <summary>The number of present links.</summary>
    internal int Present => rows.Count(row => row.IsPresent);

    /// <summary>The longest round trip of the present links; zero without one.</summary>
    internal SimDuration LongestRoundTrip => rows.Where(row => row.IsPresent).Select(row => row.Last.RoundTrip).DefaultIfEmpty().Max();

    /// <summary>Adds a new link.</summary>
    internal void Add(LinkTraffic link) => rows.Add(new LinkRow(link, Stopwatch.GetTimestamp()));

    /// <summary>Updates the traffic of a link; returns false if there is none to that peer now.</summary>
    internal bool LookAt(LinkTraffic link)
    {
        LinkRow? known = rows.Find(row => row.IsPresent && row.Is(link));
        known?.LookAt(link, Stopwatch.GetTimestamp());
        return known is not null;
    }

    /// <summary>Closes a link, with its final traffic.</summary>
    internal void End(LinkTraffic link)
    {
        if (rows.Find(row => row.IsPresent && row.Is(link)) is LinkRow known)
        {
            known.LookAt(link, Stopwatch.GetTimestamp());
            known.IsPresent = false;
        }
    }
}

/// <summary>A link to one peer.</summary>
internal sealed class LinkRow
{
    private readonly LinkTraffic first;
    private readonly long began;
    private long ended;

    internal LinkRow(LinkTraffic first, long at)
    {
        this.first = first;
        Last = first;
        began = ended = at;
    }

    internal byte Peer => first.Peer;

    /// <summary>The latest address.</summary>
    internal PeerAddress Address => Last.Address;

    internal bool IsPresent { get; set; } = true;

    /// <summary>The latest sample.</summary>
    internal LinkTraffic Last { get; private set; }

    /// <summary>Bytes per second of datagrams without headers, since the first sample; NaN if that was just now.</summary>
    internal double SentPerSecond => PerSecond(Last.BytesSent - first.BytesSent);

    /// <summary>The same for received bytes.</summary>
    internal double ReceivedPerSecond => PerSecond(Last.BytesReceived - first.BytesReceived);

    /// <summary>Whether a sample is of this link: to the same peer, at any address, and with all traffic so far.</summary>
    internal bool Is(LinkTraffic link) => link.Peer == Peer && link.BytesSent >= Last.BytesSent && link.BytesReceived >= Last.BytesReceived;

    internal void LookAt(LinkTraffic link, long at)
    {
        Last = link;
        ended = at;
    }

    private double PerSecond(long bytes) => ended > began ? bytes / Stopwatch.GetElapsedTime(began, ended).TotalSeconds : double.NaN;
}
