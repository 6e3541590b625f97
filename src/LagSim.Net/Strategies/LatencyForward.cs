using LagSim.Events;
using LagSim.Hosting;
using LagSim.Time;

namespace LagSim.Net.Strategies;

/// <summary>
/// The thesis's method: on arrival the body is put where its own motion and contacts with static geometry would have taken it had the event
/// come in time. Effects of other bodies on it in between, and of it on them, are lost.
/// </summary>
internal sealed class LatencyForward : ILateEventStrategy
{
    /// <inheritdoc/>
    public string Name => "latency-forward";

    /// <summary>False: peers agree only if the late body touched no other in between.</summary>
    public bool PromisesAgreement => false;

    /// <summary>False: the past before the arrival stays as it was.</summary>
    public bool RewritesPast => false;

    /// <inheritdoc/>
    public HealingMode Mode => HealingMode.CausalCone;

    /// <summary>Zero: the present is shown.</summary>
    public SimDuration DisplayDelay => SimDuration.Zero;

    /// <inheritdoc/>
    public SubmitResult Apply(LiveWorld world, in ExternalEvent external, SimTime arrival) =>
        external.Time >= arrival ? world.Submit(external) : world.SubmitForwarded(external, arrival);
}
