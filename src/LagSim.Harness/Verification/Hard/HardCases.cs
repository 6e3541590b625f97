using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Linq;

namespace LagSim.Harness.Verification.Hard;

/// <summary>The catalogue of hard cases. A new case is one file and one line here.</summary>
public static class HardCases
{
    /// <summary>All of them, in the order of the catalogue.</summary>
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
        new HardSphereGasCase(),
        new HaffCase(),
        new CollapseCase(),
        new EventOrderCase(),
        new ScalesCase(),
        new BadInputCase(),
    ];

    /// <summary>The case of that name.</summary>
    public static bool TryGet(string name, [NotNullWhen(true)] out IHardCase? found)
    {
        found = All.FirstOrDefault(c => c.Name == name);
        return found is not null;
    }

    /// <summary>Runs some cases, one after the other.</summary>
    /// <param name="cases">Which.</param>
    /// <param name="scale">How large the sizes are.</param>
    /// <param name="seed">The luck of what is drawn.</param>
    /// <param name="areControls">Whether to run the deliberately wrong methods in place of the engine.</param>
    /// <param name="progress">Is told how many cases are done, with the part of the one at hand, and its name.</param>
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
                break; // what was done is reported
            }
        }

        return rows;
    }
}
