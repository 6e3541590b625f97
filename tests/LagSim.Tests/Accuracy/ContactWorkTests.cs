using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Threading;
using LagSim.Harness.Experiments.Accuracy;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Accuracy;

/// <summary>
/// The scenes of dense contact, in small, and what the methods make of them. Nothing here looks at how long anything took.
/// </summary>
public sealed class ContactWorkTests
{
    private const string Overlap = "deepest_overlap_m";
    private static readonly WorkOptions Short = new() { TimingSeconds = 1e-6, LongestSeconds = 1e9, FewestRuns = 1 };

    [Theory]
    [InlineData("heap", 63, 5)]
    [InlineData("pyramid", 30, 3)]
    [InlineData("shaft", 1000, 5)]
    [InlineData("hopper", 200, 5)]
    public void Scene_HasTheBallsThatItsTitleSays(string name, int balls, int planes)
    {
        WorkScene work = Scene(name);
        Assert.Equal((balls, planes), (work.Scene.Bodies.Count, work.Scene.Planes.Count));
        Assert.Contains($"{balls} balls of r ", work.Title, StringComparison.Ordinal);
        Assert.All(work.Scene.Bodies, body => Assert.True(body.Spec.Friction > 0 && body.Spec.Restitution is > 0 and < 1, body.Name));
        Assert.Equal(work.Name, work.Small.Name);
        Assert.True(work.Small.Scene.Bodies.Count < balls && work.Small.Seconds < work.Seconds);
        Assert.Equal(work.Scene.Hash, Scene(name).Build(MotionLaw.Ballistic, BodySpec.DefaultStep, 0).Hash);
    }

    [Theory]
    [InlineData("heap")]
    [InlineData("hopper")]
    public void LagSim_IsSweptOverTheContactToleranceAlone(string name)
    {
        IWorkMethod[] own = [.. WorkMethods.All.Where(method => method.Engine == "lagsim")];
        IWorkMethod method = Assert.Single(own, method => method.Excludes(Scene(name)) is null);
        WorkSetting[] settings = [.. method.Settings(Scene(name))];
        Assert.Equal(["d=0.1", "d=0.01", "d=0.001", "d=0.0001", "d=0.00001", "d=0.000001"], settings.Select(setting => setting.Text));
        Assert.Equal([1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6], settings.Select(setting => setting.ContactTolerance));

        // The control: where contact is sparse there is one setting.
        Assert.Equal("no step", Assert.Single(method.Settings(Scene("drop"))).Text);
    }

    [Fact]
    public void Build_UnderATolerance_ChangesNothingElse()
    {
        HeapWork heap = new(9, 1);
        Scene coarse = heap.Build(1e-2), fine = heap.Build(1e-5);
        Assert.Equal((1e-2, 1e-5, 1e-3), (coarse.ContactTolerance, fine.ContactTolerance, heap.Scene.ContactTolerance));
        Assert.Equal(3, new[] { coarse.Hash, fine.Hash, heap.Scene.Hash }.Distinct().Count());
        Assert.Equal(heap.Build(1e-3).Hash, heap.Scene.Hash);
    }

    [Fact]
    public void LagSim_OnFewBalls_NeitherOverlapsMuchNorGainsEnergy()
    {
        WorkPoint[] points = [.. Sweep(new HeapWork(20, 1.5), "LagSim Ballistic", 4)];
        Assert.Equal(8, points.Length);
        Assert.All(points, IsWithinTheTolerance);

        // It is the tolerance that holds it: what a coarse one leaves is more than a fine one allows.
        WorkPoint[] overlaps = [.. points.Where(point => point.ErrorKind == Overlap)];
        string all = string.Join("; ", overlaps.Select(point => (point.Setting, point.Error)));
        Assert.True(overlaps.MaxBy(ToleranceOf)!.Error > overlaps.Min(ToleranceOf), all);
    }

    /// <summary>Places in a row are exact, so that it stands from the first instant on.</summary>
    [Fact]
    public void Pyramid_OfLagSim_StandsAsItWasBuilt()
    {
        WorkPoint[] points = [.. Sweep(new PyramidWork(3, 4, 1.2), "LagSim Ballistic", 3)];
        Assert.Equal(12, points.Length);
        Assert.All(points, IsWithinTheTolerance);
    }

    /// <summary>At the step of games a ball is deep in others before anything is seen of it; finer steps help in proportion.</summary>
    [Theory]
    [InlineData("heap", "ODE")]
    [InlineData("heap", "ODE dWorldStep")]
    [InlineData("shaft", "ODE")]
    [InlineData("hopper", "ODE")]
    [InlineData("pyramid", "ODE")]
    [InlineData("pyramid", "ODE dWorldStep")]
    [InlineData("pyramid", "Chipmunk")]
    public void Peer_ThatIsThere_OverlapsByMoreThanAMillimetreAt60Hertz(string scene, string name)
    {
        WorkPoint[] points = [.. Sweep(Scene(scene).Small, ThatIsThere(name).Name, 3).Where(point => point.ErrorKind == Overlap)];
        Assert.Equal(["1/60 s", "1/200 s", "1/1000 s"], points.Select(point => point.Setting));
        Assert.InRange(points[0].Error, 1e-3, 0.125);
        Assert.True(points[2].Error < points[0].Error / 5, $"{points[2]}");
    }

    /// <summary>
    /// Friction is in it: on a slope of 30 degrees a ball of mu 0.3 rolls, and one without slides; both as a textbook has it.
    /// </summary>
    [Theory]
    [InlineData("ODE", 0.3, 5.0 / 7)]
    [InlineData("ODE", 0, 1)]
    [InlineData("Chipmunk", 0.3, 5.0 / 7)]
    [InlineData("Chipmunk", 0, 1)]
    public void Peer_ThatIsThere_HasTheFrictionOfTheScene(string name, double friction, double part)
    {
        IWorkMethod method = ThatIsThere(name);
        Slope slope = new(friction);
        using IWorkRun run = method.Start(slope, method.Settings(slope)[2], TestContext.Current.CancellationToken);
        run.AdvanceTo(1);
        Assert.Equal(part * 9.81 * 0.5, run.Velocity(0).Length, 0.02);
        Assert.Equal(friction > 0 ? part * 9.81 * 0.5 / 0.5 : 0, run.Spin(0).Length, 0.04);
        Assert.True(run.Spin(0).Z <= 1e-6, "down the slope to the right it turns clockwise");
    }

    [Fact]
    public void Ode_OnTheSameScene_IsTheSameEachTime()
    {
        ThatIsThere("ODE");
        double[] errors = [.. Enumerable.Range(0, 3).Select(_ => Sweep(new HeapWork(20, 1), "ODE", 1).First().Error)];
        Assert.Single(errors.Distinct());
    }

    [Fact]
    public void Heaps_AreDrawnByTheSeedAndByNothingElse()
    {
        WorkScene[] heaps = [.. WorkScenes.Draw(7)], again = [.. WorkScenes.Draw(7)], others = [.. WorkScenes.Draw(8)];
        Assert.Equal(8, heaps.Length);
        Assert.Equal(heaps.Select(heap => heap.Scene.Hash), again.Select(heap => heap.Scene.Hash));
        Assert.Equal(17, heaps.Concat(others).Append(Scene("heap")).Select(heap => heap.Scene.Hash).Distinct().Count());
        Assert.DoesNotContain(WorkScenes.All, scene => scene.Name.StartsWith(WorkScenes.Drawn, StringComparison.Ordinal));
        foreach (Scene heap in Enumerable.Range(1, 9).SelectMany(seed => WorkScenes.Draw((ulong)seed)).Select(work => work.Scene))
        {
            BodySpec[] specs = [.. heap.Bodies.Select(body => body.Spec)];
            Assert.InRange(specs.Length, 20, 100);
            Assert.InRange(specs[0].Friction, 0, 1);
            Assert.InRange(specs[0].Restitution, 0, 0.9);
            Assert.InRange(specs.Max(spec => spec.Radius) / specs.Min(spec => spec.Radius), 1, 3);
            Assert.All(specs, spec => Assert.Equal(spec.Mass, Math.Pow(spec.Radius / 0.1, 3), 1e-12));
            Assert.Equal((specs[0].Friction, specs[0].Restitution), (specs[^1].Friction, specs[^1].Restitution));
        }
    }

    [Fact]
    public void Spread_IsTheLeastTheMiddleAndTheGreatestOfThoseDrawn()
    {
        WorkPoint[] points =
        [
            Point("heaps-1", 4, 1), Point("heaps-2", 1, 2), Point("heaps-3", 2, 4), Point("heap", 100, 100),
            Point("heaps-1", 7, 1) with { Setting = "other" }, Point("heaps-2", double.NaN, 1) with { Setting = "other" },
        ];
        WorkSpread[] spread = [.. WorkSpread.Of(points)];
        Assert.Equal(2, spread.Length);
        Assert.Equal((3, new SpreadOf(1, 2, 4), new SpreadOf(0.75, 1.5, 3)), (spread[0].Scenes, spread[0].Error, spread[0].Speed));
        Assert.Equal((2, double.NaN), (spread[1].Scenes, spread[1].Error.Median));
        Assert.Empty(WorkSpread.Of([Point("heap", 1, 1)]));

        static WorkPoint Point(string scene, double error, double cpu) => new(scene, "m", "s", 1, error, Overlap, cpu, 1, 3, 1);
    }

    [Fact]
    public void Run_ThatDoesNotEnd_IsBrokenOffAndLeftOutWithWhatIsFiner()
    {
        WorkReport report = WorkSweep.Run(
            [new HeapWork(5, 0.1)], [new Endless()], Short with { LongestSeconds = 2 }, null, TestContext.Current.CancellationToken);
        Assert.Equal(
            "heap: endless at d=0.01 and finer is left out: a run was not done after 60 s, and 2 s a run are allowed.",
            Assert.Single(report.LeftOut));
        Assert.Equal(["d=0.1"], report.Points.Select(point => point.Setting).Distinct());
        Assert.Null(report.StoppedAt);
    }

    /// <summary>A length by the contact tolerance of its setting, energy by a hundredth.</summary>
    private static void IsWithinTheTolerance(WorkPoint point) => Assert.InRange(
        point.Error, 0,
        point.ErrorKind == "energy_gained_relative" ? 1e-2 : ToleranceOf(point));

    private static double ToleranceOf(WorkPoint point) => double.Parse(point.Setting[2..], CultureInfo.InvariantCulture);

    private static IEnumerable<WorkPoint> Sweep(WorkScene scene, string method, int settings) => WorkSweep.Run(
        [scene], [Method(method)], Short with { MaxSettings = settings }, null, TestContext.Current.CancellationToken).Points;

    private static WorkScene Scene(string name) =>
        WorkScenes.TryGet(name, out WorkScene? found) ? found : throw new ArgumentException(name);

    private static IWorkMethod Method(string name) => WorkMethods.All.Single(method => method.Name == name);

    /// <summary>The method, of an engine that is on this machine; the test is skipped where it is not.</summary>
    private static IWorkMethod ThatIsThere(string name)
    {
        IWorkMethod method = Method(name);
        Assert.SkipWhen(method.Missing is not null, method.Missing ?? "");
        return method;
    }

    /// <summary>A ball of r 0.5 m starts on a slope of 30 degrees.</summary>
    private sealed class Slope(double friction) : ContactWork
    {
        public override string Name => "slope";

        public override string Title => "a ball on a slope";

        public override IReadOnlyList<string> ErrorKinds { get; } = [Overlap];

        public override (double X, double Y)? Flat(in Vector3D v, int body) => (v.X, v.Y);

        private protected override SceneBuilder Begin()
        {
            Vector3D normal = new(0.5, Math.Sqrt(0.75), 0);
            return new SceneBuilder(Name).AddPlane("slope", normal, 0.0)
                .AddBody("ball", new BodySpec(0.5, 1, 0.2, friction: friction), normal * 0.5000001);
        }
    }

    /// <summary>Waits at its second setting until it is told to stop, which is at once: the clock is not waited for.</summary>
    private sealed class Endless : IWorkMethod
    {
        public string Name => "endless";

        public string Engine => "endless";

        public string? Missing => null;

        public string? Excludes(WorkScene scene) => null;

        public IReadOnlyList<WorkSetting> Settings(WorkScene scene) => Method("LagSim Ballistic").Settings(scene);

        public IWorkRun Start(WorkScene scene, WorkSetting setting, CancellationToken cancellation) =>
            setting.ContactTolerance > 0.05 ? Method("LagSim Ballistic").Start(scene, setting, cancellation)
            : throw new OperationCanceledException("Its time is up.");
    }
}
