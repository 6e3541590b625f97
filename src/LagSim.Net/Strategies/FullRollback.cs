using LagSim.Events;
using LagSim.Hosting;
using LagSim.Time;

namespace LagSim.Net.Strategies;

/// <summary>The event happens at its own time: everything since is rewound and simulated again. Simple, and exact bit for bit.</summary>
internal sealed class FullRollback : ILateEventStrategy
{
    /// <inheritdoc/>
    public string Name => "full-rollback";

    /// <inheritdoc/>
    public bool PromisesAgreement => true;

    /// <inheritdoc/>
    public bool RewritesPast => true;

    /// <inheritdoc/>
    public HealingMode Mode => HealingMode.FullRollback;

    /// <summary>Zero: the present is shown.</summary>
    public SimDuration DisplayDelay => SimDuration.Zero;

    /// <inheritdoc/>
    public SubmitResult Apply(LiveWorld world, in ExternalEvent external, SimTime arrival) => world.Submit(external);
}
