using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>When a keyframe is due, and what that costs.</summary>
public sealed class HandSenderTests
{
    private const int UdpAndIp = 28;

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void TrySample_OfAHand_KeepsWhatTheOthersForetellWithinTheDistance(bool isSlow)
    {
        foreach (double distance in new[] { 0.002, 0.01, 0.05 })
        {
            HandMotion hand = new(3, isSlow);
            HandSender sender = new(First, new HandSenderOptions { Distance = distance, Shortest = SimDuration.FromMilliseconds(1) });
            List<(SimTime Time, Vector3D Position, Vector3D Velocity)> sent = [];
            List<double> errors = [];
            for (int frame = 0; frame < 60 * 30; frame++)
            {
                (SimTime time, Vector3D position, Vector3D velocity) = Sample(hand, frame);
                if (sender.TrySample(time, position, velocity, out PlayerAction keyframe))
                {
                    sent.Add((time, position, velocity));
                    Assert.Equal(ExternalEvent.HoldKeyframe(time, 1, 1, First, position, velocity), keyframe.Stamp(time, 1, 1));
                }

                errors.Add((HandPath.Position(sent[^1].Position, sent[^1].Velocity, time - sent[^1].Time) - position).Length);
            }

            Assert.InRange(errors.Max(), 0, distance);
            Assert.InRange(sender.GreatestError, distance, 0.2); // the control: there was something to be sent
            Assert.Equal(sent.Count, sender.KeyframesSent);
            Assert.All(sent.Zip(sent.Skip(1)), pair => Assert.True(pair.Second.Time - pair.First.Time < SimDuration.FromMilliseconds(420)));
        }
    }

    [Fact]
    public void TrySample_OfAHandThatKeepsStill_IsDueOnlySoThatTheHoldLasts()
    {
        HandSender sender = new(First, new HandSenderOptions { Longest = SimDuration.FromMilliseconds(250) });
        for (int frame = 0; frame < 600; frame++)
        {
            sender.TrySample(At(frame / 60.0), V(1), V(0), out _);
        }

        Assert.Equal(40, sender.KeyframesSent);
        Assert.Equal(0, sender.GreatestError);
    }

    [Fact]
    public void TrySample_SameSamples_GivesTheSameKeyframes()
    {
        long[] keyframes = [Count(3), Count(3), Count(4)];
        Assert.Equal(keyframes[0], keyframes[1]);
        Assert.NotEqual(keyframes[0], keyframes[2]);

        static long Count(int seed)
        {
            HandSender sender = new(First);
            HandMotion hand = new(seed, isSlow: false);
            for (int frame = 0; frame < 3000; frame++)
            {
                (SimTime time, Vector3D position, Vector3D velocity) = Sample(hand, frame);
                sender.TrySample(time, position, velocity, out _);
            }

            return sender.KeyframesSent;
        }
    }

    [Fact]
    public void Options_OutOfRange_AreRefusedByName()
    {
        Refused("0", new HandSenderOptions { Distance = 0 });
        Refused("NaN", new HandSenderOptions { Distance = double.NaN });
        Refused("longest", new HandSenderOptions { Longest = SimDuration.FromMilliseconds(501) });
        Refused("longest", new HandSenderOptions { Longest = SimDuration.Zero });
        Refused("least", new HandSenderOptions { Shortest = SimDuration.Zero });
        Refused("least", new HandSenderOptions { Shortest = SimDuration.FromMilliseconds(401) });
        HandSender sender = new(First);
        Assert.True(sender.TrySample(At(1), V(0), V(0), out _));
        Assert.False(sender.TrySample(At(1), V(9), V(0), out _));
        Assert.Contains("in the order", Assert.Throws<ArgumentOutOfRangeException>(() => sender.TrySample(At(0.9), V(0), V(0), out _)).Message, StringComparison.Ordinal);

        static void Refused(string word, HandSenderOptions options) =>
            Assert.Contains(word, Assert.Throws<ArgumentOutOfRangeException>(() => new HandSender(First, options)).Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(100, true, 3_000)]
    [InlineData(100, false, 4_812)]
    [InlineData(500, false, 4_812)] // each keyframe travels twice, however many are under way
    public void Traffic_OfOneHand_IsBelowTheAim(int milliseconds, bool isSlow, double bytesASecond)
    {
        Scene scene = new SceneBuilder("hand").AddPlane("floor", Vector3D.Up, V(0, -2), 0.5).AddBody("ball", Ball(0.1), V(0)).Build();
        SessionGroup group = new SessionGroup(scene, 2, LinkProfiles.PureDelay(milliseconds), 1, _ => new HostOptions { Window = new(SimDuration.FromSeconds(3)) }).Connect();
        ClientSession player = group.Client(1);
        HandMotion hand = new(5, isSlow);
        HandSender sender = new(First);
        group.Do(1, PlayerAction.Grab(First));
        (long Up, long Down) before = Traffic();
        double worst = 0;
        List<double> errors = [];
        const int seconds = 60;
        for (int frame = 0; frame < 60 * seconds; frame++)
        {
            (SimTime _, Vector3D position, Vector3D velocity) = Sample(hand, frame);
            if (sender.TrySample(player.SharedTime.Now, position, velocity, out PlayerAction keyframe))
            {
                group.Do(1, keyframe);
            }

            double error = (Read(group.Host.World!.Simulation, First, group.Host.SharedTime.Now).Position - position).Length;
            worst = Math.Max(worst, frame > 60 ? error : 0);
            errors.Add(error);
            group.Run(1.0 / 60);
        }

        (long Up, long Down) after = Traffic();
        double up = (after.Up - before.Up) / (double)seconds, down = (after.Down - before.Down) / (double)seconds;
        string figures = FormattableString.Invariant(
            $"{(isSlow ? "slow" : "random")}: {sender.KeyframesSent / (double)seconds:F1} knots/s, up {up:F0} B/s, down {down:F0} B/s, error mean {errors.Average():F4} m, worst {worst:F3} m");
        TestContext.Current.TestOutputHelper?.WriteLine(figures);
        Assert.True(up + down < bytesASecond, figures); // 4.7 KiB, both ways together
        Assert.True(up > 300, figures);
        Assert.True(errors.Average() < 0.001 * milliseconds, figures);
        Assert.True(group.Host.World!.Simulation.TryReadHold(First, group.Host.SharedTime.Now, out _)); // it lasted

        (long Up, long Down) Traffic()
        {
            LinkTraffic link = player.Links.Single();
            return (link.BytesSent + (UdpAndIp * player.Counters.DatagramsSent), link.BytesReceived + (UdpAndIp * player.Counters.DatagramsReceived));
        }
    }

    /// <summary>What a game has of a hand in a frame: where it is, and how far that is from where it was a frame before.</summary>
    private static (SimTime Time, Vector3D Position, Vector3D Velocity) Sample(HandMotion hand, int frame)
    {
        double t = 1 + (frame / 60.0);
        Vector3D now = hand.At(t);
        return (At(t), now, (now - hand.At(t - (1 / 60.0))) * 60);
    }
}
