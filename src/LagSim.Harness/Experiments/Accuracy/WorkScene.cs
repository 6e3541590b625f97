using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>
/// A scene of the work-precision diagrams, with its measure of error. A new one is one file and one line in <see cref="WorkScenes"/>.
/// </summary>
public abstract partial class WorkScene
{
    /// <summary>The interval of samples. A method with steps is sampled on its own steps.</summary>
    private const int Samples = 600;

    private Scene? scene;

    /// <summary>The name on the command line.</summary>
    public abstract string Name { get; }

    /// <summary>A description, in a line.</summary>
    public abstract string Title { get; }

    /// <summary>The reference of the results.</summary>
    public abstract string Reference { get; }

    /// <summary>The simulated time, in seconds.</summary>
    public abstract double Seconds { get; }

    /// <summary>The kinds of error that are measured; the first is the one that diagrams show.</summary>
    public abstract IReadOnlyList<string> ErrorKinds { get; }

    /// <summary>An error of this size is rounding: no order is read from what is below a hundred times it.</summary>
    public abstract double Floor { get; }

    /// <summary>The size below which an error may be rounding: no order is measured below it.</summary>
    public double Rounding => 100 * Floor;

    /// <summary>An error of this size is no result: no order is read from what is above a tenth of it.</summary>
    public abstract double Ceiling { get; }

    /// <summary>The steps a second of LagSim's Runge-Kutta law and of other integrators, from coarse to fine.</summary>
    public virtual IReadOnlyList<double> IntegratorRates => [15, 30, 60, 120, 240, 480, 960];

    /// <summary>The steps a second of engines.</summary>
    public virtual IReadOnlyList<double> EngineRates => [60, 200, 1000, 5000, 10_000];

    /// <summary>A force besides gravity; null for none.</summary>
    public virtual Force? Acting => null;

    /// <summary>Whether bodies meet each other, not only planes.</summary>
    public virtual bool HasPairs => false;

    /// <summary>A smaller version of the scene, for a quick look; itself where it is small enough.</summary>
    public virtual WorkScene Small => this;

    /// <summary>Returns the scene with the motion law that the world picks.</summary>
    public Scene Scene => scene ??= Build(MotionLaw.Automatic, BodySpec.DefaultStep, BodySpec.DefaultTolerance);

    /// <summary>Returns the scene with a motion law, and its step or tolerance.</summary>
    public abstract Scene Build(MotionLaw law, SimDuration step, double tolerance);

    /// <summary>Returns the position of a body in the plane of a two-dimensional engine; null if the scene is not plane.</summary>
    public virtual (double X, double Y)? Flat(in Vector3D v, int body) => null;

    /// <summary>Returns the direction of a surface's normal in that plane; zero for a surface that bodies never leave.</summary>
    public virtual (double X, double Y) FlatNormal(in Vector3D normal) => (normal.X, normal.Y);

    /// <summary>Converts back from the plane.</summary>
    public virtual Vector3D Unflat(double x, double y, int body) => new(x, y, 0);

    /// <summary>Returns the acceleration of a body by the force besides gravity, for engines that take forces; zero for none.</summary>
    internal Vector3D Push(double mass, double seconds, in Vector3D position, in Vector3D velocity) =>
        Acting is null ? Vector3D.Zero : Acting.At(mass, seconds, position, velocity, Vector3D.Zero);

    /// <summary>Begins to record a run.</summary>
    protected abstract IWatch Watch();

    /// <summary>Runs the scene and measures; returns one error for each kind, NaN where it is not finite.</summary>
    internal IReadOnlyList<double> Measure(IWorkRun run)
    {
        IWatch watch = Watch();
        double last = -1;
        for (int n = 0; n <= Samples; n++)
        {
            run.AdvanceTo(Seconds * n / Samples);
            if (run.Seconds > last)
            {
                watch.Look(run);
                last = run.Seconds;
            }
        }

        return watch.Errors(run);
    }

    /// <summary>The records of a run.</summary>
    protected interface IWatch
    {
        /// <summary>Takes a sample of the run.</summary>
        void Look(IWorkRun run);

        /// <summary>Returns the errors at the end, one for each kind.</summary>
        IReadOnlyList<double> Errors(IWorkRun run);
    }
}
