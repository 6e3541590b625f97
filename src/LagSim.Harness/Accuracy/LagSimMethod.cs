using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Accuracy;

/// <summary>LagSim with one of its laws of flight.</summary>
internal sealed class LagSimMethod(MotionLaw law) : IWorkMethod
{
    internal const string EngineName = "lagsim";

    private Built? last;

    public string Name => $"LagSim {law}";

    public string Engine => EngineName;

    public string? Missing => null;

    private bool IsClosedForm => law == MotionLaw.Ballistic;

    public string? Excludes(WorkScene scene) => IsClosedForm && scene.Force is not null ? "it is exact for gravity alone, and a force acts here" : null;

    public IReadOnlyList<WorkSetting> Settings(WorkScene scene) => IsClosedForm ? [WorkSetting.None]
        : [.. scene.IntegratorRates.Append(2 * scene.IntegratorRates[^1]).Select(WorkSetting.Rate)];

    public IWorkRun Start(WorkScene scene, WorkSetting setting) => new Run(IsClosedForm ? scene.Scene : Build(scene, setting.StepSeconds));

    /// <summary>The scene is given, as it is to the other engines: that it was built is not part of a run.</summary>
    private Scene Build(WorkScene scene, double step)
    {
        Built? kept = last;
        if (kept is null || kept.Work != scene || kept.Step != step)
        {
            last = kept = new Built(scene, step, scene.Build(law, SimDuration.FromSeconds(step)));
        }

        return kept.Scene;
    }

    private sealed record Built(WorkScene Work, double Step, Scene Scene);

    /// <summary>A simulation that keeps the default second of history, as one of a game without a session does.</summary>
    internal sealed class Run(Scene scene) : IWorkRun
    {
        private readonly Simulation simulation = new(scene);

        public double Seconds => simulation.SimulatedTo.ToSeconds();

        public long Events => simulation.EventsProcessed;

        public void AdvanceTo(double seconds) => simulation.AdvanceTo(SimTime.FromSeconds(seconds));

        public Vector3D Position(int body) => State(body).Position;

        public Vector3D Velocity(int body) => State(body).Velocity;

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
