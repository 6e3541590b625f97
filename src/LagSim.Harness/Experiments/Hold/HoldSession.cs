using System;
using LagSim.Events;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Peers;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>
/// One session as the holder's game plays it: a grab, frames in which <see cref="HandSender"/> decides on keyframes, and a release at the
/// hand's velocity.
/// </summary>
internal sealed class HoldSession
{
    private static readonly BodyId Ball = BodyId.OfScene(0);

    private readonly PeerGroup peers;
    private readonly HandCourse course;
    private readonly Action<SimDuration>? progress;

    /// <summary>Creates a session on a connected group.</summary>
    internal HoldSession(PeerGroup peers, HandCourse course, Action<SimDuration>? progress)
    {
        this.peers = peers;
        this.course = course;
        this.progress = progress;
        LateEvents = new LateEventWatch(peers);
        Hand = new HandWatch(peers);
    }

    /// <summary>The times at which every peer showed each event, and the accepted events.</summary>
    internal LateEventWatch LateEvents { get; }

    /// <summary>The events of the hand that every peer received.</summary>
    internal HandWatch Hand { get; }

    /// <summary>The time of the grab, in shared time.</summary>
    internal SimTime Grab { get; private set; }

    /// <summary>The time at which the ball was lifted and the motion began.</summary>
    internal SimTime MotionStart => Grab + SimDuration.FromSeconds(HandCourse.LiftSeconds);

    /// <summary>The time at which the throw began.</summary>
    internal SimTime ThrowStart => Grab + SimDuration.FromSeconds(course.Release - HandCourse.ThrowSeconds);

    /// <summary>The time of the release.</summary>
    internal SimTime Release { get; private set; }

    /// <summary>The traffic of each peer when the scene had just started.</summary>
    internal PortTraffic[] TrafficAtStart { get; private set; } = [];

    /// <summary>The holder's traffic when the motion began.</summary>
    internal PortTraffic TrafficAtMotion { get; private set; }

    /// <summary>The holder's traffic right before the release.</summary>
    internal PortTraffic TrafficAtThrow { get; private set; }

    /// <summary>The traffic of each peer at the end.</summary>
    internal PortTraffic[] TrafficAtEnd { get; private set; } = [];

    /// <summary>Returns the position of the hand at a shared time; null unless it held the ball then.</summary>
    internal Vector3D? HandAt(SimTime time) => time >= Grab && time <= Release ? course.At((time - Grab).ToSeconds()) : null;

    /// <summary>Plays the session to the end.</summary>
    internal void Play(HoldOptions options)
    {
        SharedClock clock = peers.Session(HoldTest.Holder).SharedTime;
        TrafficAtStart = GroupFigures.Traffic(peers);
        peers.RunUntil(HoldOptions.GrabAfter, progress);
        Grab = Do(PlayerAction.Grab(Ball));
        SimDuration since = Grab - peers.Start;
        SimDuration lifted = since + SimDuration.FromSeconds(HandCourse.LiftSeconds), release = since + SimDuration.FromSeconds(course.Release);
        HandSender sender = new(Ball, new HandSenderOptions { Distance = options.KeyframeDistanceMetres });
        bool isMoving = false;
        for (int frame = 0; since + SimDuration.FromSeconds(frame / (double)HandMotion.RateHertz) is SimDuration due && due < release; frame++)
        {
            peers.RunUntil(due, progress);
            if (!isMoving && due >= lifted)
            {
                isMoving = true;
                TrafficAtMotion = peers.Traffic(HoldTest.Holder);
            }

            SimTime now = clock.Now;
            double held = (now - Grab).ToSeconds();
            if (sender.TrySample(now, course.At(held), course.VelocityAt(held), out PlayerAction keyframe))
            {
                Do(keyframe);
            }
        }

        peers.RunUntil(release, progress);
        TrafficAtThrow = peers.Traffic(HoldTest.Holder);
        Release = Do(PlayerAction.Release(Ball, course.VelocityAt((clock.Now - Grab).ToSeconds())));
        peers.RunQuietlyUntil(options.Length, progress);
        TrafficAtEnd = GroupFigures.Traffic(peers);
        peers.Finish();
    }

    private SimTime Do(PlayerAction action)
    {
        ExternalEvent done = peers.Do(HoldTest.Holder, action);
        LateEvents.Did(done);
        return done.Time;
    }
}
