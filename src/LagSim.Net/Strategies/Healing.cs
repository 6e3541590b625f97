using LagSim.Events;
using LagSim.Hosting;
using LagSim.Time;

namespace LagSim.Net.Strategies;

/// <summary>
/// The event happens at its own time: only what it can have touched since is rewound and simulated again. Exact bit for bit.
/// </summary>
internal sealed class Healing : ILateEventStrategy
{
    /// <inheritdoc/>
    public string Name => "healing";

    /// <inheritdoc/>
    public bool PromisesAgreement => true;

    /// <inheritdoc/>
    public bool RewritesPast => true;

    /// <inheritdoc/>
    public HealingMode Mode => HealingMode.CausalCone;

    /// <summary>Zero: the present is shown.</summary>
    public SimDuration DisplayDelay => SimDuration.Zero;

    /// <inheritdoc/>
    public SubmitResult Apply(LiveWorld world, in ExternalEvent external, SimTime arrival) => world.Submit(external);
}
