using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Handlers;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Response;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim.Tests.Faults;

/// <summary>Makes the parts of an engine that does something wrongly, or the long way, on purpose: negative controls.</summary>
/// <remarks>With nothing set all is right. What has a setter may be set while the world goes on.</remarks>
internal sealed class FaultyEngineParts : EngineParts
{
    /// <summary>How it heals wrongly.</summary>
    internal HealingFault Healing { get; set; }

    /// <summary>Takes the operands of a contact the wrong way round.</summary>
    internal bool SwapsOperands { get; set; }

    /// <summary>Takes bodies that meet three at a time for two.</summary>
    internal bool IgnoresTies { get; init; }

    /// <summary>Builds the contact graph of every impact, however plain, and looks at every pair: the same bits by the long way.</summary>
    internal bool TakesNoShortcut { get; init; }

    /// <summary>Takes bodies for apart from whatever another did before its newest segment.</summary>
    internal bool OverlooksPastPaths { get; init; }

    /// <summary>Takes no contact for one that lasts.</summary>
    internal bool IgnoresIslands { get; init; }

    /// <summary>Takes what is slow for still.</summary>
    internal bool SleepsWhereSlow { get; init; }

    /// <summary>Bounces as often as it closes.</summary>
    internal bool NeverCollapses { get; init; }

    /// <summary>Cuts timelines at their time instead of at their key, in a full rollback.</summary>
    internal bool CutsByTime { get; init; }

    /// <summary>Searches for the next crossing of a sensor from the opening of the segment on, not from the last crossing.</summary>
    internal bool SearchesFromOpening { get; init; }

    /// <summary>Asks whether a place is in a wall with the default filter.</summary>
    internal bool PlacesByDefaultFilter { get; init; }

    /// <summary>Does not foretell how much room timelines will need.</summary>
    internal bool GrowsByLittle { get; init; }

    /// <summary>Follows what changes within a contact step only from the next one on.</summary>
    internal bool FollowsChangesLate { get; init; }

    /// <summary>What solutions are held to.</summary>
    internal SolverRules Rules { get; init; } = SolverRules.Usual;

    /// <summary>What contact is measured by; null for what follows from the scene.</summary>
    internal ContactScale? Scale { get; init; }

    internal override SolverRules SolverRules => Rules;

    /// <summary>Whether it heals wrongly in that way.</summary>
    internal bool Has(HealingFault wrong) => (Healing & wrong) != 0;

    internal override bool HasIslands(Scene scene) => !IgnoresIslands && base.HasIslands(scene);

    internal override MemberFactory MemberFactory(
        BodyTable bodies, TimelineStore timelines, in Forces forces, ContactScale scale, TrajectoryFactory trajectories) =>
        FollowsChangesLate
            ? new HastyMemberFactory(bodies, timelines, forces, scale, trajectories)
            : base.MemberFactory(bodies, timelines, forces, scale, trajectories);

    internal override ContactScale ContactScale(Scene scene, SimTime start) => Scale ?? base.ContactScale(scene, start);

    internal override TimelineGrowthPolicy TimelineGrowthPolicy(SimTime origin, SimDuration history) =>
        GrowsByLittle ? new UnforeseeingGrowth(origin, history) : base.TimelineGrowthPolicy(origin, history);

    internal override SegmentLookup SegmentLookup(TimelineStore timelines, RollbackState rollback) =>
        new FaultySegmentLookup(timelines, rollback, this, isForPending: false);

    internal override AdaptiveBroadPhase BroadPhase(Scene scene, BodyTable bodies, TimelineStore timelines, int bruteForceLimit) =>
        new FaultyBroadPhase(scene, bodies, timelines, bruteForceLimit, this);

    internal override CollisionSearch CollisionSearch(
        BodyTable bodies, TimelineStore timelines, FreeFlights flights, StaticSurfaces surfaces, CollisionPredictor predictor,
        SegmentLookup view, StepMarks stepMarks, EventWork work) =>
        TakesNoShortcut
            ? new LongSearch(bodies, timelines, flights, surfaces, predictor, view, work)
            : OverlooksPastPaths
            ? new HastySearch(bodies, timelines, flights, surfaces, predictor, view, stepMarks, work)
            : base.CollisionSearch(bodies, timelines, flights, surfaces, predictor, view, stepMarks, work);

    internal override EventPredictor EventPredictor(
        BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, RollbackState rollback, FreeFlights flights,
        AdaptiveBroadPhase broadPhase, CollisionSearch search, SegmentLookup view) =>
        new FaultyEventPredictor(
            bodies, timelines, log, scheduler, rollback, flights, (FaultyBroadPhase)broadPhase, search,
            new FaultySegmentLookup(timelines, rollback, this, isForPending: true), this);

    internal override FreePlaces FreePlaces(Scene scene, BodyTable bodies, TimelineStore timelines, SegmentLookup view) =>
        PlacesByDefaultFilter ? new FaultyPlaces(scene, bodies, timelines, view) : base.FreePlaces(scene, bodies, timelines, view);

    internal override CutPaths CutPaths() => new FaultyCutPaths(this);

    internal override CutCrossings CutCrossings(CrossingLog log) => new FaultyCutCrossings(log, this);

    internal override CrossingPredictor CrossingPredictor(
        Scene scene, SimTime start, BodyTable bodies, TimelineStore timelines, SegmentLookup view, CrossingLog log) =>
        SearchesFromOpening ? new OpeningSearch(scene, start, bodies, timelines, view, log) : base.CrossingPredictor(scene, start, bodies, timelines, view, log);

    internal override Rewinder Rewinder(
        BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, Progress progress, RollbackState rollback,
        Reconvergence reconvergence, EventPredictor predictor, HealingMode mode) =>
        new FaultyRewinder(bodies, timelines, log, scheduler, progress, rollback, reconvergence, predictor, mode, this);

    internal override SleepWaker SleepWaker(
        BodyTable bodies, TimelineStore timelines, SegmentLookup view, ContactGraph graph, RewindRequests rewinds, MemberFactory members) =>
        new FaultySleepWaker(bodies, timelines, (FaultySegmentLookup)view, graph, rewinds, members, this);

    internal override IslandStatics IslandStatics(BodyTable bodies, in Forces forces, ContactGraph graph, ContactStep step) =>
        SleepsWhereSlow ? new FaultyIslandStatics(bodies, forces, graph, step) : base.IslandStatics(bodies, forces, graph, step);

    internal override SegmentLinker SegmentLinker(
        BodyTable bodies, TimelineStore timelines, ContactGraph graph, Partners partners, MemberFactory members) =>
        new FaultySegmentLinker(bodies, timelines, graph, partners, members, this);

    internal override CollapseRule CollapseRule(
        Scene scene, BodyTable bodies, TimelineStore timelines, ContactGraph graph, StrikeCounts strikes) =>
        new FaultyCollapseRule(scene, bodies, timelines, graph, strikes, this);

    internal override IsolatedImpact IsolatedImpact(
        Scene scene, BodyTable bodies, TimelineStore timelines, EventScheduler scheduler, RollbackState rollback, FreeFlights flights,
        ContactGraph graph, FreeImpactResponse resolver, ImpactNotifier notifier, ImpactSegments segments) =>
        new FaultyIsolatedImpact(scene, bodies, timelines, scheduler, rollback, flights, graph, resolver, notifier, segments, this);

    internal override ImpactGraphBuilder ImpactGraphBuilder(
        Scene scene, BodyTable bodies, TimelineStore timelines, RollbackState rollback, RewindRequests rewinds, SegmentLookup view,
        FreeFlights flights, AdaptiveBroadPhase broadPhase, CollisionPredictor predictor, CollapseRule collapse, ContactGraph graph,
        Partners partners, EventWork work) =>
        new FaultyImpactGraphBuilder(
            scene, bodies, timelines, rollback, rewinds, view, flights, broadPhase, predictor, collapse, graph, partners, work, this);
}
