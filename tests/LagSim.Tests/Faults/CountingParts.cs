using LagSim.Collisions;
using LagSim.Events;
using LagSim.Rollback;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>The right parts, which count how often a body is rewound.</summary>
/// <param name="rewindsAgain">As a control: whether each late event rewinds all that is put down after it, also where that was done.</param>
internal sealed class CountingParts(bool rewindsAgain) : EngineParts
{
    internal long Rewinds { get; private set; }

    internal override Rewinder Rewinder(
        BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, Progress progress, RollbackState rollback,
        Reconvergence reconvergence, EventPredictor predictor, HealingMode mode) =>
        new CountingRewinder(bodies, timelines, log, scheduler, progress, rollback, reconvergence, predictor, mode, this);

    private sealed class CountingRewinder(
        BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, Progress progress, RollbackState rollback,
        Reconvergence reconvergence, EventPredictor predictor, HealingMode mode, CountingParts parts)
        : Rewinder(bodies, timelines, log, scheduler, progress, rollback, reconvergence, predictor, mode)
    {
        private protected override EventKey CutsFrom(in EventKey key)
        {
            parts.Rewinds++;
            return base.CutsFrom(key);
        }

        private protected override void RewindPlacings(in EventKey after, SimTime last) =>
            base.RewindPlacings(after, parts.rewindsAgain ? KnownTo : last);
    }

    private readonly bool rewindsAgain = rewindsAgain;
}
