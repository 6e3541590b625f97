using System;
using System.Globalization;
using System.Linq;
using System.Text.RegularExpressions;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>What a program's own force throws ends the world by one kind of exception, which says where and when it was thrown.</summary>
public sealed class ThrowingForceTests
{
    private static readonly InvalidOperationException Thrown = new("no wind here");

    public static TheoryData<MotionLaw, double> Flights => new()
    {
        { MotionLaw.Automatic, 1e-9 }, { MotionLaw.DormandPrince54, 0 }, { MotionLaw.RungeKutta4, 1e-9 },
    };

    [Theory]
    [MemberData(nameof(Flights))]
    public void Force_ThatThrowsAtItsFirstCall_IsNamed(MotionLaw flight, double tolerance)
    {
        Scene scene = Windy(Below(0), flight, tolerance);
        SimulationException failure = Assert.Throws<SimulationException>(() => new Simulation(scene));
        Assert.Same(Thrown, failure.InnerException);
        Assert.StartsWith(
            "At 0s, 0 s after the scene's start, force 'test force', version 1, which the program supplies, threw for body 'second' (0.0.1), at (2, 10, 0) m and (0, 0, 0) m/s: "
            + "InvalidOperationException: no wind here", failure.Message, StringComparison.Ordinal);
        Assert.Equal(failure.Message, scene.Explain().CannotBegin);
    }

    [Theory]
    [MemberData(nameof(Flights))]
    public void Force_ThatThrowsLater_IsNamedWithTheInstant(MotionLaw flight, double tolerance)
    {
        Simulation world = new(Windy(Below(0.5), flight, tolerance), new SimulationOptions(At(3)));
        SimulationException failure = Assert.Throws<SimulationException>(() => world.AdvanceTo(At(5)));
        Assert.Same(Thrown, failure.InnerException);
        Match told = Regex.Match(failure.Message, "^At (3\\.[5-9]\\d*)s, (0\\.[5-9]\\d*) s after the scene's start, force 'test force', .* for body 'second' \\(0\\.0\\.1\\)");
        Assert.True(told.Success, failure.Message);
        Near(Number(told.Groups[1]), 3 + Number(told.Groups[2]), 1e-5);
        Assert.Same(failure, Assert.Throws<InvalidOperationException>(() => world.AdvanceTo(At(6))).InnerException);

        // The control: one that throws nothing.
        Assert.Equal(At(5), Run(Windy(Below(9), flight, tolerance), 5).SimulatedTo);
    }

    /// <summary>In persistent contact it is asked by the step of an island, and where something is struck.</summary>
    [Fact]
    public void Force_ThatThrowsInContact_IsNamed()
    {
        Scene scene = new SceneBuilder("floor").AddForce(Force.Supplied(new FunctionForce(Below(2))), out ForceSet wind).AddPlane("floor", Vector3D.Up, V(0), 0)
            .AddBody("ball", new BodySpec(0.5, 1, 0, forces: wind), V(0, 0.5)).Build();
        Simulation world = new(scene);
        world.AdvanceTo(At(1));
        Assert.Equal(MotionLaw.Constrained, Read(world, First, 1).Motion);
        Assert.Contains("force 'test force', version 1, which the program supplies, threw for body 'ball'", Assert.Throws<SimulationException>(() => world.AdvanceTo(At(3))).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Session_OfAClientWhoseForceThrows_EndsWithTheReason()
    {
        SessionGroup group = new(
            Windy(Below(99), MotionLaw.Automatic, 1e-9), 3, LinkProfiles.PureDelay(5),
            options: peer => new ClientOptions { Accelerations = [new FunctionForce(Below(peer == 1 ? 0 : 99))] },
            scenes: peer => Windy(Below(peer == 1 ? 0 : 99), MotionLaw.Automatic, 1e-9));
        Assert.True(group.RunUntil(() => group.Sessions[1].State == SessionState.Ended && group.Sessions[2].State == SessionState.Running));
        Assert.Equal([SessionEnd.None, SessionEnd.Failed, SessionEnd.None], group.Sessions.Select(s => s.EndedBy));
        Assert.StartsWith("The world cannot be simulated any further. At ", group.Sessions[1].EndReason, StringComparison.Ordinal);
        Assert.EndsWith("InvalidOperationException: no wind here", group.Sessions[1].EndReason, StringComparison.Ordinal);
    }

    private static double Number(Group digits) => double.Parse(digits.Value, CultureInfo.InvariantCulture);

    private static Func<double, Vector3D, Vector3D, Vector3D> Below(double limit) => (seconds, _, _) => seconds < limit ? V(0, 0, 1) : throw Thrown;

    private static Scene Windy(Func<double, Vector3D, Vector3D, Vector3D> at, MotionLaw flight, double tolerance) => new SceneBuilder("windy")
        .AddForce(Force.Supplied(new FunctionForce(at)), out ForceSet wind)
        .AddBody("first", Ball(), V(0, 10)).AddBody("second", new BodySpec(0.1, 1, 1, flight, forces: wind, tolerance: tolerance), V(2, 10)).Build();
}
