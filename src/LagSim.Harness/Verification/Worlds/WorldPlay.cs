using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Testing.Invariant;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>
/// Plays one world: on time, with promises held to it; late; and from a snapshot on. Compares the last two with the first, bit for bit.
/// </summary>
internal sealed class WorldPlay
{
    private const int Instants = 40;
    private const int LateBudget = 12; // times the events on time, which a heal for each act may take
    private const ulong SceneStream = 1, ActStream = 2, InstantStream = 3, LateStream = 4, SnapshotStream = 5;

    private readonly WorldScene world;
    private readonly SeededRandom random;
    private readonly WorldOptions options;
    private readonly CancellationToken cancellation;
    private readonly IReadOnlyList<ExternalEvent> acts;
    private readonly SimTime end;
    private readonly IReadOnlyList<WorldPromise> promises;

    private WorldPlay(ulong seed, WorldScene world, IReadOnlyList<ExternalEvent> acts, WorldOptions options, CancellationToken cancellation)
    {
        (this.world, this.acts, this.options, this.cancellation) = (world, acts, options, cancellation);
        random = new SeededRandom(seed);
        end = default(SimTime) + SimDuration.FromSeconds(world.Seconds);
        promises = options.Promises(world);
        Outcome = new WorldOutcome { Seed = seed, Kind = world.Kind, Acts = acts.Count };
    }

    private WorldOutcome Outcome { get; set; }

    /// <summary>Plays the world of a seed.</summary>
    /// <exception cref="OperationCanceledException">It was asked to stop before the end: there is no outcome.</exception>
    internal static WorldOutcome Of(ulong seed, WorldOptions options, CancellationToken cancellation)
    {
        WorldScene world = DrawScene(seed);
        WorldActs drawn = DrawActs(seed, world, options, cancellation);
        WorldOutcome outcome = Of(seed, world, drawn.All, options, cancellation);
        return outcome with { ActsAtEvents = drawn.AtEvents, Meetings = drawn.Meetings };
    }

    /// <summary>Plays the world of a seed with some acts only.</summary>
    internal static WorldOutcome Of(
        ulong seed, WorldScene world, IReadOnlyList<ExternalEvent> acts, WorldOptions options, CancellationToken cancellation)
    {
        WorldPlay play = new(seed, world, acts, options, cancellation);
        play.Run();
        return play.Outcome;
    }

    /// <summary>Draws the scene of a seed.</summary>
    internal static WorldScene DrawScene(ulong seed) => WorldScenes.Draw(seed, new SeededRandom(seed).Fork(SceneStream));

    /// <summary>Draws what players do in it.</summary>
    internal static WorldActs DrawActs(ulong seed, WorldScene world, WorldOptions options, CancellationToken cancellation) =>
        WorldActs.Draw(
        world, new SeededRandom(seed).Fork(ActStream), new SimulationOptions(history: SimDuration.MaxValue, cancellation: cancellation),
            options.MaxEvents);

    private void Run()
    {
        string part = "on time";
        try
        {
            WorldBudget budget = new(options.MaxEvents);
            Simulation onTime = PlayOnTime(budget);
            Outcome = Outcome with { Events = onTime.EventsProcessed, LostBodies = onTime.LostBodies().Count };
            if (promises.FirstOrDefault(p => p.Broken is not null) is WorldPromise broken)
            {
                Outcome = Outcome with { FailureKind = WorldFailureKind.Promise, Promise = broken.Name, Failure = broken.Broken };
                return;
            }

            WorldBudget late = new((LateBudget * (budget.Taken + 1000)) + (LateBudget * acts.Count));
            Comparison comparison = new(onTime);
            part = "late";
            string? wrong = PlayLate(onTime, comparison, late);
            part = "from a snapshot";
            wrong ??= PlayFromSnapshot(onTime, comparison, late);
            Outcome = Outcome with { Compared = comparison.Compared, Events = Outcome.Events + late.Taken };
            if (comparison.Differing > 0 || wrong is not null)
            {
                Outcome = Outcome with
                {
                    FailureKind = WorldFailureKind.Differs,
                    Failure = wrong ?? $"{comparison.Differing} of {comparison.Compared} compared states and events differ. {comparison.FirstHash}".TrimEnd(),
                    Difference = comparison.First,
                };
            }
        }
        catch (WorldBudgetException)
        {
            Outcome = Outcome with { IsUnfinished = true };
        }
        catch (TimelinesFullException)
        {
            Outcome = Outcome with { HasFullTimelines = true };
        }
        catch (Exception thrown) when (thrown is not OperationCanceledException and not OutOfMemoryException)
        {
            Outcome = Outcome with
            {
                FailureKind = WorldFailureKind.Ended,
                Failure = $"The world that was played {part} ended by {thrown.GetType().Name}: {thrown.Message}"
            };
        }
    }

    private Simulation PlayOnTime(WorldBudget budget)
    {
        Simulation onTime = new(world.Scene, options.PrepareOnTime(Options()));
        foreach (ExternalEvent act in acts)
        {
            onTime.Submit(act);
        }

        ILookup<SimTime, ExternalEvent> ofTick = acts.ToLookup(a => a.Time);
        SeededRandom from = random.Fork(InstantStream);
        SortedSet<SimTime> instants = [end];
        for (int n = 1; n <= Instants; n++)
        {
            instants.Add(onTime.Start + SimDuration.FromSeconds(world.Seconds * (n - from.NextDouble()) / Instants));
        }

        foreach (ExternalEvent act in acts)
        {
            instants.Add(SimTime.Max(onTime.Start, act.Time - SimDuration.OneTick));
            instants.Add(act.Time);
        }

        WorldMoment moment = new(onTime, []);
        Look(moment);
        foreach (SimTime instant in instants)
        {
            budget.Advance(onTime, instant);
            moment = new WorldMoment(onTime, [.. ofTick[instant]]);
            Look(moment);
        }

        HashSet<SimTime> ticks = [.. acts.Select(a => a.Time)];
        foreach (WorldPromise promise in promises)
        {
            promise.Finish(moment, ticks);
        }

        return onTime;
    }

    private void Look(WorldMoment moment)
    {
        foreach (WorldPromise promise in promises)
        {
            promise.Look(moment);
        }
    }

    private string? PlayLate(Simulation onTime, Comparison comparison, WorldBudget budget)
    {
        SeededRandom from = random.Fork(LateStream);
        HealingMode healing = from.Pick(
            HealingMode.CausalCone, HealingMode.CausalCone, HealingMode.CausalCone, HealingMode.CausalCone, HealingMode.FullRollback,
                HealingMode.SyncTest);
        Simulation late = new(world.Scene, options.PrepareLate(DrawLists(from, Options(healing))));
        WorldDelivery delivery = WorldDelivery.Bring(late, acts, end, from.Fork(0), budget);
        comparison.Take(1, late);
        return delivery.Wrong ?? Answers(onTime, late);
    }

    private string? PlayFromSnapshot(Simulation onTime, Comparison comparison, WorldBudget budget)
    {
        SeededRandom from = random.Fork(SnapshotStream);
        SimTime at = acts.Count > 0 && from.IsLucky(50)
            ? from.Pick([.. acts]).Time + (SimDuration.OneTick * from.NextInt(2))
            : onTime.Start + SimDuration.FromSeconds(from.NextDouble() * world.Seconds);
        at = SimTime.Min(SimTime.Max(at, onTime.Start + SimDuration.OneTick), end);
        WorldSnapshot snapshot = options.PrepareSnapshot(onTime.Snapshot(at));
        Simulation continued = new(world.Scene, snapshot, options.PrepareLate(DrawLists(from, Options())));
        string? wrong = null;
        foreach (ExternalEvent act in acts.Where(a => a.Time < at))
        {
            SubmitResult result = continued.Submit(act);
            wrong ??= result == SubmitResult.TooOld ? null : $"Submitting {act} to a world that begins after it gave {result}.";
        }

        WorldDelivery delivery = WorldDelivery.Bring(continued, [.. acts.Where(a => a.Time >= at)], end, from.Fork(0), budget);
        comparison.Take(2, continued);
        return wrong ?? delivery.Wrong;
    }

    /// <summary>Whether both say the same of what took effect, and of who left the world.</summary>
    private string? Answers(Simulation onTime, Simulation late)
    {
        foreach (ExternalEvent act in acts)
        {
            if (onTime.TookEffect(act) != late.TookEffect(act))
            {
                return $"{act} took effect in one world and not in the other.";
            }
        }

        string[] lost = [.. onTime.LostBodies().Select(l => l.ToString())], lostLate = [.. late.LostBodies().Select(l => l.ToString())];
        return lost.SequenceEqual(lostLate) ? null
            : $"Bodies that left: {string.Join(' ', lost)} on time, {string.Join(' ', lostLate)} late.";
    }

    private SimulationOptions Options(HealingMode healing = HealingMode.CausalCone) =>
        new(history: SimDuration.MaxValue, maxSegments: 1 << 20, cancellation: cancellation, healing: healing);

    private static SimulationOptions DrawLists(SeededRandom from, SimulationOptions options) =>
        from.IsLucky(50) ? options.WithBruteForceLimit(from.NextInt(4)) : options;
}
