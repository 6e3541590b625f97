using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>
/// A scene of dense contact: balls with friction that fall onto each other, or that should stand. LagSim's contact tolerance is swept.
/// </summary>
/// <remarks>
/// The final positions have no reference, since a heap magnifies errors. Measured instead is what holds of any right answer: hard balls do
/// not overlap, energy does not come from nothing, and what has come to rest stays.
/// </remarks>
internal abstract class ContactWork : WorkScene
{
    internal const string Overlap = "deepest_overlap_m";
    internal const string EnergyGain = "energy_gained_relative";
    internal const string Drift = "drift_at_rest_m";
    internal const string Moved = "moved_from_start_m";

    private const double RestSeconds = 1;

    public override double Seconds => 3;

    public override string Reference => "hard balls do not overlap, and energy does not come from nothing";

    public override double Floor => 1e-14;

    public override double Ceiling => 0.1;

    public override bool HasPairs => true;

    public override IReadOnlyList<double> EngineRates => [60, 200, 1000, 5000];

    public sealed override Scene Build(MotionLaw law, SimDuration step, double tolerance) => Begin().Build();

    /// <summary>Returns the scene with a contact tolerance, in metres.</summary>
    internal Scene Build(double contactTolerance) => Begin().WithContactTolerance(contactTolerance).Build();

    /// <summary>Returns the scene, ready to build.</summary>
    private protected abstract SceneBuilder Begin();

    /// <inheritdoc/>
    protected override IWatch Watch() => new Contacts(Scene, ErrorKinds, Seconds);

    private sealed class Contacts(Scene scene, IReadOnlyList<string> kinds, double seconds) : IWatch
    {
        private readonly OverlapWatch overlap = new(scene);
        private readonly EnergyGainWatch gain = new(scene);
        private readonly DriftWatch drift = new(scene, seconds - RestSeconds);
        private readonly DriftWatch moved = new(scene, 0);

        public void Look(IWorkRun run)
        {
            overlap.Look(run);
            gain.Look(run);
            drift.Look(run);
            moved.Look(run);
        }

        public IReadOnlyList<double> Errors(IWorkRun run) => [.. kinds.Select(Of)];

        private double Of(string kind) => kind switch
        {
            Overlap => overlap.Worst,
            EnergyGain => gain.Worst,
            Drift => drift.Worst,
            Moved => moved.Worst,
            _ => throw new ArgumentException($"Nobody watches '{kind}'.", nameof(kind)),
        };
    }
}
