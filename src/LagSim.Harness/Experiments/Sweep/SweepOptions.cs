using System;
using System.Collections.Generic;
using LagSim.Net.Sessions;

namespace LagSim.Harness.Experiments.Sweep;

/// <summary>The options of the sweep over full links: which cells are played, and for how long.</summary>
public sealed record SweepOptions
{
    /// <summary>The numbers of clients; default 3 and 8.</summary>
    public IReadOnlyList<int> Clients { get; init; } = [3, 8];

    /// <summary>The numbers of events per second of each client; default 0, 5, 10, 20, 40.</summary>
    public IReadOnlyList<double> EventsPerSecond { get; init; } = [0, 5, 10, 20, 40];

    /// <summary>The rates of links, in kbit/s; default 64, 256, 1,000, 10,000.</summary>
    public IReadOnlyList<double> KilobitsPerSecond { get; init; } = [64, 256, 1_000, 10_000];

    /// <summary>The lengths of their queues, in milliseconds; default 50, 500, 2,000.</summary>
    public IReadOnlyList<double> QueueMilliseconds { get; init; } = [50, 500, 2_000];

    /// <summary>Whether each cell is played with dips too; default true.</summary>
    public bool Dips { get; init; } = true;

    /// <summary>Whether all clients of a cell share one link; default false: each has its own.</summary>
    public bool IsShared { get; init; }

    /// <summary>Whether a bulk TCP transfer towards each client goes through the same queues; default false.</summary>
    public bool BulkTransfers { get; init; }

    /// <summary>How long clients act, in seconds; default 120.</summary>
    public double PlaySeconds { get; init; } = 120;

    /// <summary>How long the cell runs on without actions after that, in seconds; default 60.</summary>
    public double RestSeconds { get; init; } = 60;

    /// <summary>The seed; default 1.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>The number of cells played at a time; default the number of processors.</summary>
    public int Workers { get; init; } = Environment.ProcessorCount;

    /// <summary>Called with each peer's number and session before its first step, for tests that inject faults.</summary>
    internal Action<int, Session>? Prepare { get; init; }

    /// <summary>All cells, in the order of the report.</summary>
    public IEnumerable<SweepCell> Cells()
    {
        foreach (int clients in Clients)
        {
            foreach (double kilobits in KilobitsPerSecond)
            {
                foreach (double queue in QueueMilliseconds)
                {
                    foreach (bool dips in Dips ? new[] { false, true } : [false])
                    {
                        foreach (double events in EventsPerSecond)
                        {
                            yield return new SweepCell(clients, events, (long)Math.Round(kilobits * 1000), queue, dips, IsShared, BulkTransfers);
                        }
                    }
                }
            }
        }
    }
}
