using LagSim.Contacts;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Tests.Faults;

/// <summary>
/// A scale by which impacts end at those that they strike, or strike what closes however slowly; or by which deep overlap is pushed out no
/// faster than shallow.
/// </summary>
internal sealed class FaultyContactScale(Scene scene) : ContactScale(scene.ContactTolerance, scene.Gravity, SimTime.Zero)
{
    /// <summary>An impact does not go on from those that it strikes.</summary>
    internal bool CutsImpactsShort { get; init; }

    /// <summary>Contacts are struck that close as slowly as impacts leave them.</summary>
    internal bool StrikesWhatIsSlow { get; init; }

    /// <summary>What is deep is pushed out as slowly as what is not.</summary>
    internal bool PushesSlowly { get; init; }

    internal override double DeepSpeed(double depth, double seconds) => PushesSlowly ? Pull * seconds : base.DeepSpeed(depth, seconds);

    internal override double ReachSpeed => CutsImpactsShort ? double.MaxValue : base.ReachSpeed;

    private protected override double ImpactPart => StrikesWhatIsSlow ? 0 : base.ImpactPart;
}
