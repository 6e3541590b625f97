using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>Every link there has been, as it was looked at from time to time.</summary>
internal sealed class LinkTable
{
    private readonly List<LinkRow> rows = [];

    /// <summary>The links, those that are gone included, in the order in which they came.</summary>
    internal IReadOnlyList<LinkRow> Rows => rows;

    /// <summary>How many there are now.</summary>
    internal int Present { get; private set; }

    /// <summary>The longest there and back of those that there are; zero without one.</summary>
    internal SimDuration LongestRoundTrip => rows.Where(row => row.IsPresent).Select(row => row.Last.RoundTrip).DefaultIfEmpty().Max();

    /// <summary>Takes in what went over the links so far.</summary>
    /// <param name="now">The links that there are.</param>
    /// <param name="came">Told of each that is new.</param>
    /// <param name="gone">Told of each that is no more.</param>
    internal void LookAt(IReadOnlyList<LinkTraffic> now, Action<LinkRow> came, Action<LinkRow> gone)
    {
        long at = Stopwatch.GetTimestamp();
        foreach (LinkRow row in rows.Where(row => row.IsPresent && !now.Any(row.Is)).ToArray())
        {
            row.IsPresent = false;
            gone(row);
        }

        foreach (LinkTraffic link in now)
        {
            LinkRow? known = rows.Find(row => row.IsPresent && row.Is(link));
            if (known is null)
            {
                known = new LinkRow(link, at);
                rows.Add(known);
                came(known);
            }

            known.LookAt(link, at);
        }

        Present = now.Count;
    }
}

/// <summary>A link to one other peer.</summary>
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

    internal PeerAddress Address => first.Address;

    internal bool IsPresent { get; set; } = true;

    /// <summary>As it was last looked at.</summary>
    internal LinkTraffic Last { get; private set; }

    /// <summary>Bytes a second of datagrams alone, since it was first looked at; NaN if that was just now.</summary>
    internal double SentPerSecond => PerSecond(Last.BytesSent - first.BytesSent);

    /// <summary>The same of what came.</summary>
    internal double ReceivedPerSecond => PerSecond(Last.BytesReceived - first.BytesReceived);

    internal bool Is(LinkTraffic link) =>
        link.Peer == Peer && link.Address == Address && link.DatagramsSent >= Last.DatagramsSent && link.DatagramsReceived >= Last.DatagramsReceived;

    internal void LookAt(LinkTraffic link, long at)
    {
        Last = link;
        ended = at;
    }

    private double PerSecond(long bytes) => ended > began ? bytes / Stopwatch.GetElapsedTime(began, ended).TotalSeconds : double.NaN;
}
