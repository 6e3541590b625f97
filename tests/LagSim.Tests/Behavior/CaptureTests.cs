using System;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>
/// The third case of rule 7 (docs/CONTACT.md): a ball that strikes something static stays there where its rebound would rise by no more
/// than
/// a height, and all bounces to come would be over within a step. The height is the tolerance for what touches several, and the restitution
/// threshold for what bounces alone. A rebound a little faster is a bounce.
/// </summary>
public sealed class CaptureTests
{
    [Theory]
    [InlineData(0.1, 1e-3, 1e-9)] // the height decides
    [InlineData(0.6, 1e-3, 1e-5)]
    [InlineData(0.9, 1e-3, 1e-6)] // how long the bounces go on decides
    [InlineData(0.99, 1e-4, 1e-7)]
    [InlineData(0.5, 1e-6, 1e-9)]
    public void Rebound_OfABallAlone_UpToTheThreshold_IsTheLast(double restitution, double tolerance, double threshold)
    {
        double step = Math.Sqrt(2 * tolerance / Gravity);
        double bound = Math.Min(Math.Sqrt(2 * Gravity * threshold), Gravity * StepOf(tolerance) * (1 - restitution) / 2);
        Assert.InRange(StepOf(tolerance), step / 2, step);
        Assert.Equal(MotionLaw.Constrained, LawAfterRebound(0.999 * bound, restitution, tolerance, threshold));
        Assert.Equal(MotionLaw.Ballistic, LawAfterRebound(1.001 * bound, restitution, tolerance, threshold));
    }

    /// <summary>
    /// A ball that strikes two at once: on each of them the pull presses with the root of a half. Alone, with that threshold, it would
    /// bounce
    /// on from a hundredth of the speed.
    /// </summary>
    [Theory]
    [InlineData(0.3, 1e-3)]
    [InlineData(0.6, 1e-3)]
    [InlineData(0.9, 1e-3)]
    public void Rebound_OffTwo_UpToTheTolerance_IsTheLast(double restitution, double tolerance)
    {
        double press = Gravity * Math.Sqrt(0.5);
        double bound = Math.Min(Math.Sqrt(2 * press * tolerance), press * StepOf(tolerance) * (1 - restitution) / 2);
        Assert.Equal(MotionLaw.Constrained, LawAfterRebound(0.999 * bound, restitution, tolerance, 1e-9, isBetweenTwo: true));
        Assert.Equal(MotionLaw.Ballistic, LawAfterRebound(1.001 * bound, restitution, tolerance, 1e-9, isBetweenTwo: true));
    }

    /// <summary>
    /// A ball under a force bounces as one under gravity does, down to the restitution threshold, on a plane as on a sphere, and then
    /// rests.
    /// The control: with a threshold as large as the tolerance it stops where it would rise by that.
    /// </summary>
    [Theory]
    [InlineData(0.5, false, 1e-9)]
    [InlineData(0.9, false, 1e-9)]
    [InlineData(0.5, true, 1e-9)]
    [InlineData(0.5, false, 1e-3)]
    public void Bounces_OfABallAlone_UnderAForce_AreThoseOfAGeometricSeries(double restitution, bool isOnASphere, double threshold)
    {
        SceneBuilder builder = new SceneBuilder("bounces").WithGravity(V(0)).WithContactTolerance(1e-3).WithRestitutionThreshold(threshold);
        builder = isOnASphere ? builder.AddStaticSphere("sphere", V(0, -1), 1) : builder.AddPlane("floor", Vector3D.Up, 0);
        Scene scene = builder.AddForce(Force.Central("weight", V(0, -1e6), Gravity, 0), out ForceSet weight)
            .AddBody("ball", new BodySpec(0.1, 1, restitution, forces: weight), V(0, 1.1)).Build();
        Simulation world = Run(scene, 12);
        int expected = (int)Math.Ceiling(Math.Log(1e9) / Math.Log(1 / (restitution * restitution)));
        Assert.Equal(MotionLaw.Resting, Read(world, First, 12).Motion);
        Assert.Equal(threshold == 1e-9, world.ImpactsProcessed == expected);
        if (threshold > 1e-9)
        {
            return;
        }

        double time = Math.Sqrt(2 / Gravity);
        for (int n = 1; n < expected - 1; n++)
        {
            double height = Math.Pow(restitution, 2 * n);
            double apex = time + Math.Sqrt(2 * height / Gravity);
            Assert.Equal(1, (Read(world, First, apex).Position.Y - 0.1) / height, 1e-2);
            time += 2 * Math.Sqrt(2 * height / Gravity);
        }
    }

    /// <summary>
    /// Where gravity is weak a ball that falls on a member bounces as high as it does anywhere: the first case asks what presses, and not
    /// what
    /// a hand might. The control is a fall from so low that the rebound is within the tolerance.
    /// </summary>
    [Theory]
    [InlineData(9.81, 0.02, true)]
    [InlineData(0.05, 0.02, true)]
    [InlineData(0.05, 3e-3, false)]
    public void Rebound_OffAMember_InWeakGravity_RisesAsOnEarth(double gravity, double height, bool bounces)
    {
        Scene scene = new SceneBuilder("weak").WithGravity(V(0, -gravity)).WithContactTolerance(1e-3).AddStaticSphere("rock", V(0, -1), 1)
            .AddBody("member", new BodySpec(0.1, 1000, 0.5), V(0, 0.1)).AddBody("ball", new BodySpec(0.1, 0.001, 0.5), V(0, 0.3 + height)).Build();
        double falls = Math.Sqrt(2 * height / gravity);
        Simulation world = Run(scene, 2.5 * falls);
        double expected = bounces ? 0.25 * height : 0;
        Assert.InRange(Read(world, Second, 1.5 * falls).Position.Y - 0.3, expected - 5e-4, expected + 5e-4);
    }

    /// <summary>
    /// The step of rule 1: the largest power of two of ticks within the time of a fall by the tolerance, where that is below 1/64 s.
    /// </summary>
    private static double StepOf(double tolerance)
    {
        double tick = Time.SimDuration.OneTick.ToSeconds();
        return tick * Math.Pow(2, Math.Floor(Math.Log2(Math.Min(Math.Sqrt(2 * tolerance / Gravity), 1.0 / 64) / tick)));
    }

    private static MotionLaw LawAfterRebound(double rebound, double restitution, double tolerance, double threshold, bool isBetweenTwo = false)
    {
        double aside = isBetweenTwo ? 1.5 * Math.Sqrt(0.5) : 0, below = isBetweenTwo ? aside : 1.5;
        SceneBuilder builder = new SceneBuilder("dome").WithContactTolerance(tolerance).WithRestitutionThreshold(threshold)
            .AddStaticSphere("dome", V(aside, -below), 1);
        builder = isBetweenTwo ? builder.AddStaticSphere("other", V(-aside, -below), 1) : builder;
        double speed = rebound / restitution / (isBetweenTwo ? Math.Sqrt(0.5) : 1);
        Simulation world = new(builder.AddBody("ball", new BodySpec(0.5, 1, restitution), V(0), V(0, -speed)).Build());
        Assert.Equal(1, world.ImpactsProcessed); // at once
        return Read(world, First, 0).Motion;
    }
}
