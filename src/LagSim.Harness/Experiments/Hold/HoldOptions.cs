using System;
using System.Threading;
using LagSim.Harness.Experiments.Hands;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>What a session in which a hand holds and throws the ball is to do.</summary>
/// <param name="Motion">How the hand moves while it holds.</param>
public sealed record HoldOptions(HandMotion Motion)
{
    /// <summary>How long after the start of the scene the hand takes the ball, which rests until then.</summary>
    public static readonly SimDuration GrabAfter = SimDuration.FromMilliseconds(500);

    /// <summary>How long a run goes on after the throw: time for the last of the events, by the slowest link.</summary>
    public static readonly SimDuration Afterwards = SimDuration.FromSeconds(6);

    /// <summary>The shortest hold, in seconds: what a predictor needs to learn anything.</summary>
    public const double ShortestSeconds = 1;

    /// <summary>The longest hold, in seconds: all of a run's timelines are kept, and a session keeps them for a minute.</summary>
    public const double LongestSeconds = 50;

    /// <summary>The longest hold by default in real time, in seconds, which are waited for.</summary>
    public const double RealSeconds = 20;

    /// <summary>
    /// How long the hand does the motion, <see cref="ShortestSeconds"/> to <see cref="LongestSeconds"/>, and no longer than the motion is.
    /// </summary>
    public double HoldSeconds { get; init; } = Math.Min(LongestSeconds, Motion.Seconds);

    /// <summary>By how many metres the others may be off before the hand tells where it is, above 0.</summary>
    public double KeyframeDistanceMetres { get; init; } = new HandSenderOptions().Distance;

    /// <summary>What the peers do with late events.</summary>
    public string Strategy { get; init; } = LateEventStrategies.Default;

    /// <summary>How far behind shared time <c>interpolation</c> shows the world.</summary>
    public SimDuration DisplayDelay { get; init; } = Interpolation.DefaultDelay;

    /// <summary>The link of each client to the host.</summary>
    public LinkProfile Link { get; init; } = LinkProfiles.PureDelay(100);

    /// <summary>The delay that <see cref="Link"/> adds one way, if it is nothing but that; else null.</summary>
    public double? DelayMilliseconds { get; init; } = 100;

    /// <summary>How many peers, the host included; 2 to 9. The first client has the hand, the others look on.</summary>
    public int Peers { get; init; } = 2;

    /// <summary>Whether it runs in virtual time; else over real UDP.</summary>
    public bool IsVirtual { get; init; } = true;

    /// <summary>The luck of links and clocks.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>
    /// Ends a run in virtual time, in the middle of a step if need be, by an <see cref="OperationCanceledException"/>; default none. In
    /// real time whoever is told of progress ends it, by an exception.
    /// </summary>
    public CancellationToken Cancellation { get; init; }

    /// <summary>How long the run takes, from the start of the scene.</summary>
    public SimDuration Length => GrabAfter + SimDuration.FromSeconds(HandCourse.LiftSeconds + HoldSeconds) + Afterwards;

    /// <summary>
    /// The scene: a ball of radius 0.1 m and 0.4 kg at rest on a floor, in flight moved by Runge-Kutta steps as in the drop test.
    /// </summary>
    public static Scene BuildScene() => new SceneBuilder("hold")
        .AddPlane("floor", Vector3D.Up, Vector3D.Zero)
        .AddBody("ball", new BodySpec(HandCourse.BallRadius, 0.4, 0.6, MotionLaw.RungeKutta4), HandCourse.Rest)
        .Build();
}
