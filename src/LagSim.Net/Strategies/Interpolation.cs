using System;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Time;

namespace LagSim.Net.Strategies;

/// <summary>
/// Draws the past: the world heals as with <see cref="Healing"/>, exact bit for bit, but is shown <see cref="DisplayDelay"/> behind shared
/// time, so that most events arrive before they are drawn and nothing jumps.
/// </summary>
/// <remarks>
/// Every player pays the price all the time: everything is seen late by the delay, including this peer's own actions. That is input
/// latency, which no other strategy has. An event that arrives later than the delay causes a visible jump, as with any other strategy.
/// </remarks>
internal sealed class Interpolation : ILateEventStrategy
{
    /// <summary>The default delay behind shared time: 100 ms.</summary>
    public static readonly SimDuration DefaultDelay = SimDuration.FromMilliseconds(100);

    /// <summary>The longest delay: 5 s, like the longest history.</summary>
    public static readonly SimDuration MaxDelay = SimDuration.FromSeconds(5);

    /// <summary>Creates the strategy with a delay behind shared time, 0 to 5 s; default 100 ms.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The delay is out of range.</exception>
    public Interpolation(SimDuration? delay = null)
    {
        DisplayDelay = delay ?? DefaultDelay;
        if (DisplayDelay < SimDuration.Zero || DisplayDelay > MaxDelay)
        {
            throw new ArgumentOutOfRangeException(nameof(delay), DisplayDelay.ToShortString(), $"The world is shown 0 s to {MaxDelay.ToShortString()} behind"
                + " shared time.");
        }
    }

    /// <inheritdoc/>
    public string Name => "interpolation";

    /// <inheritdoc/>
    public bool PromisesAgreement => true;

    /// <inheritdoc/>
    public bool RewritesPast => true;

    /// <inheritdoc/>
    public HealingMode Mode => HealingMode.CausalCone;

    /// <inheritdoc/>
    public SimDuration DisplayDelay { get; }

    /// <inheritdoc/>
    public SubmitResult Apply(LiveWorld world, in ExternalEvent external, SimTime arrival) => world.Submit(external);
}
