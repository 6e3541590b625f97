using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy.Engines;

/// <summary>
/// A physics engine or integrator with steps of equal length, which are swept. A new one needs a name and a <see cref="Run"/> that steps
/// it.
/// </summary>
internal abstract class SteppedEngine : IWorkMethod
{
    public abstract string Name { get; }

    public abstract string Engine { get; }

    public virtual string? Missing => null;

    public virtual string? Excludes(WorkScene scene) => null;

    public IReadOnlyList<WorkSetting> Settings(WorkScene scene) => [.. Rates(scene).Select(WorkSetting.Rate)];

    public IWorkRun Start(WorkScene scene, WorkSetting setting, CancellationToken cancellation)
    {
        Run run = Begin(scene, setting.StepSeconds);
        run.Cancellation = cancellation;
        return run;
    }

    /// <summary>The step rates to sweep, in steps per second, from coarse to fine.</summary>
    protected virtual IReadOnlyList<double> Rates(WorkScene scene) => scene.EngineRates;

    /// <summary>Builds a world of the scene.</summary>
    protected abstract Run Begin(WorkScene scene, double step);

    /// <summary>A world of the engine, step by step.</summary>
    internal abstract class Run(WorkScene work, double step) : IWorkRun
    {
        protected WorkScene Work { get; } = work;

        protected Scene Scene { get; } = work.Scene;

        /// <summary>The length of a step in seconds.</summary>
        protected double StepSeconds { get; } = step;

        public double Seconds => Events * StepSeconds;

        public long Events { get; private set; }

        /// <summary>Ends the run between two steps.</summary>
        internal CancellationToken Cancellation { get; set; }

        public void AdvanceTo(double seconds)
        {
            for (long end = (long)Math.Round(seconds / StepSeconds); Events < end; Events++)
            {
                Cancellation.ThrowIfCancellationRequested();
                Step();
            }
        }

        public abstract Vector3D Position(int body);

        public abstract Vector3D Velocity(int body);

        public virtual Vector3D Spin(int body) => Vector3D.Zero;

        public abstract void Dispose();

        /// <summary>One step.</summary>
        protected abstract void Step();

        /// <summary>Returns the force besides gravity on a body at the beginning of the step, in newtons.</summary>
        protected Vector3D Force(int body)
        {
            double mass = Scene.Bodies[body].Spec.Mass;
            return Work.Push(mass, Seconds, Position(body), Velocity(body)) * mass;
        }

        /// <summary>
        /// Returns the friction of a ball at a surface by LagSim's rule, the lesser of the two. All balls of a scene have the same.
        /// </summary>
        protected double FrictionAt(StaticPlane plane) => Math.Min(plane.Friction, Scene.Bodies[0].Spec.Friction);

        /// <summary>
        /// Returns the restitution of a ball at a surface by LagSim's rule, the lesser of the two. All balls of a scene have the same.
        /// </summary>
        protected double RestitutionAt(StaticPlane plane) => Math.Min(plane.Restitution, Scene.Bodies[0].Spec.Restitution);
    }
}
