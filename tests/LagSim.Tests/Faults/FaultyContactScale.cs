using LagSim.Contacts;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Tests.Faults;

/// <summary>A scale by which impacts end at those that they strike, or strike what closes however slowly.</summary>
internal sealed class FaultyContactScale(Scene scene) : ContactScale(scene.ContactTolerance, scene.Gravity, SimTime.Zero)
{
    /// <summary>An impact does not go on from those that it strikes.</summary>
    internal bool CutsImpactsShort { get; init; }

    /// <summary>Contacts are struck that close as slowly as impacts leave them.</summary>
    internal bool StrikesWhatIsSlow { get; init; }

    internal override double ReachSpeed => CutsImpactsShort ? double.MaxValue : base.ReachSpeed;

    private protected override double ImpactPart => StrikesWhatIsSlow ? 0 : base.ImpactPart;
}
