using System;
using LagSim.Events;
using LagSim.Harness.Experiments.Peers;
using LagSim.Net.Display;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Display;

/// <summary>Two peers of a session look at the same ball, at 60 frames a second, one of them 100 ms away.</summary>
public sealed class SharedDisplayTests
{
    private const double Kick = 3; // m/s

    [Theory]
    [InlineData("healing")]
    [InlineData("full-rollback")]
    public void Update_WhoHearsLate_SeesOneCorrectionThatComesRightAndWhoDidItNone(string strategy)
    {
        (View host, View client) = Watch(strategy);
        Assert.Equal((0, 0), (host.Offsets.Corrections, host.Offsets.LargestJump));
        Assert.Equal(1, client.Offsets.Corrections);
        Assert.InRange(client.Offsets.LargestJump, Kick * (0.1 - 0.02), Kick * 0.12); // what it has moved meanwhile, give or take a frame
        Assert.True(client.RealStep > 0.2, $"{client.RealStep}"); // the control: without an offset the eye sees it jump
        Assert.InRange(client.DrawnStep, 0.01, 0.1);
        Assert.True(client.Last.Offset.Length < 0.001);
    }

    /// <summary>The longest way in one frame of the ball as it is and as it is drawn, and the last frame.</summary>
    private static (View Host, View Client) Watch(string strategy)
    {
        Scene scene = new SceneBuilder("one").WithGravity(Floating).AddBody("ball", Ball(), V(0)).Build();
        using VirtualPeers peers = new(scene, new PeerGroupOptions(2, LinkProfiles.PureDelay(100), strategy, Length: SimDuration.FromSeconds(4)));
        peers.Connect();
        View[] views = [new View(scene), new View(scene)];
        for (int frame = 60; frame < 180; frame++)
        {
            peers.RunUntil(SimDuration.FromSeconds(frame / 60.0), null);
            for (int peer = 0; peer < views.Length; peer++)
            {
                views[peer].Look(peers.Session(peer));
            }

            if (frame == 70)
            {
                peers.Do(0, PlayerAction.SetVelocity(First, V(Kick)));
            }
        }

        return (views[0], views[1]);
    }

    private sealed class View(Scene scene)
    {
        private bool hasLast;

        internal DisplayOffsets Offsets { get; } = new(scene);

        internal double RealStep { get; private set; }

        internal double DrawnStep { get; private set; }

        internal DrawnBody Last { get; private set; }

        internal void Look(Session session)
        {
            if (!Offsets.Update(session.World!.RenderSnapshots.Latest(), session.SharedTime.Now))
            {
                return;
            }

            Assert.True(Offsets.TryRead(First, out DrawnBody drawn));
            if (hasLast)
            {
                RealStep = Math.Max(RealStep, (drawn.State.Position - Last.State.Position).Length);
                DrawnStep = Math.Max(DrawnStep, (drawn.Position - Last.Position).Length);
            }

            (Last, hasLast) = (drawn, true);
        }
    }
}
