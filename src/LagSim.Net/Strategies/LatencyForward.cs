using LagSim.Events;
using LagSim.Hosting;
using LagSim.Time;

namespace LagSim.Net.Strategies;

/// <summary>
/// The thesis's way: on arrival the body is put where it would be had the event come in time, by its own motion and contacts with static
/// geometry since then. What other bodies would have done to it, or it to them, in between is lost.
/// </summary>
internal sealed class LatencyForward : ILateEventStrategy
{
    /// <inheritdoc/>
    public string Name => "latency-forward";

    /// <summary>False: peers agree only where the late body met no other in between.</summary>
    public bool PromisesAgreement => false;

    /// <summary>False: what lies before the arrival stays as it was.</summary>
    public bool RewritesPast => false;

    /// <inheritdoc/>
    public HealingMode Mode => HealingMode.CausalCone;

    /// <summary>Zero: the present is shown.</summary>
    public SimDuration DisplayDelay => SimDuration.Zero;

    /// <inheritdoc/>
    public SubmitResult Apply(LiveWorld world, in ExternalEvent external, SimTime arrival) =>
        external.Time >= arrival ? world.Submit(external) : world.SubmitForwarded(external, arrival);
}
