using System;
using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Scenes;

/// <summary>What is said of a scene is what is done for it.</summary>
public sealed class ExplainTests
{
    [Fact]
    public void Explain_BallisticScene_LeavesOutAllElse()
    {
        SceneExplanation explanation = BuiltInScenes.Drop(law: MotionLaw.Ballistic).Explain();
        BodyExplanation ball = Assert.Single(explanation.Bodies);
        Assert.Equal((MotionLaw.Ballistic, 0, 0), (ball.Motion, ball.SegmentsPerSecond, ball.EvaluationsPerSecond));
        Assert.Contains("parabola", ball.Why, StringComparison.Ordinal);
        Assert.Equal(["rest on planes", "static geometry", "contacts of bodies"], explanation.Features.Where(f => f.IsModelled).Select(f => f.Name));
    }

    [Fact]
    public void Explain_LawThatTheSceneAsksFor_NamesTheCheaperOne()
    {
        BodyExplanation ball = BuiltInScenes.Drop().Explain().Bodies[0];
        Assert.Equal((MotionLaw.RungeKutta4, 200.0, 1000.0), (ball.Motion, Math.Round(ball.SegmentsPerSecond, 6), Math.Round(ball.EvaluationsPerSecond, 6)));
        Assert.StartsWith("The scene asks for RungeKutta4. Ballistic would be cheaper: only uniform gravity", ball.Why, StringComparison.Ordinal);
    }

    /// <summary>The pieces that are foretold are those that a flight without impacts has.</summary>
    [Fact]
    public void Explain_PiecesPerSecond_AreWhatTheWorldMakes()
    {
        Scene scene = Forced();
        Simulation world = Run(scene, 1);
        foreach (BodyExplanation body in scene.Explain().Bodies)
        {
            int pieces = world.Timeline(scene.BodyNamed(body.Body)).Count - 1;
            Assert.InRange(pieces, body.SegmentsPerSecond * 0.5, (body.SegmentsPerSecond * 2) + 1);
        }
    }

    [Fact]
    public void Explain_Forces_NamesThoseThatActAndThoseThatDoNot()
    {
        SceneExplanation explanation = Forced().Explain();
        Assert.Equal([MotionLaw.ClosedForm, MotionLaw.DormandPrince54, MotionLaw.Ballistic], explanation.Bodies.Select(b => b.Motion));
        Assert.Equal("Gravity, oil (LinearDrag): linear in position and velocity, so there is a closed form.", explanation.Bodies[0].Why);
        Assert.Equal("Gravity, air (QuadraticDrag): together without a closed form here, so steps whose error is kept within 1E-09 m.", explanation.Bodies[1].Why);
        FeatureExplanation forces = explanation.Features.Single(f => f.Name == "forces besides gravity");
        Assert.True(forces.IsModelled);
        Assert.Equal("2 forces on bodies that name them. On no body of the scene: unused.", forces.Why);
    }

    [Fact]
    public void ToString_ManyEqualBodiesBeforeADearOne_StillTellsOfIt()
    {
        SceneBuilder builder = new SceneBuilder("crowd").AddForce(Force.Spring("coil", V(0), 5), out ForceSet coil);
        for (int n = 0; n < 14; n++)
        {
            builder.AddBody($"ball {n}", Ball(), V(2 * n));
        }

        string[] lines = builder.AddBody("bob", new BodySpec(0.5, 1, 1, forces: coil), V(-2)).Build().Explain().ToString().Split('\n');
        Assert.StartsWith("ball 0, ball 1, ball 2 and 11 more: Ballistic. ", lines[0], StringComparison.Ordinal);
        Assert.StartsWith("bob: ClosedForm, ", lines[1], StringComparison.Ordinal);
        Assert.StartsWith("forces besides gravity", lines[2], StringComparison.Ordinal);
    }

    [Fact]
    public void ToString_MoreThanTenKindsOfBodies_SaysHowManyAreLeft()
    {
        SceneBuilder builder = new("zoo");
        for (int n = 0; n < 12; n++)
        {
            builder.AddForce(Force.Spring($"coil {n}", V(0), 5 + n), out ForceSet coil).AddBody($"bob {n}", new BodySpec(0.5, 1, 1, forces: coil), V(2 * n));
        }

        Assert.Equal("and 2 more bodies", builder.Build().Explain().ToString().Split('\n')[10]);
    }

    [Fact]
    public void Explain_BodiesThatMayLeanOnEachOther_SaysWhatIslandsCost()
    {
        // The default contact tolerance is 1 mm here, and in 1/128 s a fall stays within it, by 0.3 mm, but not in 1/64 s, by 1.2 mm.
        FeatureExplanation rough = Islands(Two(friction: 0.5).Build());
        Assert.True(rough.IsModelled);
        Assert.Contains("in persistent contact, with friction, that no closed form", rough.Why, StringComparison.Ordinal);
        Assert.Contains("at most 1/128 s. That is 128 pieces/s or more for each", rough.Why, StringComparison.Ordinal);
        Assert.Contains("Without friction a heap may sway", Islands(Two(friction: 0).Build()).Why, StringComparison.Ordinal);

        // The controls: nothing presses, or nothing is there to lean on but one plane.
        Assert.Equal((false, "Nothing presses bodies on each other or on anything."), Told(Islands(Two(0.5).WithGravity(Floating).Build())));
        Assert.Equal((false, "There is nothing that a body could lean on but planes that carry it by a closed form."), Told(Islands(BuiltInScenes.Drop())));

        // It is what a world does: one ball on another beside a wall, in pieces of 1/128 s at most while they move.
        Simulation world = Run(Two(0.5).Build(), 0.5);
        Assert.Contains(world.Timeline(Second), entry => entry.State.Motion == MotionLaw.Constrained);
        Assert.All(world.Timeline(Second).Zip(world.Timeline(Second).Skip(1)), pair => Assert.True(
            pair.First.State.Motion != MotionLaw.Constrained || pair.Second.Key.Time.SecondsSince(pair.First.Key.Time) <= 1.0 / 128));

        static SceneBuilder Two(double friction) => new SceneBuilder("two").AddPlane("floor", V(0, 1), V(0))
            .AddBody("lower", new BodySpec(0.5, 1, 0, friction: friction), V(0, 0.5)).AddBody("upper", new BodySpec(0.5, 1, 0, friction: friction), V(0.1, 1.6));

        static FeatureExplanation Islands(Scene scene) => scene.Explain().Features.Single(f => f.Name == "islands");

        static (bool, string) Told(FeatureExplanation feature) => (feature.IsModelled, feature.Why);
    }

    /// <summary>The one number between speed and error in heaps, and why it is that.</summary>
    [Theory]
    [InlineData(0.5, 0, "0.001 m, the default where the smallest radius is 0.1 m or more.")]
    [InlineData(0.05, 0, "0.0005 m, the default: a hundredth of the smallest radius, 0.05 m.")]
    [InlineData(0.05, 1e-4, "0.0001 m, as the scene sets it.")]
    public void Explain_ContactTolerance_SaysWhereItComesFrom(double radius, double set, string why)
    {
        SceneBuilder builder = new SceneBuilder("two").AddPlane("floor", V(0, 1), V(0))
            .AddBody("lower", new BodySpec(radius, 1, 0), V(0, radius)).AddBody("upper", new BodySpec(radius, 1, 0), V(0, 4 * radius));
        Scene scene = (set > 0 ? builder.WithContactTolerance(set) : builder).Build();
        FeatureExplanation told = scene.Explain().Features.Single(f => f.Name == "contact tolerance");
        Assert.Equal((true, why), (told.IsModelled, told.Why));
        told = BuiltInScenes.Drop().Explain().Features.Single(f => f.Name == "contact tolerance");
        Assert.False(told.IsModelled, "nothing leans on anything there");
    }

    /// <summary>A wind of 1e12 m/s is allowed, and no step can be taken in it: the others are explained all the same.</summary>
    [Fact]
    public void Explain_BodyThatCannotTakeAStep_SaysWhy()
    {
        Scene storm = Storm(1e12);
        string why = Assert.Throws<SimulationException>(() => new Simulation(storm)).Message;
        SceneExplanation explanation = storm.Explain();
        Assert.Equal(why, explanation.CannotBegin);
        Assert.EndsWith($"Its first step cannot be taken. {why}", explanation.Bodies[1].Why, StringComparison.Ordinal);
        Assert.Equal([0, double.NaN], explanation.Bodies.Select(b => b.SegmentsPerSecond));
        Assert.EndsWith($"\nno world can begin: {why}", explanation.ToString(), StringComparison.Ordinal);

        // The control: a wind in which one can.
        SceneExplanation calm = Storm(10).Explain();
        Assert.Null(calm.CannotBegin);
        Assert.True(calm.Bodies[1].SegmentsPerSecond > 1);
        Assert.DoesNotContain("cannot", calm.ToString(), StringComparison.Ordinal);

        static Scene Storm(double wind) => new SceneBuilder("storm").AddForce(Force.QuadraticDrag("wind", 0.1, V(wind)), out ForceSet force)
            .AddBody("falls", Ball(), V(0)).AddBody("flies", new BodySpec(0.1, 1, 1, forces: force), V(3)).Build();
    }

    /// <summary>In a periodic box a flight comes in pieces, what lies still does not.</summary>
    [Fact]
    public void Explain_PeriodicBox_SaysHowOftenFlightsAreOpenedAnew()
    {
        Scene scene = new SceneBuilder("box").WithGravity(Floating).WithPeriodicBox(V(10, 10, 10)).AddBody("flies", Ball(0.1), V(1, 1, 1), V(1)).AddBody("lies", Ball(0.1), V(5, 5, 5)).Build();
        SceneExplanation explanation = scene.Explain();
        Assert.Equal(1 / 1.25, explanation.Bodies[0].SegmentsPerSecond, 1e-9);
        Assert.Equal((0.0, 0.0), (explanation.Bodies[1].SegmentsPerSecond, explanation.Bodies[0].EvaluationsPerSecond));
        Assert.Equal(80, Run(scene, 100.5).Timeline(First).Count - 1);
        Assert.Equal("static geometry: no. There is none.", explanation.Features.Single(f => f.Name == "static geometry").ToString());
    }

    [Fact]
    public void Explain_ManyBodies_SaysThatThereIsAnIndex()
    {
        Assert.Contains("brute force: every pair is tested", Contacts(BuiltInScenes.Crowd(64)), StringComparison.Ordinal);
        Assert.Contains("neighbour lists", Contacts(BuiltInScenes.Crowd(65)), StringComparison.Ordinal);

        static string Contacts(Scene scene) => scene.Explain().Features.Single(f => f.Name == "contacts of bodies").Why;
    }

    [Fact]
    public void ToString_OfAScene_HasALineForEachBodyAndFeature()
    {
        string[] lines = Forced().Explain().ToString().Split('\n');
        Assert.Equal(14, lines.Length);
        Assert.Matches("^oily: ClosedForm, [0-9.]+ pieces/s, [0-9.]+ force calls/s. Gravity, oil \\(LinearDrag\\): linear in position and velocity", lines[0]);
        Assert.Equal("free: Ballistic. Only uniform gravity acts on it: a parabola is exact.", lines[2]);
        Assert.Equal("integrator: yes. 1 body of 3 in steps.", lines[4]);
        Assert.Equal("periodic box: no. The scene has none.", lines[11]);
        Assert.Equal("sensors: no. There is none.", lines[12]);
    }

    private static Scene Forced() => new SceneBuilder("forced")
        .AddForce(Force.LinearDrag("oil", 0.5), out ForceSet oil).AddForce(Force.QuadraticDrag("air", 0.1), out ForceSet air).AddForce(Force.LinearDrag("unused", 1))
        .AddBody("oily", new BodySpec(0.5, 1, 1, forces: oil), V(0), V(5)).AddBody("airy", new BodySpec(0.5, 1, 1, forces: air), V(5), V(5, 5))
        .AddBody("free", new BodySpec(0.5, 1, 1), V(10)).Build();
}
