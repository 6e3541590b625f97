using System;
using System.Collections.Generic;
using System.Threading;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Peers;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>The options of a session in which a hand holds and throws the ball.</summary>
/// <param name="Motion">The motion of the hand while it holds.</param>
public sealed record HoldOptions(HandMotion Motion)
{
    /// <summary>The time of the grab after the start of the scene. The ball rests until then.</summary>
    public static readonly SimDuration GrabAfter = SimDuration.FromMilliseconds(500);

    /// <summary>How long a run continues after the throw: time for the last events on the slowest link.</summary>
    public static readonly SimDuration Afterwards = SimDuration.FromSeconds(6);

    /// <summary>The shortest hold, in seconds: the least a predictor needs to learn.</summary>
    public const double ShortestSeconds = 1;

    /// <summary>The longest hold, in seconds: all timelines of a run are kept, and a session keeps at most a minute.</summary>
    public const double LongestSeconds = 50;

    /// <summary>The longest default hold in real time, in seconds.</summary>
    public const double RealSeconds = 20;

    /// <summary>The one-way delays of Fig 4 and 5, in milliseconds: by default there is a run for each.</summary>
    public static IReadOnlyList<double> Delays { get; } = [0, 25, 50, 100, 200, 300, 500];

    /// <summary>
    /// The duration of the motion, <see cref="ShortestSeconds"/> to <see cref="LongestSeconds"/>, and at most that of the recording.
    /// </summary>
    public double HoldSeconds { get; init; } = Math.Min(LongestSeconds, Motion.Seconds);

    /// <summary>The prediction error of other peers, in metres, at which the hand sends a keyframe; above 0.</summary>
    public double KeyframeDistanceMetres { get; init; } = new HandSenderOptions().Distance;

    /// <summary>The strategy of the peers for late events.</summary>
    public string Strategy { get; init; } = LateEventStrategies.Default;

    /// <summary>How far behind shared time <c>interpolation</c> shows the world.</summary>
    public SimDuration DisplayDelay { get; init; } = Interpolation.DefaultDelay;

    /// <summary>The link of each client to the host.</summary>
    public LinkProfile Link { get; init; } = LinkProfiles.PureDelay(100);

    /// <summary>The one-way delay of <see cref="Link"/>, if it adds only that; else null.</summary>
    public double? DelayMilliseconds { get; init; } = 100;

    /// <summary>The number of peers, the host included; 2 to 9. The first client has the hand, the others watch.</summary>
    public int Peers { get; init; } = 2;

    /// <summary>Whether it runs in virtual time; else over real UDP.</summary>
    public bool IsVirtual { get; init; } = true;

    /// <summary>The carrier of datagrams in real time.</summary>
    public Carrier Carrier { get; init; } = Carrier.Udp;

    /// <summary>The seed of links and clocks.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>
    /// Cancels a run in virtual time, in mid-step if need be, with an <see cref="OperationCanceledException"/>; default none. In real time
    /// the progress callback may end it with an exception.
    /// </summary>
    public CancellationToken Cancellation { get; init; }

    /// <summary>The length of the run, from the start of the scene.</summary>
    public SimDuration Length => GrabAfter + SimDuration.FromSeconds(HandCourse.LiftSeconds + HoldSeconds) + Afterwards;

    /// <summary>These options over a link with that delay one way, in milliseconds.</summary>
    public HoldOptions At(double delay) => this with { Link = LinkProfiles.PureDelay(delay), DelayMilliseconds = delay };

    /// <summary>
    /// The scene: a ball of radius 0.1 m and 0.4 kg at rest on a floor, in flight moved by Runge-Kutta steps as in the drop test.
    /// </summary>
    public static Scene BuildScene() => new SceneBuilder("hold")
        .AddPlane("floor", Vector3D.Up, Vector3D.Zero)
        .AddBody("ball", new BodySpec(HandCourse.BallRadius, 0.4, 0.6, MotionLaw.RungeKutta4), HandCourse.Rest)
        .Build();
}
