using System;
using System.Threading;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <summary>How a <see cref="Simulation"/> is run; what it simulates is the scene's.</summary>
/// <remarks>Immutable.</remarks>
public sealed class SimulationOptions
{
    /// <summary>The default history: 1 s.</summary>
    public static readonly SimDuration DefaultHistory = SimDuration.FromSeconds(1);

    /// <summary>The default limit on segments: 8,388,608, of 1.5 to 3 GB, and as much again while they grow.</summary>
    public const int DefaultMaxSegments = 1 << 23;

    /// <summary>The number of bodies above which neighbour lists cost less than testing every body.</summary>
    internal const int DefaultBruteForceLimit = 64;

    /// <summary>Options, each with its default.</summary>
    /// <param name="start">The instant at which the scene begins; default the origin. It has no influence on the motion, to the
    /// bit.</param>
    /// <param name="history">
    /// How far behind the simulated time timelines are kept, and so how late an event may come; above zero, default 1 s.
    /// <see cref="SimDuration.MaxValue"/> keeps everything.
    /// </param>
    /// <param name="maxSegments">
    /// The largest number of segments in all timelines together, at least one; default <see cref="DefaultMaxSegments"/>. Each takes 184 to
    /// 356 bytes (<see cref="Timelines.LatencyCompensationWindow"/>). A simulation that would need more ends with a
    /// <see cref="TimelinesFullException"/>, which names the body with most of them.
    /// </param>
    /// <param name="cancellation">
    /// Ends the simulation's current call, from any thread, with an <see cref="OperationCanceledException"/>: between two events, also of
    /// one instant.
    /// </param>
    /// <param name="healing">How an event before the simulated time is brought in. It has no influence on the result, to the bit.</param>
    /// <exception cref="ArgumentOutOfRangeException">
    /// The history or the most segments are not above zero, the start is more than 72 days from the origin, or there is no such healing.
    /// </exception>
    public SimulationOptions(
        SimTime start = default, SimDuration? history = null, int maxSegments = DefaultMaxSegments, CancellationToken cancellation = default,
        HealingMode healing = HealingMode.CausalCone)
    {
        if (history is SimDuration given && given <= SimDuration.Zero)
        {
            throw new ArgumentOutOfRangeException(nameof(history), given.ToShortString(), "The history must be longer than zero.");
        }

        if (!Limits.IsStart(start))
        {
            throw new ArgumentOutOfRangeException(nameof(start), start.ToShortString(), "The start must lie within 72 days (3 x 2^21 s) of the origin.");
        }

        if (maxSegments <= 0)
        {
            throw new ArgumentOutOfRangeException(nameof(maxSegments), maxSegments, "At least one segment must be allowed.");
        }

        if (healing is < HealingMode.CausalCone or > HealingMode.SyncTest)
        {
            throw new ArgumentOutOfRangeException(
                nameof(healing), healing, $"There are {nameof(HealingMode.CausalCone)}, {nameof(HealingMode.FullRollback)} and {nameof(HealingMode.SyncTest)}.");
        }

        Start = start;
        MaxSegments = maxSegments;
        Cancellation = cancellation;
        Healing = healing;
        History = history ?? DefaultHistory;
    }

    /// <summary>The instant at which the scene begins.</summary>
    public SimTime Start { get; }

    /// <summary>How far behind the simulated time timelines are kept.</summary>
    public SimDuration History { get; }

    /// <summary>
    /// The largest number of segments in all timelines together, each of 184 to 356 bytes; more end with a
    /// <see cref="TimelinesFullException"/>.
    /// </summary>
    public int MaxSegments { get; }

    /// <summary>How an event before the simulated time is brought in.</summary>
    public HealingMode Healing { get; private set; }

    /// <summary>
    /// The number of bodies up to which the broad phase is brute force. No bit depends on it; tests set it to have neighbour lists in small
    /// worlds.
    /// </summary>
    internal int BruteForceLimit { get; private set; } = DefaultBruteForceLimit;

    /// <summary>The same with another <see cref="BruteForceLimit"/>.</summary>
    internal SimulationOptions WithBruteForceLimit(int most) => With(changed => changed.BruteForceLimit = most);

    /// <summary>The factory of the engine's parts.</summary>
    internal EngineParts Parts { get; private set; } = EngineParts.Usual;

    /// <summary>Ends the simulation's current call.</summary>
    public CancellationToken Cancellation { get; private set; }

    /// <summary>
    /// The same, for the twin of a sync test: no cancellation, so that it is never behind, and the usual parts, by which it checks others.
    /// </summary>
    internal SimulationOptions FullyRolledBack() => With(changed =>
    {
        changed.Cancellation = default;
        changed.Healing = HealingMode.FullRollback;
        changed.Observer = null;
        changed.CrossingObserver = null;
        changed.LossObserver = null;
        changed.Parts = EngineParts.Usual;
    });

    /// <summary>Notified of impacts, including those of the very first instant; null for none.</summary>
    internal IImpactObserver? Observer { get; private set; }

    /// <summary>The same with an observer.</summary>
    internal SimulationOptions WithObserver(IImpactObserver? observer) => With(changed => changed.Observer = observer);

    /// <summary>Notified of crossings of sensors, including those of the very first instant; null for none.</summary>
    internal ICrossingObserver? CrossingObserver { get; private set; }

    /// <summary>The same with an observer of crossings.</summary>
    internal SimulationOptions WithCrossingObserver(ICrossingObserver? observer) => With(changed => changed.CrossingObserver = observer);

    /// <summary>Notified of bodies that are lost; null for none.</summary>
    internal ILossObserver? LossObserver { get; private set; }

    /// <summary>The same with an observer of losses.</summary>
    internal SimulationOptions WithLossObserver(ILossObserver? observer) => With(changed => changed.LossObserver = observer);

    /// <summary>Where the world says which call of rules it is in; null, the default, if nobody looks.</summary>
    internal RunningRuleCall? RunningRuleCall { get; private set; }

    /// <summary>The same with a place for the call of rules that runs.</summary>
    internal SimulationOptions WithRunningRuleCall(RunningRuleCall? running) => With(changed => changed.RunningRuleCall = running);

    /// <summary>The same with parts that others make.</summary>
    internal SimulationOptions WithParts(EngineParts parts) => With(changed => changed.Parts = parts);

    // A copy has every option, also one that is added later.
    private SimulationOptions With(Action<SimulationOptions> change)
    {
        SimulationOptions changed = (SimulationOptions)MemberwiseClone();
        change(changed);
        return changed;
    }
}
