using System;
using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Handlers;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Response;
using LagSim.Rollback;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim;

/// <summary>Makes those parts of an engine that another may take the place of, and has the rules that they go by.</summary>
/// <remarks>
/// The engine asks for each part once, when it is put together. A negative control hands in a derived class that makes a wrong part, so
/// that no part has to know of faults. Immutable; used by many worlds.
/// </remarks>
internal class EngineParts
{
    /// <summary>The right parts.</summary>
    internal static readonly EngineParts Usual = new();

    /// <summary>The rules for solutions of contact problems.</summary>
    internal virtual SolverRules SolverRules => SolverRules.Usual;

    /// <summary>Whether contacts of a scene may last. In a periodic box none does.</summary>
    internal virtual bool HasIslands(Scene scene) => !scene.Box.Exists;

    /// <summary>The measures of contact.</summary>
    internal virtual ContactScale ContactScale(Scene scene, SimTime start) => new(scene.ContactTolerance, scene.Gravity, start);

    internal virtual TimelineGrowthPolicy TimelineGrowthPolicy(SimTime origin, SimDuration history) => new(origin, history);

    internal virtual SegmentLookup SegmentLookup(TimelineStore timelines, RollbackState rollback) => new(timelines, rollback);

    internal virtual AdaptiveBroadPhase BroadPhase(Scene scene, BodyTable bodies, TimelineStore timelines, int bruteForceLimit) =>
        new(scene, bodies, timelines, bruteForceLimit);

    internal virtual CollisionSearch CollisionSearch(
        BodyTable bodies, TimelineStore timelines, FreeFlights flights, StaticSurfaces surfaces, CollisionPredictor predictor,
        SegmentLookup view, StepMarks stepMarks, EventWork work) =>
        new(bodies, timelines, flights, surfaces, predictor, view, stepMarks, work);

    internal virtual EventPredictor EventPredictor(
        BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, RollbackState rollback, FreeFlights flights,
        AdaptiveBroadPhase broadPhase, CollisionSearch search, SegmentLookup view) =>
        new(bodies, timelines, log, scheduler, rollback, flights, broadPhase, search, view);

    internal virtual CutPaths CutPaths() => new();

    internal virtual CutCrossings CutCrossings(CrossingLog log) => new(log);

    internal virtual CrossingPredictor CrossingPredictor(
        Scene scene, SimTime start, BodyTable bodies, TimelineStore timelines, SegmentLookup view, CrossingLog log) =>
        new(scene, start, bodies, timelines, view, log);

    internal virtual Rewinder Rewinder(
        BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, Progress progress, RollbackState rollback,
        Reconvergence reconvergence, EventPredictor predictor, HealingMode mode) =>
        new(bodies, timelines, log, scheduler, progress, rollback, reconvergence, predictor, mode);

    internal virtual MemberFactory MemberFactory(
        BodyTable bodies, TimelineStore timelines, in Forces forces, ContactScale scale, TrajectoryFactory trajectories) =>
        new(bodies, timelines, forces, scale, trajectories);

    internal virtual SleepWaker SleepWaker(
        BodyTable bodies, TimelineStore timelines, SegmentLookup view, ContactGraph graph, RewindRequests rewinds, MemberFactory members) =>
        new(bodies, timelines, view, graph, rewinds, members);

    internal virtual IslandStatics IslandStatics(BodyTable bodies, in Forces forces, ContactGraph graph, ContactStep step) =>
        new(bodies, forces, graph, step);

    internal virtual SegmentLinker SegmentLinker(
        BodyTable bodies, TimelineStore timelines, ContactGraph graph, Partners partners, MemberFactory members) =>
        new(bodies, timelines, graph, partners, members);

    internal virtual CollapseRule CollapseRule(
        Scene scene, BodyTable bodies, TimelineStore timelines, ContactGraph graph, StrikeCounts strikes) =>
        new(scene, bodies, timelines, graph, strikes);

    internal virtual IsolatedImpact IsolatedImpact(
        Scene scene, BodyTable bodies, TimelineStore timelines, EventScheduler scheduler, RollbackState rollback, FreeFlights flights,
        ContactGraph graph, FreeImpactResponse resolver, ImpactNotifier notifier, ImpactSegments segments) =>
        new(scene, bodies, timelines, scheduler, rollback, flights, graph, resolver, notifier, segments);

    internal virtual ImpactGraphBuilder ImpactGraphBuilder(
        Scene scene, BodyTable bodies, TimelineStore timelines, RollbackState rollback, RewindRequests rewinds, SegmentLookup view,
        FreeFlights flights, AdaptiveBroadPhase broadPhase, CollisionPredictor predictor, CollapseRule collapse, ContactGraph graph,
        Partners partners, EventWork work) =>
        new(scene, bodies, timelines, rollback, rewinds, view, flights, broadPhase, predictor, collapse, graph, partners, work);

    internal virtual FreePlaces FreePlaces(Scene scene, BodyTable bodies, TimelineStore timelines, SegmentLookup view) =>
        new(scene, bodies, timelines, view);

    internal virtual RuleLog RuleLog(Scene scene, SimTime start, ReadOnlySpan<byte> state) => new(scene, start, state);

    internal virtual RuleCaller RuleCaller(
        GameRules rules, RuleLog log, RuleMemory memory, RuleWorld world, RuleView view, RuleActs acts, HealingMode mode) =>
        new(rules, log, memory, world, view, acts, mode);
}
