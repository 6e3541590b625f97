using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Harness.Experiments.Accuracy;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Accuracy;

/// <summary>What the methods reach on the scenes. Nothing here looks at how long anything took.</summary>
public sealed class WorkSweepTests
{
    private static readonly WorkOptions Short = new() { TimingSeconds = 1e-6, LongestSeconds = 1e9, FewestRuns = 1 };

    [Theory]
    [InlineData("drop", 1e-11)]
    [InlineData("elastic49", 1e-12)]
    [InlineData("gas", 1e-9)]
    [InlineData("billiards", 1e-9)]
    public void ClosedForm_IsExactToRounding(string scene, double bound)
    {
        WorkPoint[] points = Sweep(scene, "LagSim Ballistic", 1);
        Assert.All(points, point => Assert.True(point.Error <= bound, $"{point}"));
        Assert.Equal(Scene(scene).ErrorKinds, points.Select(point => point.ErrorKind));
    }

    [Theory]
    [InlineData("spring")]
    [InlineData("drag")]
    [InlineData("kepler")]
    public void RungeKutta4_OnItsSteps_HasOrderFour(string scene)
    {
        WorkOrder order = Order(scene, Method("LagSim RungeKutta4"));
        Assert.True(IsFour(order), $"{order}");
        Assert.Equal(WorkOrder.Most, order.Points);
    }

    [Theory]
    [InlineData("spring")]
    [InlineData("drag")]
    public void SemiImplicitEuler_IsSeenNotToHaveOrderFour(string scene)
    {
        WorkOrder order = Order(scene, new SemiImplicitEuler());
        Assert.False(IsFour(order), $"{order}");
        Assert.InRange(order.Slope, 0.7, 1.3);
    }

    [Theory]
    [InlineData("ode", "ODE", 0.32)]
    [InlineData("chipmunk", "Chipmunk", 0.49)]
#if WITH_PEERS
    [InlineData("jitter", "Jitter2", 0.50)]
    [InlineData("box2d", "Box2D.NET", 0.38)]
    [InlineData("bepu", "BepuPhysics", 1.3)]
#endif
    public void Peer_ThatIsThere_DropsAsItWasMeasuredBefore(string engine, string name, double published)
    {
        Assert.Equal(engine, ThatIsThere(name).Engine);
        WorkPoint[] points = Sweep("drop", name, 3);
        Assert.InRange(points[0].Error, 0.9 * published, 1.1 * published);
        Assert.True(points[2].Error < points[0].Error / (engine == "bepu" ? 3 : 5), $"{points[2]}"); // 1/1000 s; springs are of order one half
        Assert.Equal([180, 600, 3000], points.Select(point => point.Events));
    }

    [Theory]
    [InlineData("kepler", "ODE", 3)]
    [InlineData("kepler", "Chipmunk", 3)]
    [InlineData("spring", "ODE", 3)]
    [InlineData("spring", "Chipmunk", 3)]
    [InlineData("gas", "ODE", 1)]
    [InlineData("billiards", "Chipmunk", 1)]
#if WITH_PEERS
    [InlineData("kepler", "Jitter2", 3)]
    [InlineData("kepler", "BepuPhysics", 3)]
    [InlineData("kepler", "Box2D.NET", 3)]
    [InlineData("spring", "Jitter2", 3)]
    [InlineData("spring", "BepuPhysics", 3)]
    [InlineData("spring", "Box2D.NET", 3)]
    [InlineData("drag", "Jitter2", 3)]
    [InlineData("drag", "Box2D.NET", 2)]
    [InlineData("elastic49", "Jitter2", 2)]
    [InlineData("gas", "Jitter2", 1)]
    [InlineData("gas", "BepuPhysics", 1)]
#endif
    public void Peer_ThatIsThere_MovesAsTheSceneSays(string scene, string name, int settings)
    {
        ThatIsThere(name);
        WorkPoint[] points = [.. Sweep(scene, name, settings).Where(point => point.ErrorKind == Scene(scene).ErrorKinds[0])];
        Assert.All(points, point => Assert.InRange(point.Error, 1e-6, 0.5));
        // the force acts, on the places of the step
        Assert.All(points.Skip(1).Zip(points), pair => Assert.True(pair.First.Error < 0.6 * pair.Second.Error, $"{pair}"));
    }

#if WITH_PEERS
    [Fact]
    public void Jitter2_WhichTakesTheGreaterRestitution_IsLeftOutWhereWallsHaveLess() =>
        Assert.Contains("walls have less", Method("Jitter2").Excludes(Scene("billiards")), StringComparison.Ordinal);
#else
    [Theory]
    [InlineData("Jitter2", "Jitter2.Double")]
    [InlineData("BepuPhysics", "BepuPhysics")]
    [InlineData("Box2D.NET", "Box2D.NET")]
    public void EngineThatIsNotInTheBuild_IsNamedWithTheSwitchAndThePackageItNeeds(string name, string package)
    {
        WorkReport report = Run([Scene("drop")], [Method(name)]);
        Assert.Equal($"{name} is left out: it is not in this build; -p:WithPeers=true builds it in and needs the package {package}.", Assert.Single(report.LeftOut));
        Assert.Empty(report.Points);
    }
#endif

    [Fact]
    public void MathNet_ThroughContacts_IsAsExactAsItsMethod()
    {
        WorkPoint[] drop = Sweep("drop", "MathNet RungeKutta4", 2), elastic = Sweep("elastic49", "MathNet RungeKutta4", 1);
        Assert.All([.. drop, .. elastic], point => Assert.True(point.Error <= 1e-12, $"{point}"));
    }

    [Fact]
    public void WhatIsLeftOut_IsSaidWithItsReason()
    {
        WorkReport report = Run(
            [Scene("drag"), Scene("billiards")], [Method("LagSim Ballistic"), Method("MathNet RungeKutta4"), new Absent()], Short with { MaxSettings = 1 });
        Assert.Equal(
            [
                "absent is left out: nobody has it.",
                "drag: LagSim Ballistic is left out: it is exact for gravity alone, and a force acts here.",
                "billiards: MathNet RungeKutta4 is left out: it is an integrator; contacts of bodies with each other are not in it.",
            ],
            report.LeftOut);
        WorkReport hurried = Run([Scene("spring")], [Method("LagSim RungeKutta4")], Short with { LongestSeconds = 1e-12 });
        Assert.Single(hurried.Points);
        Assert.Contains("spring: LagSim RungeKutta4 at 1/20 s and finer is left out: it would take about ", Assert.Single(hurried.LeftOut),
            StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("elastic49", "LagSim Ballistic")]
    [InlineData("spring", "LagSim RungeKutta4")]
    [InlineData("elastic49", "MathNet RungeKutta4")]
    [InlineData("drop", "ODE")]
    [InlineData("drop", "Chipmunk")]
    public void Run_AskedToStop_EndsBetweenTwoSteps(string scene, string name)
    {
        IWorkMethod method = ThatIsThere(name);
        using CancellationTokenSource stop = new();
        using IWorkRun run = method.Start(Scene(scene), method.Settings(Scene(scene))[0], stop.Token);
        run.AdvanceTo(Scene(scene).Seconds / 2);
        long before = run.Events;
        stop.Cancel();
        Assert.Throws<OperationCanceledException>(() => run.AdvanceTo(Scene(scene).Seconds));
        Assert.InRange(run.Events, before, before + 1);
    }

    private static bool IsFour(WorkOrder order) => Math.Abs(order.Slope - 4) <= 0.1;

    private static WorkReport Run(WorkScene[] scenes, IWorkMethod[] methods, WorkOptions? options = null) =>
        WorkSweep.Run(scenes, methods, options ?? Short, null, TestContext.Current.CancellationToken);

    private static WorkOrder Order(string scene, IWorkMethod method) => Assert.Single(Run([Scene(scene)], [method]).Orders);

    private static WorkPoint[] Sweep(string scene, string method, int settings) =>
        [.. Run([Scene(scene)], [Method(method)], Short with { MaxSettings = settings }).Points];

    private static WorkScene Scene(string name) => WorkScenes.TryGet(name, out WorkScene? found) ? found : throw new ArgumentException(name);

    /// <summary>The method, of an engine that is on this machine; the test is skipped where it is not.</summary>
    private static IWorkMethod ThatIsThere(string name)
    {
        IWorkMethod method = Method(name);
        Assert.SkipWhen(method.Missing is not null, method.Missing ?? "");
        return method;
    }

    private static IWorkMethod Method(string name) => WorkMethods.All.Single(method => method.Name == name);

    /// <summary>The velocity first, then the place with it, and contacts at the ends of steps: what most engines do.</summary>
    private sealed class SemiImplicitEuler : IWorkMethod
    {
        public string Name => "semi-implicit Euler";

        public string Engine => "euler";

        public string? Missing => null;

        public string? Excludes(WorkScene scene) => null;

        public IReadOnlyList<WorkSetting> Settings(WorkScene scene) =>
            [.. new[] { 100.0, 200, 400, 800, 1600, 3200 }.Select(rate => new WorkSetting("step", 1 / rate))];

        public IWorkRun Start(WorkScene scene, WorkSetting setting, CancellationToken cancellation) => new Run(scene, setting.StepSeconds);

        private sealed class Run(WorkScene scene, double step) : IWorkRun
        {
            private Vector3D x = scene.Scene.Bodies[0].Position;
            private Vector3D v = scene.Scene.Bodies[0].Velocity;

            public double Seconds => Events * step;

            public long Events { get; private set; }

            public void AdvanceTo(double seconds)
            {
                BodySpec spec = scene.Scene.Bodies[0].Spec;
                for (long end = (long)Math.Round(seconds / step); Events < end; Events++)
                {
                    v += (scene.Scene.Gravity + scene.Push(spec.Mass, Seconds, x, v)) * step;
                    x += v * step;
                    if (scene.Scene.Planes.Count > 0 && x.Y < spec.Radius && v.Y < 0)
                    {
                        v = new Vector3D(v.X, -spec.Restitution * v.Y, v.Z);
                    }
                }
            }

            public Vector3D Position(int body) => x;

            public Vector3D Velocity(int body) => v;

            public void Dispose()
            {
            }
        }
    }

    private sealed class Absent : IWorkMethod
    {
        public string Name => "absent";

        public string Engine => "absent";

        public string? Missing => "nobody has it";

        public string? Excludes(WorkScene scene) => null;

        public IReadOnlyList<WorkSetting> Settings(WorkScene scene) => throw new InvalidOperationException("It is not there.");

        public IWorkRun Start(WorkScene scene, WorkSetting setting, CancellationToken cancellation) => throw new InvalidOperationException("It is not there.");
    }
}
