using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>
/// What a force does to a ball that lies, slips or rolls on a floor: it is followed by steps that are short enough, or the ball leaves the world with a sentence that names it,
/// the force and the number; at no event is the ball faster than energy lets it be.
/// </summary>
public sealed class StiffContactTests
{
    private const double Fast = 10;

    /// <summary>By kind: the force of a strength on a ball of a gram, and the most speed that it may have.</summary>
    private static readonly Dictionary<string, (Func<double, Force> Force, Func<double, double> Most)> Kinds = new()
    {
        ["linear drag"] = (c => Force.LinearDrag("it", c), _ => Fast),
        ["quadratic drag"] = (k => Force.QuadraticDrag("it", k), _ => Fast),
        ["damper"] = (c => Force.Spring("it", V(0, 0.1), 1e-3, c), _ => Fast + 1),
        ["spring"] = (k => Force.Spring("it", V(0, 0.1), k), k => 1.2 * Math.Sqrt((Fast * Fast) + (1e3 * k))), // where omega h is 1, Verlet's is off by 1.155
        ["magnetic"] = (q => Force.Magnetic("it", V(0, 1, 0), q), _ => Fast), // it presses and lifts, and where it lifts, the ball flies in circles
        ["Magnus"] = (s => Force.Magnus("it", s), _ => Fast),
        ["pull"] = (g => Force.Central("it", V(0, 0.1), g, 2), g => 1.2 * Math.Sqrt((Fast * Fast) + g)),
    };

    public static TheoryData<string, double, double> Strengths
    {
        get
        {
            TheoryData<string, double, double> data = [];
            foreach (string kind in Kinds.Keys)
            {
                foreach (double strength in new[] { 1e-3, 1, 30, 1e3, 1e4, 1e9, 1e20 })
                {
                    data.Add(kind, strength, 0);
                    data.Add(kind, strength, 1);
                }
            }

            return data;
        }
    }

    [Theory]
    [MemberData(nameof(Strengths))]
    public void Force_OnWhatLiesOnAFloor_IsFollowedOrNamed(string kind, double strength, double friction)
    {
        (Func<double, Force> force, Func<double, double> most) = Kinds[kind];
        Simulation? simulation = null;
        Exception? refusal = Record.Exception(() => Advance(simulation = new(On(force(strength), 1e-3, friction), KeepAll), 1e-3));
        string? told = refusal?.Message ?? (simulation!.LostBodies() is [LostBody lost] ? lost.ToString() : null);
        if (told is null)
        {
            Assert.InRange(simulation!.Timeline(First).Max(entry => entry.State.Velocity.Length), 0, most(strength) * (1 + 1e-9));
            Assert.True(strength < 1e9 || kind is "spring" or "pull" or "Magnus", "followed"); // the control: what is strong is not
            return;
        }

        Assert.Contains("'ball'", told, StringComparison.Ordinal);
        Assert.Contains("'it'", told, StringComparison.Ordinal);
        Assert.True(strength >= 30, told); // the control: what is weak is followed
        Assert.True(refusal is null or SceneException, told); // what is too strong at any speed is refused with the scene
    }

    /// <summary>A ball on which a force gets too strong leaves the world there, and until then all is finite; the world goes on.</summary>
    [Fact]
    public void Force_ThatGetsTooStrong_TakesTheBallOutOfTheWorld()
    {
        Simulation simulation = new(On(Force.Magnus("swerve", 0.1), 1e-6, 1), KeepAll); // friction has it turn ever faster
        double fastest = 0;
        for (int n = 1; n < 100; n++)
        {
            simulation.AdvanceTo(At(n * 1e-6));
            fastest = simulation.TryRead(First, At(n * 1e-6), out BodyState ball) ? Math.Max(fastest, ball.Velocity.Length) : fastest;
        }

        Assert.InRange(fastest, 0, Fast * 1.01);
        LostBody lost = Assert.Single(simulation.LostBodies());
        Assert.Equal((First, LossReason.TooStiff), (lost.Body, lost.Reason));
        Assert.Contains("'swerve' (Magnus) acts at ", lost.ToString(), StringComparison.Ordinal);
        Simulation heavier = new(On(Force.Magnus("swerve", 0.1), 1e-2, 1), KeepAll); // the control
        Advance(heavier, 1e-2);
        Assert.Empty(heavier.LostBodies());
    }

    /// <summary>At the start of the first step nothing turns, so nothing tells how strong the Magnus force will be at its end: the step is taken anew, shorter.</summary>
    [Fact]
    public void Force_ThatGetsStrongWithinAStep_IsFollowedByAShorterOne()
    {
        Simulation simulation = new(On(Force.Magnus("swerve", 0.1), 2e-5, 1, isStill: true), KeepAll);
        Advance(simulation, 1e-3);
        TimelineEntry[] steps = [.. simulation.Timeline(First).Where(entry => entry.State.Motion == MotionLaw.Constrained)];
        double whole = 1 / Tolerance.StepsASecond(simulation.Scene.ContactTolerance);
        Assert.InRange(Shortest(steps), 1e-7, 0.9 * whole);
        simulation = new(On(Force.Magnus("swerve", 0.1), 1, 1, isStill: true), KeepAll); // the control: a heavy ball, which a whole step follows
        Advance(simulation, 5 * whole);
        steps = [.. simulation.Timeline(First).Where(entry => entry.State.Motion == MotionLaw.Constrained)];
        Assert.Equal(whole, Shortest(steps));
    }

    /// <summary>The shortest of the steps, but for what an impact opened at a tick.</summary>
    private static double Shortest(TimelineEntry[] steps) =>
        steps.Zip(steps.Skip(1), (step, next) => next.Key.Time.SecondsSince(step.Key.Time)).Where(length => length > 0).Min();

    [Fact]
    public void StrongForce_HeardOfLate_HealsToTheSameBits()
    {
        Scene scene = On(Force.LinearDrag("oil", 300), 1e-3, 1); // 0.29 of what a step follows
        ExternalEvent push = ExternalEvent.SetVelocity(At(1e-4), 1, 1, First, V(0, 0, 3));
        Simulation inTime = new(scene, KeepAll), late = new(scene, KeepAll);
        inTime.Submit(push);
        inTime.AdvanceTo(At(1e-3));
        late.AdvanceTo(At(5e-4));
        late.Submit(push);
        late.AdvanceTo(At(1e-3));
        Assert.Equal(inTime.StateHash(At(1e-3)), late.StateHash(At(1e-3)));
        Assert.Equal(inTime.EventHash(At(1e-3)), late.EventHash(At(1e-3)));
        Assert.InRange(inTime.EventsProcessed, 100, 2000); // it was steps that were healed
    }

    /// <summary>A magnetic field along the floor presses and lifts what rolls across it, and does nothing else; it drives away nothing that lies still.</summary>
    [Theory]
    [InlineData(0.05)]
    [InlineData(0.001)]
    public void MagneticField_AlongTheFloor_DrivesNothing(double speed)
    {
        foreach (double strength in new[] { 0.1, 10, 100 })
        {
            Assert.Equal(V(speed), Turned(V(0, 0, 1), strength, speed, out _));
            Vector3D turned = Turned(V(0, 1, 0), strength, speed, out double angle); // the control: upright it turns what moves
            Assert.Equal(speed, turned.Length, 1e-12 * speed);
            Assert.InRange(Math.Abs(Math.Atan2(turned.Z, turned.X) - Math.IEEERemainder(angle, 2 * Math.PI)), 0, 1e-9 + (angle / 12 / 256)); // z^2/12 of it, z at most 1/16
        }
    }

    /// <summary>How a ball of a kilogram moves after half a second; the angle is by how much it should have turned.</summary>
    private static Vector3D Turned(Vector3D field, double strength, double speed, out double angle)
    {
        Scene scene = new SceneBuilder("coil").WithSmallestRadius(0.1).AddForce(Force.Magnetic("coil", field, strength)).AddPlane("floor", Vector3D.Up, 0.0, 0)
            .WithContactTolerance(1e-4).AddBody("ball", new BodySpec(0.1, 1, 0, forces: ForceSet.Of(0)), V(0, 0.1), V(speed)).Build();
        double middle = 0.5 + (0.5 / Tolerance.StepsASecond(1e-4)); // of a step, of which its velocity is
        BodyState state = Read(Run(scene, middle), First, middle);
        Assert.Equal(MotionLaw.Constrained, state.Motion);
        angle = strength * middle; // v x B turns x to z where B is up
        return state.Velocity;
    }

    private static Scene On(Force force, double mass, double friction, bool isStill = false) => new SceneBuilder("floor").WithSmallestRadius(0.1).AddForce(force)
        .AddPlane("floor", Vector3D.Up, 0.0, 0, friction)
        .AddBody("ball", new BodySpec(0.1, mass, 0, forces: ForceSet.Of(0), tolerance: 1e-5, friction: friction), V(0, 0.1), V(Fast), spin: V(0, isStill ? 0 : friction)).Build();

    private static void Advance(Simulation simulation, double seconds)
    {
        long events = 20_000;
        Assert.True(simulation.TryAdvanceTo(At(seconds), ref events));
    }
}
