using System.Globalization;
using LagSim.Harness.Reports;
using LagSim.Testing.Links;

namespace LagSim.Harness.Experiments.Sweep;

/// <summary>One cell of the sweep over full links: how many clients do how much over which links.</summary>
/// <param name="Clients">How many clients there are; each has a link of its own to the host.</param>
/// <param name="EventsPerSecond">How many events each of them does a second.</param>
/// <param name="RateBitsPerSecond">How much each link carries, in each direction.</param>
/// <param name="QueueMilliseconds">How long its queues are, at that rate.</param>
/// <param name="HasDips">Whether it carries a fifth of that for 5 s every 30 s.</param>
/// <param name="IsShared">Whether all clients share one link, as those behind one line do.</param>
/// <param name="HasBulkTransfer">Whether a bulk TCP transfer towards each client goes through the same queues.</param>
public sealed record SweepCell(int Clients, double EventsPerSecond, long RateBitsPerSecond, double QueueMilliseconds, bool HasDips, bool IsShared = false, bool HasBulkTransfer = false)
{
    /// <summary>One way, on an empty link, in milliseconds.</summary>
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

    /// <summary>All of it in a few words.</summary>
    public override string ToString() => string.Create(
        CultureInfo.InvariantCulture,
        $"{NumberText.Count(Clients, "client")}, {EventsPerSecond} events/s each, {RateBitsPerSecond / 1000.0} kbit/s, queue {QueueMilliseconds} ms{(HasDips ? ", dips" : "")}{(IsShared ? ", shared" : "")}{(HasBulkTransfer ? ", beside a bulk transfer" : "")}");
}
