using LagSim.Events;
using LagSim.Hosting;
using LagSim.Time;

namespace LagSim.Net.Strategies;

/// <summary>No compensation: the event happens when it arrives. The worlds of the peers then differ for good.</summary>
internal sealed class ApplyOnArrival : ILateEventStrategy
{
    /// <inheritdoc/>
    public string Name => "none";

    /// <inheritdoc/>
    public bool PromisesAgreement => false;

    /// <inheritdoc/>
    public bool RewritesPast => false;

    /// <inheritdoc/>
    public HealingMode Mode => HealingMode.CausalCone;

    /// <summary>Zero: the present is shown.</summary>
    public SimDuration DisplayDelay => SimDuration.Zero;

    /// <inheritdoc/>
    public SubmitResult Apply(LiveWorld world, in ExternalEvent external, SimTime arrival) =>
        world.Submit(external.Time >= arrival ? external : external.At(arrival));
}
