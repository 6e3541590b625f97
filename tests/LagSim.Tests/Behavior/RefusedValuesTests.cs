using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>What may not enter the world is refused at the door, by a sentence that names the value.</summary>
public sealed class RefusedValuesTests
{
    private static readonly Dictionary<string, (Func<SceneBuilder, SceneBuilder> Spoil, string[] Words)> Scenes = new()
    {
        ["nan position"] = (b => b.AddBody("x", Ball(), V(0, double.NaN)), ["position", "'x'", "NaN"]),
        ["infinite velocity"] = (b => b.AddBody("x", Ball(), V(0, 9), V(double.PositiveInfinity)), ["velocity", "'x'", "Infinity"]),
        ["far away"] = (b => b.AddBody("x", Ball(), V(2e12, 9)), ["position", "'x'", "2000000000000"]),
        ["too fast"] = (b => b.AddBody("x", Ball(), V(0, 9), V(1e12)), ["velocity", "'x'", "1000000000000", "tenth"]),
        ["negative radius"] = (b => b.AddBody("x", Ball(-1), V(0, 9)), ["radius", "'x'", "-1"]),
        ["nan radius"] = (b => b.AddBody("x", Ball(double.NaN), V(0, 9)), ["radius", "'x'", "NaN"]),
        ["no mass"] = (b => b.AddBody("x", Ball(mass: 0), V(0, 9)), ["mass", "'x'", "0"]),
        ["restitution"] = (b => b.AddBody("x", Ball(e: 1.5), V(0, 9)), ["restitution", "'x'", "1.5"]),
        ["law"] = (b => b.AddBody("x", Ball(flight: MotionLaw.Resting), V(0, 9)), ["motion law", "'x'", "Resting"]),
        ["step"] = (b => b.AddBody("x", Ball(flight: MotionLaw.RungeKutta4, step: 2), V(0, 9)), ["step", "'x'", "2s"]),
        ["step below a tick"] = (b => b.AddBody("x", Ball(flight: MotionLaw.RungeKutta4, step: 1e-13), V(0, 9)), ["step", "'x'", "0s", "1 microsecond"]),
        ["step of the least number"] = (b => b.AddBody("x", Ball(flight: MotionLaw.RungeKutta4, step: double.Epsilon), V(0, 9)), ["step", "'x'", "0s", "1 microsecond"]),
        ["no such force"] = (b => b.AddBody("x", Ball(flight: MotionLaw.RungeKutta4, force: 3), V(0, 9)), ["'x'", "force 2", "has none"]),
        ["force on ballistic"] = (
            b => b.AddForce(Force.Supplied(new FunctionForce((_, _, _) => default))).AddBody("x", Ball(force: 1), V(0, 9)), ["'x'", "Ballistic", "RungeKutta4"]),
        ["no closed form"] = (
            b => b.AddForce(Force.QuadraticDrag("air", 0.1), out ForceSet air).AddBody("x", new BodySpec(0.5, 1, 1, MotionLaw.ClosedForm, forces: air), V(0, 9)),
            ["'x'", "ClosedForm", "DormandPrince54"]),
        ["too stiff"] = (
            b => b.AddForce(Force.Spring("steel", V(0), 1e14), out ForceSet steel).AddBody("x", new BodySpec(0.5, 1, 1, forces: steel), V(0, 9)),
            ["'x'", "'steel'", "10000000", "1000000"]),
        ["hardly too stiff"] = (
            b => b.AddForce(Force.Spring("steel", V(0), 1.0000000000001e12), out ForceSet steel).AddBody("x", new BodySpec(0.5, 1, 1, forces: steel), V(0, 9)),
            ["'x'", "at a rate of just above 1000000 1/s; at most 1000000 1/s"]),
        ["too stiff together"] = (
            b => Stiff(b, 9e5, MotionLaw.RungeKutta4, BodySpec.DefaultTolerance),
            ["'x'", "'one', 'two'", "together at a rate of 1800000 1/s; at most 1465790 1/s is allowed under RungeKutta4 with fixed steps"]),
        ["too stiff for fixed steps"] = (
            b => Stiff(b, 3e5, MotionLaw.DormandPrince54, 0), ["'x'", "at a rate of 600000 1/s; at most 526316 1/s is allowed under DormandPrince54 with fixed steps"]),
        ["forces of another scene"] = (
            b => b.AddForce(Force.LinearDrag("oil", 1)).AddBody("x", new BodySpec(0.5, 1, 1, forces: ForceSet.Of(2)), V(0, 9)),
            ["'x'", "names force 2, counted from 0, but the scene has 1, number 0. A ForceSet holds numbers, of the scene whose AddForce gave it"]),
        ["tolerance"] = (b => b.AddBody("x", new BodySpec(0.5, 1, 1, tolerance: -1e-9), V(0, 9)), ["tolerance", "'x'", "-1E-09"]),
        ["nan tolerance"] = (b => b.AddBody("x", new BodySpec(0.5, 1, 1, tolerance: double.NaN), V(0, 9)), ["tolerance", "'x'", "NaN"]),
        ["negative drag"] = (b => b.AddForce(Force.LinearDrag("oil", -1)), ["coefficient", "'oil'", "-1"]),
        ["nan field"] = (b => b.AddForce(Force.Magnetic("coil", V(double.NaN), 1)), ["field", "'coil'", "NaN"]),
        ["power"] = (b => b.AddForce(Force.Central("sun", V(0), 1, -5)), ["power", "'sun'", "-5", "4"]),
        ["negative damping"] = (b => b.AddForce(Force.Spring("rubber", V(0), 1, -2)), ["damping", "'rubber'", "-2"]),
        ["33 forces"] = (b => Enumerable.Range(0, 33).Aggregate(b, (all, n) => all.AddForce(Force.LinearDrag($"force {n}", 1))), ["33", "32"]),
        ["force without name"] = (b => b.AddForce(Force.LinearDrag("", 1)), ["''", "name"]),
        ["overlap"] = (b => b.AddBody("x", Ball(), V(0, 0.25)), ["'x'", "0.25", "floor"]),
        ["overlap of two"] = (b => b.AddBody("x", Ball(), V(0, 9)).AddBody("y", Ball(), V(0, 9.5)), ["'y'", "'x'", "0.5"]),
        ["same name"] = (b => b.AddBody("floor", Ball(), V(0, 9)), ["'floor'", "unique"]),
        ["no name"] = (b => b.AddBody("", Ball(), V(0, 9)), ["''", "name"]),
        ["null name"] = (b => b.AddBody(null!, Ball(), V(0, 9)), ["''", "0 characters; a name has 1 to 64"]),
        ["long name"] = (b => b.AddPlane(new string('x', 65), V(1), V(-99)), ["'xxx", "xxx...'", "65 characters; a name has 1 to 64"]),
        ["name of two lines"] = (b => b.AddBody("a\nb", Ball(), V(0, 9)), ["'a\uFFFDb'", "the control character U+000A"]),
        ["name of a zero"] = (b => b.AddForce(Force.LinearDrag("\0", 1)), ["'\uFFFD'", "the control character U+0000"]),
        ["name of half a pair"] = (b => b.AddStaticSphere("\ud800x", V(-90), 1), ["'\uFFFDx'", "half of a surrogate pair"]),
        ["scene without name"] = (_ => new SceneBuilder(""), ["'' is no name for a scene", "0 characters; a name has 1 to 64"]),
        ["scene of two lines"] = (_ => new SceneBuilder("a\nb"), ["'a\uFFFDb' is no name for a scene", "the control character U+000A"]),
        ["scene of half a pair"] = (_ => new SceneBuilder("x\udc00"), ["'x\uFFFD' is no name for a scene", "half of a surrogate pair"]),
        ["gravity"] = (b => b.WithGravity(V(0, double.NaN)), ["gravity", "NaN"]),
        ["resolution"] = (b => b.WithRestitutionThreshold(0), ["restitution threshold", "0"]),
        ["contact tolerance"] = (b => b.WithContactTolerance(0.2), ["contact tolerance", "0.2", "1E-09", "0.1 m"]),
        ["nan contact tolerance"] = (b => b.WithContactTolerance(double.NaN), ["contact tolerance", "NaN"]),
        ["smallest radius"] = (b => b.WithSmallestRadius(-1), ["smallest radius", "-1"]),
        ["Magnus too fast"] = (b => b.AddForce(Force.Magnus("air", 2e3)).AddBody("m", new BodySpec(0.5, 1, 1, forces: ForceSet.Of(0)), V(90, 90), spin: V(0, 0, 1e3)), ["'m'", "'air'", "2000000", "1000000 1/s"]),
        ["no normal"] = (b => b.AddPlane("p", V(0), V(0)), ["'p'", "normal"]),
        ["plane restitution"] = (b => b.AddPlane("p", V(1), V(0), 2), ["'p'", "restitution", "2"]),
        ["sphere radius"] = (b => b.AddStaticSphere("s", V(0), 0), ["'s'", "radius"]),
    };

    private static readonly Dictionary<string, (ExternalEvent Event, string[] Words)> Events = new()
    {
        ["default"] = (default, ["None"]),
        ["sequence 0"] = (ExternalEvent.Remove(At(1), 1, 0, First), ["sequence", "0"]),
        ["no such body"] = (ExternalEvent.Remove(At(1), 1, 1, BodyId.OfScene(7)), ["0.0.7", "no such body"]),
        ["index of a spawn"] = (ExternalEvent.Remove(At(1), 1, 1, new BodyId(1, 1, 3)), ["1.1.3", "index 0"]),
        ["spawn 0"] = (ExternalEvent.Remove(At(1), 1, 1, new BodyId(1, 0, 0)), ["1.0.0", "count from 1"]),
        ["nan place"] = (ExternalEvent.Teleport(At(1), 1, 1, First, V(double.NaN, 5)), ["position", "NaN"]),
        ["infinite impulse"] = (ExternalEvent.Impulse(At(1), 1, 1, First, V(double.NegativeInfinity)), ["impulse", "Infinity"]),
        ["too fast"] = (ExternalEvent.SetVelocity(At(1), 1, 1, First, V(1e12)), ["velocity", "1000000000000"]),
        ["spawn too small"] = (ExternalEvent.Spawn(At(1), 1, 1, Ball(0.1), V(0, 5)), ["radius", "0.1", "0.5"]),
        ["spawn without spec"] = (ExternalEvent.Spawn(At(1), 1, 1, default, V(0, 5)), ["radius", "0"]),
        ["spawn that turns too fast"] = (ExternalEvent.Spawn(At(1), 1, 1, Ball(), V(0, 5), spin: V(0, 0, 1e12)), ["spin", "1000000000000", "rad/s"]),
        ["spawn with a spin of NaN"] = (ExternalEvent.Spawn(At(1), 1, 1, Ball(), V(0, 5), spin: V(double.NaN)), ["spin", "NaN"]),
    };

    public static TheoryData<string> SceneCases => [.. Scenes.Keys];

    public static TheoryData<string> EventCases => [.. Events.Keys];

    [Theory]
    [MemberData(nameof(SceneCases))]
    public void Build_InvalidValue_IsRefusedByNameAndValue(string name)
    {
        (Func<SceneBuilder, SceneBuilder> spoil, string[] words) = Scenes[name];
        string message = Assert.Throws<SceneException>(() => spoil(Good()).Build()).Message;
        Assert.All(words, word => Assert.Contains(word, message, StringComparison.Ordinal));
    }

    [Theory]
    [MemberData(nameof(EventCases))]
    public void Submit_InvalidValue_IsRefusedAndNothingChanges(string name)
    {
        (ExternalEvent external, string[] words) = Events[name];
        Simulation simulation = new(Good().Build(), KeepAll);
        simulation.AdvanceTo(At(2));
        ulong before = simulation.StateHash(At(2));
        string message = Assert.Throws<SceneException>(() => simulation.Submit(external)).Message;
        Assert.All(words, word => Assert.Contains(word, message, StringComparison.Ordinal));
        Assert.Equal(before, simulation.StateHash(At(2)));
        Assert.Equal(1, simulation.BodyCount);
        simulation.AdvanceTo(At(3)); // and it is not faulted
    }

    /// <summary>What is refused by its sum is what no step could begin, and no more than that.</summary>
    [Theory]
    [InlineData(MotionLaw.RungeKutta4, 1e-9, 7.3e5)]
    [InlineData(MotionLaw.DormandPrince54, 0, 2.6e5)]
    [InlineData(MotionLaw.DormandPrince54, 1e-9, 9e5)]
    [InlineData(MotionLaw.Automatic, 1e-9, 9e5)]
    public void Build_ForcesThatStepsFollowTogether_ArePermitted(MotionLaw flight, double tolerance, double rate) =>
        Assert.Equal(2, new Simulation(Stiff(Good(), rate, flight, tolerance).Build()).BodyCount);

    [Fact]
    public void Build_NamesOfAnyScript_AreKept()
    {
        Scene scene = new SceneBuilder("\u6e96\ud83c\udfb1").AddBody("\ud83c\udfb1 l'\u00e9toile", Ball(), V(0)).Build();
        Assert.Equal(("\u6e96\ud83c\udfb1", "\ud83c\udfb1 l'\u00e9toile"), (scene.Name, scene.Bodies[0].Name));
    }

    [Fact]
    public void Step_ThatIsNotGiven_IsTheDefaultAndIsKept()
    {
        Assert.Equal(BodySpec.DefaultStep, new BodySpec(0.5, 1, 1, MotionLaw.RungeKutta4).Step);
        SimDuration step = SimDuration.FromSeconds(0.25);
        BodySpec slow = new BodySpec(0.5, 1, 1).With(MotionLaw.RungeKutta4, step);
        Assert.Equal((step, step), (slow.Step, slow.With(MotionLaw.Ballistic).Step));
    }

    [Fact]
    public void BuildAndSubmit_ValuesAtTheEdge_ArePermitted()
    {
        Simulation simulation = new(Good().AddBody("x", Ball(), V(0, 2.5)).Build(), KeepAll); // touching
        Assert.Equal(SubmitResult.Queued, simulation.Submit(ExternalEvent.Teleport(At(1), 1, 1, First, V(5, 0.5))));
        Assert.Equal(SubmitResult.Queued, simulation.Submit(ExternalEvent.SetVelocity(At(1), 1, 2, First, V(0.05 * (1L << 40)))));
    }

    [Fact]
    public void NegativeZero_InAScene_HashesLikeZero()
    {
        Scene plus = new SceneBuilder("a").AddBody("x", Ball(), V(0, 0, 0), V(0)).Build();
        Scene minus = new SceneBuilder("a").AddBody("x", Ball(), V(-0.0, -0.0, -0.0), V(-0.0)).Build();
        Assert.Equal(plus.Hash, minus.Hash);
        Assert.Equal(Run(plus, 1).StateHash(At(1)), Run(minus, 1).StateHash(At(1)));
        Assert.NotEqual(plus.Hash, new SceneBuilder("a").AddBody("x", Ball(), V(double.Epsilon), V(0)).Build().Hash);
    }

    [Fact]
    public void AdvanceTo_ForceThatGivesNaN_FaultsWithASentenceAndStaysFaulted()
    {
        Scene scene = new SceneBuilder("nan").AddForce(Force.Supplied(new FunctionForce((t, _, _) => V(t > 0.5 ? double.NaN : 0))))
            .AddBody("x", Ball(flight: MotionLaw.RungeKutta4, force: 1), V(0)).Build();
        Simulation simulation = new(scene, KeepAll);
        SimulationException failure = Assert.Throws<SimulationException>(() => simulation.AdvanceTo(At(1)));
        Assert.Contains("body 'x'", failure.Message, StringComparison.Ordinal);
        Assert.Contains("NaN", failure.Message, StringComparison.Ordinal);
        Assert.Same(failure, Assert.Throws<InvalidOperationException>(() => simulation.AdvanceTo(At(1))).InnerException);
        Assert.Throws<InvalidOperationException>(() => simulation.StateHash(At(0.1)));
    }

    [Fact]
    public void AdvanceTo_BackInTime_IsRefusedAndHarmless()
    {
        Simulation simulation = Run(Drop(1, 0.5), 1);
        Assert.Throws<ArgumentOutOfRangeException>(() => simulation.AdvanceTo(At(0.5)));
        simulation.AdvanceTo(At(2));
    }

    private static SceneBuilder Stiff(SceneBuilder scene, double rate, MotionLaw flight, double tolerance) => scene
        .AddForce(Force.LinearDrag("one", rate), out ForceSet one).AddForce(Force.LinearDrag("two", rate), out ForceSet two)
        .AddBody("x", new BodySpec(0.5, 1, 1, flight, SimDuration.FromSeconds(1.9e-6), one | two, tolerance), V(0, 9));

    private static SceneBuilder Good() => new SceneBuilder("good").AddPlane("floor", Vector3D.Up, V(0), 0.5).AddStaticSphere("dome", V(10, 0), 1)
        .AddBody("ball", Ball(), V(0, 1.5));

    [Fact]
    public void Name_ThatIsNull_IsAnArgumentNullException()
    {
        Scene scene = new SceneBuilder("named").AddBody("ball", new BodySpec(0.5, 1, 0.5), default).Build();
        Assert.Equal("name", Assert.Throws<ArgumentNullException>(() => scene.BodyNamed(null!)).ParamName);
        Assert.Equal("name", Assert.Throws<ArgumentNullException>(() => scene.ForceNamed(null!)).ParamName);
        Assert.Throws<ArgumentException>(() => scene.BodyNamed("cube"));
    }

    /// <summary>An empty scene whose players bring all bodies has to say how small they may be.</summary>
    [Fact]
    public void Spawn_IntoASceneWithoutBodies_NeedsASmallestRadius()
    {
        ExternalEvent spawn = PlayerAction.Spawn(Ball(), V(0, 2)).Stamp(At(1), 1, 1);
        SceneBuilder empty = new SceneBuilder("empty").AddPlane("floor", Vector3D.Up, 0.0);
        SceneException refused = Assert.Throws<SceneException>(() => new Simulation(empty.Build(), KeepAll).Submit(spawn));
        Assert.Contains("a scene without bodies of its own takes none until smallest_radius_m (SceneBuilder.WithSmallestRadius) says", refused.Message, StringComparison.Ordinal);
        Assert.Equal(SubmitResult.Queued, new Simulation(empty.WithSmallestRadius(0.1).Build(), KeepAll).Submit(spawn));
    }
}
