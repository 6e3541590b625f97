using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Linq;

namespace LagSim.Harness.Verification.Hard;

/// <summary>The catalogue of hard cases. A new case is one file and one line here.</summary>
public static class HardCases
{
    /// <summary>All cases, in the order of the catalogue.</summary>
    public static IReadOnlyList<IHardCase> All { get; } =
    [
        new DropCase(),
        new ElasticBounceCase(),
        new LinearDragCase(),
        new QuadraticDragCase(),
        new OrderCase(),
        new OscillatorCase(),
        new SpringCase(),
        new StiffCase(),
        new KeplerCase(),
        new MagneticCase(),
        new SuppliedCase(),
        new RollingCase(),
        new ObliqueCase(),
        new MassChainCase(),
        new SimultaneousCase(),
        new BoxReversalCase(),
        new GalperinCase(),
        new GrazeCase(),
        new CrossingCase(),
        new SmallFastCase(),
        new FarCase(),
        new RestCase(),
        new DomeCase(),
        new GrooveCase(),
        new HeapCase(),
        new ArchCase(),
        new JamCase(),
        new ColumnCase(),
        new IslandEnergyCase(),
        new ContactEntryCase(),
        new HardSphereGasCase(),
        new HaffCase(),
        new CollapseCase(),
        new EventOrderCase(),
        new ScalesCase(),
        new BadInputCase(),
    ];

    /// <summary>Returns the case of a name.</summary>
    public static bool TryGet(string name, [NotNullWhen(true)] out IHardCase? found)
    {
        found = All.FirstOrDefault(c => c.Name == name);
        return found is not null;
    }

    /// <summary>Runs some cases, one after the other.</summary>
    /// <param name="cases">The cases.</param>
    /// <param name="scale">The scale of the sizes.</param>
    /// <param name="seed">The seed of random numbers.</param>
    /// <param name="areControls">Whether to run the deliberately wrong methods instead of the engine.</param>
    /// <param name="progress">Called with the number of finished cases, including the fraction of the current one, and its name.</param>
    /// <param name="cancellation">Ends it early, with the rows of the cases that were done by then; the one in progress is given
    /// up.</param>
    /// <returns>The rows in the order of the cases.</returns>
    public static IReadOnlyList<HardRow> Run(
        IReadOnlyList<IHardCase> cases, HardScale scale, ulong seed, bool areControls = false, Action<double, string>? progress = null,
            System.Threading.CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(cases);
        List<HardRow> rows = [];
        for (int n = 0; n < cases.Count; n++)
        {
            IHardCase one = cases[n];
            int done = n;
            try
            {
                progress?.Invoke(done, one.Name);
                HardContext context = new(scale, seed, part => progress?.Invoke(done + part, one.Name), cancellation);
                rows.AddRange([.. areControls ? one.Controls(context) : one.Rows(context)]);
            }
            catch (OperationCanceledException) when (cancellation.IsCancellationRequested)
            {
                break; // the finished cases are reported
            }
        }

        return rows;
    }
}
