using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>A client's desync queries: two per second are answered, with a burst as large as a whole answer.</summary>
internal sealed class DesyncQueries(SimTime now)
{
    private readonly RateLimit rate = new(2, RecentEvents.Most / DesyncQueryDatagram.MaxEvents, now);

    /// <summary>The last one that was answered; 0 for none.</summary>
    internal uint Last { get; set; }

    /// <summary>Takes one to answer; false if there were too many.</summary>
    internal bool TrySpend(SimTime now) => rate.TrySpend(now);
}
