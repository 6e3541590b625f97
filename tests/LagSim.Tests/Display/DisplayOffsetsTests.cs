using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Display;
using LagSim.Scenes;
using LagSim.Tests.Api;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Display;

/// <summary>What the eye sees of a heal: nothing jumps, all comes right, and nothing is drawn inside another thing for it.</summary>
public sealed class DisplayOffsetsTests
{
    private static readonly Scene Alone = new SceneBuilder("alone").WithGravity(Floating).AddBody("ball", Ball(), V(0, 5)).Build();

    [Fact]
    public void Update_MotionBouncesAndOnesOwnActions_AreNoCorrections()
    {
        Screen screen = new(Drop(3, 0.9, MotionLaw.RungeKutta4));
        for (int n = 0; n < 600; n++)
        {
            double now = n / 60.0;
            if (n % 50 == 20)
            {
                screen.Publish(now);
                screen.Do(now, n % 100 == 20 ? PlayerAction.Impulse(First, V(1, 2)) : PlayerAction.Teleport(First, V(0, 4)));
            }

            screen.Frame(now);
            DrawnBody drawn = screen.Drawn(First);
            Assert.Equal((0, 0, 0), (drawn.Jump, drawn.Decay, drawn.Dropped));
            Assert.Equal(drawn.State.Position, drawn.Position);
        }

        Assert.Equal(0, screen.Offsets.Corrections);
    }

    [Fact]
    public void Update_LateEvent_JumpIsWhatItChangedAtTheLastFramesTimeAndIsNotSeen()
    {
        Screen screen = new(Alone);
        screen.Frame(1);
        screen.Do(0.9, PlayerAction.SetVelocity(First, V(2)));
        screen.Frame(1.02);
        DrawnBody drawn = screen.Drawn(First);
        Assert.Equal(0.2, drawn.Jump, 1e-10); // an instant is a whole number of ticks
        Assert.Equal(0.24, drawn.State.Position.X, 1e-10); // the world is where it is
        double timeConstant = 0.08 + (0.22 * (0.2 - 0.05) / 0.95);
        Assert.Equal(-0.2 * Math.Exp(-0.02 / timeConstant), drawn.Offset.X, 1e-9);
        Assert.Equal(drawn.Jump - drawn.Offset.Length, drawn.Decay, 1e-12);
        Assert.Equal(0, drawn.Dropped);
        Assert.Equal((1, drawn.Jump), (screen.Offsets.Corrections, screen.Offsets.LargestJump));

        screen.Frame(1.03); // a new render snapshot that says the same
        Assert.Equal(0, screen.Drawn(First).Jump);
        Assert.Equal(1, screen.Offsets.Corrections);
    }

    [Fact]
    public void Update_EventLaterThanTheLastFrame_IsNoCorrection()
    {
        Screen screen = new(Alone);
        screen.Frame(1);
        screen.Do(1.01, PlayerAction.SetVelocity(First, V(2)));
        screen.Frame(1.02);
        Assert.Equal((0, 0.02), (screen.Drawn(First).Jump, Math.Round(screen.Drawn(First).Position.X, 9)));
    }

    [Theory]
    [InlineData(0.03)]
    [InlineData(0.4)]
    [InlineData(4)] // above the size at which the largest speed counts
    public void Update_AnyFrameRate_DecaysAlongTheSameCurve(double size)
    {
        double[][] curves = new[] { 30, 60, 144 }.Select(hertz => Curve(size, hertz)).ToArray();
        Assert.True(Difference(curves) < 1e-9, $"{Difference(curves)}");

        // The control: so much less each frame, as it is often done, depends on the rate.
        double[][] perFrame = new[] { 30, 60, 144 }.Select(hertz => Enumerable.Range(1, 12).Select(n => size * Math.Pow(0.9, n * hertz / 6.0)).ToArray()).ToArray();
        Assert.True(Difference(perFrame) > 0.1 * size);
    }

    [Theory]
    [InlineData(0.03)]
    [InlineData(4)]
    public void Update_AfterACorrection_ComesRightAndNeverFasterThanMayBe(double size)
    {
        Assert.True(ComesRight(Curve(size, 60)));
        Assert.False(ComesRight(Curve(size, 60, new DisplayOptions(SimDuration.FromSeconds(10), SimDuration.FromSeconds(10)))));

        double fastest = 0;
        Corrected(size, out Screen screen).Frames(1, 60, 60, (_, drawn) => fastest = Math.Max(fastest, drawn.Decay * 60));
        Assert.InRange(fastest, 0, 10 + 1e-9);
        if (size > 3)
        {
            Assert.Equal(10, fastest, 1e-9);
            fastest = 0;
            Corrected(size, out _, new DisplayOptions(maxSpeed: 1e6)).Frames(1, 60, 60, (_, drawn) => fastest = Math.Max(fastest, drawn.Decay * 60));
            Assert.True(fastest > 11); // the control: without the limit
        }
    }

    [Fact]
    public void Update_LargerThanIsSmoothed_IsShownAtOnce()
    {
        Corrected(5.1, out Screen screen);
        screen.Frame(1.01);
        DrawnBody drawn = screen.Drawn(First);
        Assert.Equal((5.1, 5.1), (Math.Round(drawn.Jump, 9), Math.Round(drawn.Dropped, 9)));
        Assert.Equal(drawn.State.Position, drawn.Position);
        Corrected(5.1, out screen, new DisplayOptions(snapDistance: 6));
        screen.Frame(1.01);
        Assert.True(screen.Drawn(First).Offset.Length > 4.9);
    }

    [Fact]
    public void Update_Bounce_HidesAsMuchOfAnOffsetAsItIsHard()
    {
        // Falls from 5 m above the floor and is 1 m to the side of where it was shown; at 9.9 m/s, of which 0.5 come back, it hides 0.74 m.
        Assert.Equal(1.5 * Math.Sqrt(2 * Gravity * 5) * 0.05, HiddenInABounce(new DisplayOptions(slowest: SimDuration.FromSeconds(10))), 1e-6);
        Assert.Equal(0, HiddenInABounce(new DisplayOptions(slowest: SimDuration.FromSeconds(10), hiding: SimDuration.Zero)));
    }

    [Fact]
    public void Update_BodyPutElsewhere_TakesNoOffsetAlong()
    {
        Corrected(0.5, out Screen screen);
        screen.Frame(1.01);
        screen.Do(1.02, PlayerAction.Teleport(First, V(0, 9)));
        screen.Frame(1.03);
        DrawnBody drawn = screen.Drawn(First);
        Assert.Equal(V(0, 9), drawn.Position);
        Assert.True(drawn.Dropped > 0.3);
    }

    [Fact]
    public void Update_RandomWorldWithLateEvents_DrawsNothingInsideAnythingForAnOffset()
    {
        (double deepest, double smoothed) = Deepest(new DisplayOptions());
        Assert.True(deepest <= 0.001, $"{deepest} m");
        Assert.True(smoothed > 1);
        Assert.True(Deepest(new DisplayOptions(penetration: 1e9)).Deepest > 0.01); // the control: never given up
    }

    [Fact]
    public void TryRead_BodyThatComesAndGoes_HasNoOffsetOfBefore()
    {
        Screen screen = new(Alone);
        screen.Frame(1);
        Assert.False(screen.Offsets.TryRead(Second, out _));
        ExternalEvent spawn = PlayerAction.Spawn(Ball(), V(9)).Stamp(At(1), 2, 1);
        BodyId late = new(2, 1, 0);
        screen.World.Submit(spawn);
        screen.Frame(1.1);
        Assert.Equal(0, screen.Drawn(late).Jump);
        screen.World.Submit(PlayerAction.SetVelocity(late, V(1)).Stamp(At(1.05), 2, 2));
        screen.Frame(1.15);
        Assert.True(screen.Drawn(late).Offset.Length > 0.01);
        screen.World.Retract(spawn);
        screen.Frame(1.2);
        Assert.False(screen.Offsets.TryRead(late, out _));
        screen.World.Submit(spawn);
        screen.Frame(1.25);
        Assert.Equal((0, V(0)), (screen.Drawn(late).Jump, screen.Drawn(late).Offset));
    }

    [Fact]
    public void Update_TimeNotShown_ChangesNothing()
    {
        Corrected(0.5, out Screen screen);
        screen.Frame(1.01);
        DrawnBody before = screen.Drawn(First);
        Assert.False(new DisplayOffsets(Alone).Update(new RenderTripleBuffer().Latest(), At(1)));
        RenderSnapshot snapshot = screen.Publish(1.02);
        Assert.False(screen.Offsets.Update(snapshot, snapshot.From - SimDuration.OneTick));
        Assert.Equal(before, screen.Drawn(First));
        Assert.True(screen.Offsets.Update(snapshot, At(1.02)));
        Assert.NotEqual(before, screen.Drawn(First));
    }

    [Fact]
    public void Update_EarlierThanTheLastFrame_BeginsAnew()
    {
        Corrected(0.5, out Screen screen);
        screen.Frame(1.01);
        Assert.True(screen.Drawn(First).Offset.Length > 0.4);
        screen.Frame(0.9);
        Assert.Equal(V(0), screen.Drawn(First).Offset);
    }

    [Fact]
    public void Update_FramesFurtherApartThanRenderSnapshotsReachBack_StartsFromWhatIsReal()
    {
        Corrected(0.5, out Screen screen, past: 0.05);
        screen.Frame(1.01);
        screen.Frame(1.5);
        DrawnBody drawn = screen.Drawn(First);
        Assert.Equal((0, drawn.State.Position), (drawn.Jump, drawn.Position));
        Assert.True(drawn.Dropped > 0.4);
    }

    [Fact]
    public void Update_AfterWarmUp_AllocatesNothing()
    {
        // The least of a few: a collection that another test causes gives this thread's allocation buffer back, which counts as allocated.
        Assert.Equal(0, Enumerable.Range(0, 5).Min(_ => Allocated(newBodies: false)));
        Assert.True(Allocated(newBodies: true) > 0); // the control: a body that was not there
    }

    [Fact]
    public void Options_OutOfRange_AreRefusedByName()
    {
        Assert.Equal("fastest", Refused(() => new DisplayOptions(fastest: SimDuration.Zero)));
        Assert.Equal("slowest", Refused(() => new DisplayOptions(slowest: SimDuration.FromMilliseconds(79))));
        Assert.Equal("smallCorrection", Refused(() => new DisplayOptions(smallCorrection: 0)));
        Assert.Equal("largeCorrection", Refused(() => new DisplayOptions(largeCorrection: 0.05)));
        Assert.Equal("maxSpeed", Refused(() => new DisplayOptions(maxSpeed: double.NaN)));
        Assert.Equal("snapDistance", Refused(() => new DisplayOptions(snapDistance: double.PositiveInfinity)));
        Assert.Equal("hiding", Refused(() => new DisplayOptions(hiding: SimDuration.FromSeconds(1.1))));
        Assert.Equal("penetration", Refused(() => new DisplayOptions(penetration: -1)));
    }

    [Fact]
    public void Sources_OfWhatSimulates_KnowNothingOfDisplay()
    {
        string[] users = System.IO.Directory.EnumerateFiles(System.IO.Path.Combine(RepositoryRoot.Path, "src"), "*.cs", System.IO.SearchOption.AllDirectories)
            .Where(file => System.IO.File.ReadAllText(file).Contains("LagSim.Net.Display", StringComparison.Ordinal))
            .Select(file => System.IO.Path.GetRelativePath(RepositoryRoot.Path, file).Replace('\\', '/')).ToArray();
        Assert.DoesNotContain(users, file => file.StartsWith("src/LagSim/", StringComparison.Ordinal));
        Assert.DoesNotContain(users, file => file.StartsWith("src/LagSim.Net/", StringComparison.Ordinal) && !file.StartsWith("src/LagSim.Net/Display/", StringComparison.Ordinal));
        Assert.Contains("src/LagSim.Harness/Experiments/Hands/PredictionTest.cs", users); // the control: who uses it is found
    }

    private static string? Refused(Func<DisplayOptions> make) => Assert.Throws<ArgumentOutOfRangeException>(make).ParamName;

    /// <summary>The first body was shown at 1 s; then an event told that it is elsewhere by so much, at rest.</summary>
    private static Screen Corrected(double size, out Screen screen, DisplayOptions? options = null, double past = 0.25)
    {
        screen = new Screen(Alone, options, past);
        screen.Frame(1);
        screen.Do(0.5, PlayerAction.Teleport(First, V(size, 5)));
        return screen;
    }

    /// <summary>The offset's size each sixth of a second for two seconds.</summary>
    private static double[] Curve(double size, int hertz, DisplayOptions? options = null)
    {
        List<double> curve = [];
        Corrected(size, out Screen screen, options).Frames(1, hertz, 2 * hertz, (n, drawn) =>
        {
            if (n % (hertz / 6) == 0)
            {
                curve.Add(drawn.Offset.Length);
            }
        });
        return [.. curve];
    }

    private static double Difference(double[][] curves) => Enumerable.Range(0, curves[0].Length).Max(n => curves.Max(c => c[n]) - curves.Min(c => c[n]));

    /// <summary>Ever less, and in two seconds less than a centimetre.</summary>
    private static bool ComesRight(double[] curve) => curve.Zip(curve.Skip(1)).All(pair => pair.Second < pair.First || pair.First == 0) && curve[^1] < 0.01;

    private static double HiddenInABounce(DisplayOptions options)
    {
        Screen screen = new(Drop(5, 0.5), options);
        screen.Frame(0.1);
        screen.Do(0.05, PlayerAction.SetVelocity(First, V(0, -Gravity * 0.05, 20)));
        double hidden = 0;
        screen.Frames(0.1, 60, 60, (_, drawn) => hidden += drawn.Dropped);
        return hidden;
    }

    /// <summary>How deep anything was drawn inside another thing, beyond what it really was, and how many metres of corrections there were.</summary>
    private static (double Deepest, double Smoothed) Deepest(DisplayOptions options)
    {
        SceneBuilder builder = new SceneBuilder("box").AddPlane("floor", Vector3D.Up, V(0), 0.8).AddStaticSphere("post", V(0), 0.7)
            .AddPlane("west", V(1), V(-3)).AddPlane("east", V(-1), V(3)).AddPlane("south", V(0, 0, 1), V(0, 0, -3)).AddPlane("north", V(0, 0, -1), V(0, 0, 3));
        for (int i = 0; i < 6; i++)
        {
            builder.AddBody($"ball {i}", Ball(0.4, e: 0.8), V(-2 + (i % 3 * 2), 2 + i, i < 3 ? -1 : 1), V(i - 3, 0, 2 - i));
        }

        Scene scene = builder.Build();
        Screen screen = new(scene, options);
        Random random = new(5);
        double deepest = 0, smoothed = 0;
        for (int n = 1; n < 900; n++)
        {
            double now = n / 60.0;
            if (n % 7 == 0)
            {
                screen.Do(Math.Max(now - 0.15, 0), PlayerAction.Impulse(BodyId.OfScene(random.Next(6)), V(random.Next(-5, 6), random.Next(0, 6), random.Next(-5, 6))));
            }

            screen.Frame(now);
            DrawnBody[] drawn = Enumerable.Range(0, 6).Select(i => screen.Drawn(BodyId.OfScene(i))).ToArray();
            for (int i = 0; i < drawn.Length; i++)
            {
                smoothed += drawn[i].Decay;
                foreach (StaticPlane plane in scene.Planes)
                {
                    deepest = Math.Max(deepest, Math.Min(plane.Gap(drawn[i].State.Position, 0.4), 0) - plane.Gap(drawn[i].Position, 0.4));
                }

                deepest = Math.Max(deepest, Math.Min(drawn[i].State.Position.Length - 1.1, 0) - (drawn[i].Position.Length - 1.1));
                for (int j = 0; j < i; j++)
                {
                    double real = (drawn[i].State.Position - drawn[j].State.Position).Length - 0.8;
                    deepest = Math.Max(deepest, Math.Min(real, 0) - ((drawn[i].Position - drawn[j].Position).Length - 0.8));
                }
            }
        }

        return (deepest, smoothed);
    }

    private static long Allocated(bool newBodies)
    {
        Screen screen = new(Drop(3, 0.9));
        screen.Do(0, PlayerAction.Spawn(Ball(), V(5, 5)));
        screen.Frame(1);
        screen.Do(0.9, PlayerAction.Impulse(First, V(1)));
        if (newBodies)
        {
            screen.Do(1.1, PlayerAction.Spawn(Ball(), V(9, 5)));
        }

        RenderSnapshot snapshot = screen.Publish(1.5);
        long before = GC.GetAllocatedBytesForCurrentThread();
        for (int n = 1; n <= 20; n++)
        {
            screen.Offsets.Update(snapshot, At(1.25 + (n * 0.01)));
            screen.Offsets.TryRead(First, out _);
        }

        return GC.GetAllocatedBytesForCurrentThread() - before;
    }
}
