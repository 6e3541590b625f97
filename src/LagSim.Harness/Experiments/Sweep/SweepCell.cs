using System.Globalization;
using LagSim.Harness.Reports;
using LagSim.Testing.Links;

namespace LagSim.Harness.Experiments.Sweep;

/// <summary>One cell of the sweep over full links: the number of clients, their rate of events, and their links.</summary>
/// <param name="Clients">The number of clients. Each has its own link to the host.</param>
/// <param name="EventsPerSecond">The number of events per second of each client.</param>
/// <param name="RateBitsPerSecond">The rate of each link, in bit/s, in each direction.</param>
/// <param name="QueueMilliseconds">The length of its queues at that rate, in milliseconds.</param>
/// <param name="HasDips">Whether the rate falls to a fifth for 5 s every 30 s.</param>
/// <param name="IsShared">Whether all clients share one link, as behind one access line.</param>
/// <param name="HasBulkTransfer">Whether a bulk TCP transfer towards each client goes through the same queues.</param>
public sealed record SweepCell(int Clients, double EventsPerSecond, long RateBitsPerSecond, double QueueMilliseconds, bool HasDips, bool IsShared = false, bool HasBulkTransfer = false)
{
    /// <summary>The one-way delay of an empty link, in milliseconds.</summary>
    public const double DelayMilliseconds = 20;

    /// <summary>The link of each client.</summary>
    public LinkProfile Link => new("sweep", new LinkLeg(DelayMilliseconds, 1)
    {
        Bottleneck = new Bottleneck(RateBitsPerSecond, QueueMilliseconds)
        {
            Dip = HasDips ? new PeriodicDip(periodSeconds: 30, lengthSeconds: 5, rateBitsPerSecond: RateBitsPerSecond / 5) : null,
        },
    })
    {
        HasBulkTransfer = HasBulkTransfer,
    };

    /// <summary>Returns a short description.</summary>
    public override string ToString() => string.Create(
        CultureInfo.InvariantCulture,
        $"{NumberText.Count(Clients, "client")}, {EventsPerSecond} events/s each, {RateBitsPerSecond / 1000.0} kbit/s, queue {QueueMilliseconds} ms{(HasDips ? ", dips" : "")}{(IsShared ? ", shared" : "")}{(HasBulkTransfer ? ", beside a bulk transfer" : "")}");
}
