using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>
/// A force that is too stiff for a step is followed by shorter steps, or the body leaves the world with a sentence that names it, the force and the number; under no law does a body come out
/// of it faster than energy lets it be.
/// </summary>
public sealed class StiffForceTests
{
    private const double Fast = 1000;

    private static readonly SimTime End = At(1e-3);

    private static readonly (MotionLaw Law, double Tolerance)[] Laws =
    [
        (MotionLaw.Automatic, 1e-9), (MotionLaw.ClosedForm, 1e-9), (MotionLaw.DormandPrince54, 1e-9), (MotionLaw.DormandPrince54, 0), (MotionLaw.RungeKutta4, 1e-9),
    ];

    /// <summary>By kind: the force of a strength, where and how a ball of 1 kg starts, and the most speed that it may have by the balance of energy.</summary>
    private static readonly Dictionary<string, (Func<double, Force> Force, Vector3D Place, Vector3D Velocity, Vector3D Spin, Func<double, double> Most)> Kinds = new()
    {
        ["spring"] = (k => Force.Spring("it", V(0), k), V(1), V(0), V(0), k => Math.Sqrt(k) + 1),
        ["damper"] = (c => Force.Spring("it", V(0), 1, c), V(1), V(Fast), V(0), _ => Fast + 1),
        ["linear drag"] = (c => Force.LinearDrag("it", c), V(1), V(Fast), V(0), _ => Fast + 1),
        ["quadratic drag"] = (k => Force.QuadraticDrag("it", k), V(1), V(Fast), V(0), _ => Fast + 1),
        ["magnetic"] = (q => Force.Magnetic("it", V(0, 0, 1), q), V(1), V(Fast), V(0), _ => Fast + 1),
        ["Magnus"] = (s => Force.Magnus("it", s), V(1), V(Fast), V(0, 0, 1), _ => Fast + 1),
    };

    public static TheoryData<string, double> Strengths
    {
        get
        {
            TheoryData<string, double> data = [];
            foreach (string kind in Kinds.Keys)
            {
                foreach (double strength in new[] { 1, 1e3, 1e6, 1e9, 1e12, 1e20, 1e30 })
                {
                    data.Add(kind, strength);
                }
            }

            return data;
        }
    }

    [Theory]
    [MemberData(nameof(Strengths))]
    public void EveryLaw_OfAStrongForce_FollowsItOrNamesIt(string kind, double strength)
    {
        (Func<double, Force> force, Vector3D place, Vector3D velocity, Vector3D spin, Func<double, double> most) = Kinds[kind];
        foreach ((MotionLaw law, double tolerance) in Laws)
        {
            string? refusal = Play(b => With(b, force(strength), law, tolerance, place, velocity, spin), out BodyState ball);
            if (refusal is not null)
            {
                Assert.Contains("'ball'", refusal, StringComparison.Ordinal);
                Assert.Contains("'it'", refusal, StringComparison.Ordinal);
                Assert.True(strength >= 1e3 || law == MotionLaw.ClosedForm, refusal); // the control: what is weak is followed
                Assert.DoesNotContain("NaN", refusal, StringComparison.Ordinal);
                continue;
            }

            Assert.True(ball.Position.IsFinite, $"{law} {ball.Position}");
            bool isFixed = law == MotionLaw.RungeKutta4 || tolerance == 0;
            Assert.InRange(ball.Velocity.Length, 0, most(strength) * (isFixed ? 1.1 : 1 + 1e-6)); // within a fixed step as long as is stable a path strays, but what it gains it does not keep
        }
    }

    [Theory]
    [InlineData(MotionLaw.Automatic)]
    [InlineData(MotionLaw.DormandPrince54)]
    public void Spring_WhosePiecesFillTheTimelines_IsNamedWithItsRate(MotionLaw law)
    {
        Scene scene = With(new SceneBuilder("steel"), Force.Spring("coil", V(0), 1e12), law, 1e-9, V(1), V(0), V(0)).Build();
        Simulation simulation = new(scene, new SimulationOptions(maxSegments: 10_000));
        string message = Assert.Throws<TimelinesFullException>(() => simulation.AdvanceTo(At(1))).Message;
        Assert.Contains("10000 segments", message, StringComparison.Ordinal);
        Assert.Contains("body 'ball' (0.0.0): 10000, of ", message, StringComparison.Ordinal);
        Assert.Contains("the history that is kept, 1s, has room for pieces of 0.0001 s", message, StringComparison.Ordinal);
        Assert.EndsWith("On it 'coil' (Spring) acts at 1000000 1/s.", message, StringComparison.Ordinal);
        Assert.Contains("full before the history of 1s is", scene.Explain().Bodies[0].Why, StringComparison.Ordinal);

        Scene slack = With(new SceneBuilder("slack"), Force.Spring("coil", V(0), 1e4), law, 1e-9, V(1), V(0), V(0)).Build();
        Assert.DoesNotContain("full", slack.Explain().Bodies[0].Why, StringComparison.Ordinal); // the control
    }

    /// <summary>A dry brake turns round where the velocity does: error control comes no further, and fixed steps go through.</summary>
    [Fact]
    public void Supplied_ThatJumps_IsNamedWithTheWayOut()
    {
        Simulation controlled = new(Braked(1e-9), new SimulationOptions(maxSegments: 10_000));
        SimulationException failure = Assert.ThrowsAny<SimulationException>(() => controlled.AdvanceTo(At(1)));
        Assert.Contains("body 'ball' (0.0.0)", failure.Message, StringComparison.Ordinal);
        Assert.Contains("If 'brake' jumps", failure.Message, StringComparison.Ordinal);
        Assert.Contains("a tolerance of 0", failure.Message, StringComparison.Ordinal);

        Simulation stepped = Run(Braked(0), 1); // what the sentence advises
        Assert.InRange(Read(stepped, First, 1).Velocity.Length, 0, 5 * 0.005);
        Assert.InRange(stepped.EventsProcessed, 200, 400);

        static Scene Braked(double tolerance) => new SceneBuilder("brake").WithGravity(Floating).AddForce(Force.Supplied(new Brake()), out ForceSet brake)
            .AddBody("ball", new BodySpec(0.1, 1, 1, MotionLaw.DormandPrince54, BodySpec.DefaultStep, brake, tolerance), V(0), V(1)).Build();
    }

    /// <summary>It is no jump that a smaller step would follow; whose force it is, and that it has no number, is told under every law.</summary>
    [Theory]
    [InlineData(MotionLaw.Automatic, 1e-9)]
    [InlineData(MotionLaw.DormandPrince54, 0)]
    [InlineData(MotionLaw.RungeKutta4, 0)]
    public void ForceOfTheProgram_ThatIsNoNumberFromSomeTimeOn_IsSaidToBeNone(MotionLaw law, double tolerance)
    {
        Force broken = Force.Supplied(new FunctionForce((t, _, _) => V(t > 0.5 ? double.NaN : 1)));
        Scene scene = new SceneBuilder("broken").AddForce(broken, out ForceSet own)
            .AddBody("ball", new BodySpec(0.5, 1, 1, law, BodySpec.DefaultStep, own, tolerance), V(0)).Build();
        Simulation world = Run(scene, 0.4);
        string message = Assert.Throws<SimulationException>(() => world.AdvanceTo(At(1))).Message;
        Assert.Contains("the acceleration of body 'ball' (0.0.0) became NaN or infinite; what the forces 'test force' give must be finite", message, StringComparison.Ordinal);
    }

    private sealed class Brake : IAcceleration
    {
        public string Name => "brake";

        public int Version => 1;

        public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => new(velocity.X > 0 ? -5 : velocity.X < 0 ? 5 : 0, 0, 0);
    }

    [Theory]
    [InlineData(-4)]
    [InlineData(-2)]
    [InlineData(-1)]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(4)]
    public void Centre_BodyThatStartsAtIt_IsRefusedWhereThePullHasNoBound(int power)
    {
        foreach ((MotionLaw law, double tolerance) in Laws)
        {
            string? refusal = Play(b => With(b, Force.Central("sun", V(3), 1, power), law, tolerance, V(3), V(0), V(0)), out BodyState ball);
            if (power < 0 || law == MotionLaw.ClosedForm || (power == 0 && (law == MotionLaw.RungeKutta4 || tolerance == 0)))
            {
                Assert.Contains("'ball'", refusal, StringComparison.Ordinal);
                Assert.Contains("'sun'", refusal, StringComparison.Ordinal);
                continue;
            }

            Assert.Null(refusal);
            Assert.Equal(V(3), ball.Position); // nothing pulls it anywhere
        }
    }

    /// <summary>Nor may a player put one there, and so end everybody's world; but where the pull is bounded, or is none on that body, he may.</summary>
    [Theory]
    [InlineData(-2, false)]
    [InlineData(1, true)]
    public void Centre_BodyThatAPlayerPutsThere_IsRefusedToo(int power, bool may)
    {
        Simulation world = new(
            new SceneBuilder("sun").WithGravity(V(0)).WithSmallestRadius(0.1).AddForce(Force.Central("sun", V(3), 1, power), out ForceSet sun)
                .AddBody("drawn", new BodySpec(0.1, 1, 1, forces: sun), V(0)).AddBody("free", new BodySpec(0.1, 1, 1), V(0, 5)).Build(),
            KeepAll);
        ExternalEvent spawn = ExternalEvent.Spawn(At(1e-3), 1, 1, new BodySpec(0.1, 1, 1, forces: sun), V(3)), teleport = ExternalEvent.Teleport(At(1e-3), 1, 2, First, V(3));
        foreach (ExternalEvent put in new[] { spawn, teleport })
        {
            string? refusal = Record.Exception(() => world.Submit(put))?.Message;
            Assert.Equal(may, refusal is null);
            Assert.True(may || refusal!.Contains("'sun'", StringComparison.Ordinal), refusal);
        }

        world.Submit(ExternalEvent.Teleport(At(1e-3), 1, 3, Second, V(3, 0, may ? 1 : 0)));
        world.AdvanceTo(At(0.1));
    }

    /// <summary>What falls straight into a singularity ends there, under fixed steps too: they may not step over it and leave it with any speed.</summary>
    [Theory]
    [InlineData(-4, 1)]
    [InlineData(-3, 1)]
    [InlineData(-2, 1)]
    [InlineData(-1, 1)]
    [InlineData(-4, 1e12)]
    [InlineData(-2, 1e12)]
    public void Centre_BodyThatFallsIntoIt_EndsWithItsName(int power, double strength)
    {
        foreach ((MotionLaw law, double tolerance) in Laws)
        {
            if (law != MotionLaw.ClosedForm)
            {
                string? refusal = Play(b => With(b, Force.Central("sun", V(0), strength, power), law, tolerance, V(1), V(0), V(0)), out BodyState ball, At(2));
                Assert.True(refusal is not null, $"{law} {tolerance}: {ball.Position} {ball.Velocity}");
                Assert.Contains("'ball'", refusal, StringComparison.Ordinal);
                Assert.Contains("'sun'", refusal, StringComparison.Ordinal);
            }
        }

        // The control: what passes it at a distance passes, under every law.
        foreach ((MotionLaw law, double tolerance) in Laws)
        {
            if (law != MotionLaw.ClosedForm)
            {
                Assert.Null(Play(b => With(b, Force.Central("sun", V(0), 1, power), law, tolerance, V(1), V(0, 1.2), V(0)), out _, At(2)));
            }
        }
    }

    private static SceneBuilder With(SceneBuilder builder, Force force, MotionLaw law, double tolerance, Vector3D place, Vector3D velocity, Vector3D spin) => builder
        .WithGravity(Floating).AddForce(force, out ForceSet it).AddBody("ball", new BodySpec(0.5, 1, 1, law, forces: it, tolerance: tolerance), place, velocity, spin: spin);

    /// <summary>Plays until the end or for ten thousand events; what was said where it could not.</summary>
    private static string? Play(Func<SceneBuilder, SceneBuilder> with, out BodyState ball, SimTime? end = null)
    {
        ball = default;
        try
        {
            Simulation simulation = new(with(new SceneBuilder("strong")).Build(), new SimulationOptions(maxSegments: 20_000));
            long events = 10_000;
            simulation.TryAdvanceTo(end ?? End, ref events);
            if (simulation.LostBodies() is [LostBody lost])
            {
                return lost.ToString();
            }

            Assert.True(simulation.TryRead(First, simulation.SimulatedTo, out ball));
            return null;
        }
        catch (Exception refusal) when (refusal is SceneException or SimulationException)
        {
            return refusal.Message;
        }
    }
}
