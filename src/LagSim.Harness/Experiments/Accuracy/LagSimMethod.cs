using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>LagSim with one of its motion laws.</summary>
/// <param name="law">The law.</param>
/// <param name="hasFixedSteps">Whether steps are swept instead of tolerances, where the law has both.</param>
internal sealed class LagSimMethod(MotionLaw law, bool hasFixedSteps = false) : IWorkMethod
{
    internal const string EngineName = "lagsim";

    private static readonly double[] ContactTolerances = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

    private static readonly double[] Tolerances = [1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14];

    private Built? last;

    public string Name => $"LagSim {law}{(hasFixedSteps && law == MotionLaw.DormandPrince54 ? ", fixed steps" : "")}";

    public string Engine => EngineName;

    public string? Missing => null;

    public string? Excludes(WorkScene scene) => law switch
    {
        not MotionLaw.Ballistic when scene is ContactWork =>
            "what is in contact goes by contact steps whatever the law of flight; their tolerance is swept instead",
        MotionLaw.Ballistic when scene.Acting is not null => "it is exact for gravity alone, and a force acts here",
        MotionLaw.ClosedForm or MotionLaw.DormandPrince54 when scene.Acting is null => "gravity alone acts here, for which Ballistic is exact",
        _ => null,
    };

    public IReadOnlyList<WorkSetting> Settings(WorkScene scene) => law switch
    {
        MotionLaw.Ballistic when scene is ContactWork => [.. ContactTolerances.Select(WorkSetting.Contact)],
        MotionLaw.Ballistic => [WorkSetting.None],
        _ when hasFixedSteps => [.. scene.IntegratorRates.Append(2 * scene.IntegratorRates[^1]).Select(WorkSetting.Rate)],
        _ => [.. Tolerances.Select(WorkSetting.Within)],
    };

    public IWorkRun Start(WorkScene scene, WorkSetting setting, CancellationToken cancellation)
    {
        Built built = Build(scene, setting, cancellation);
        return new Run(built.Scene, built.Options);
    }

    /// <summary>The scene is given, as it is to the other engines; building it is no part of a run.</summary>
    private Built Build(WorkScene scene, WorkSetting setting, CancellationToken cancellation)
    {
        Built? kept = last;
        if (kept is null || kept.Work != scene || kept.Setting != setting || kept.Options.Cancellation != cancellation)
        {
            SimDuration step = double.IsNaN(setting.StepSeconds) ? BodySpec.DefaultStep : SimDuration.FromSeconds(setting.StepSeconds);
            double tolerance = double.IsNaN(setting.Tolerance) ? 0 : setting.Tolerance;
            Scene built = scene is ContactWork contact && setting.ContactTolerance > 0 ? contact.Build(setting.ContactTolerance)
                : scene.Build(law, step, tolerance);
            last = kept = new Built(scene, setting, built, new SimulationOptions(cancellation: cancellation));
        }

        return kept;
    }

    private sealed record Built(WorkScene Work, WorkSetting Setting, Scene Scene, SimulationOptions Options);

    /// <summary>A simulation with the default second of history, as in a game without a session.</summary>
    internal sealed class Run(Scene scene, SimulationOptions options) : IWorkRun
    {
        private readonly Simulation simulation = new(scene, options);

        public double Seconds => simulation.SimulatedTo.ToSeconds();

        public long Events => simulation.EventsProcessed;

        public void AdvanceTo(double seconds) => simulation.AdvanceTo(SimTime.FromSeconds(seconds));

        public Vector3D Position(int body) => State(body).Position;

        public Vector3D Velocity(int body) => State(body).Velocity;

        public Vector3D Spin(int body) => State(body).Spin;

        public void Dispose()
        {
        }

        private BodyState State(int body)
        {
            simulation.TryRead(BodyId.OfScene(body), simulation.SimulatedTo, out BodyState state);
            return state;
        }
    }
}
