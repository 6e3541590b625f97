using System;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Time;

namespace LagSim.Net.Strategies;

/// <summary>
///  Draw the past: the world heals as with <see cref="Healing"/>, right bit for bit, but what is shown lies <see cref="DisplayDelay"/>
/// behind shared time, so that most events have come before it is drawn, and nothing jumps.
/// </summary>
/// <remarks>
///  The price is paid always and by everybody: all that is seen is old by the delay, what this peer itself does included. That is input
/// latency, which no other strategy has. An event that comes later than the delay is seen to jump as with any other.
/// </remarks>
internal sealed class Interpolation : ILateEventStrategy
{
    /// <summary>How far behind shared time the world is shown where nothing else is said: 100 ms.</summary>
    public static readonly SimDuration DefaultDelay = SimDuration.FromMilliseconds(100);

    /// <summary>The longest delay: 5 s, as the longest history.</summary>
    public static readonly SimDuration MaxDelay = SimDuration.FromSeconds(5);

    /// <summary>Shows the world that far behind shared time, 0 to 5 s; default 100 ms.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The delay is out of its range.</exception>
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
