using System;
using System.Diagnostics;
using System.Net;
using System.Threading;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>The tutorial's loop, over real sockets, while its host is killed and started again.</summary>
[Trait("Time", "real")]
public sealed class GameLoopTests
{
    [Theory]
    [InlineData(true)]
    [InlineData(false)] // the control: the loop as it was, which a rejoin ended
    public void Loop_WhoseHostIsKilledAndStartedAgain_GoesOnInTheNewWorld(bool survives)
    {
        Scene scene = BuiltInScenes.Pair();
        BodyId ball = BodyId.OfScene(0);
        UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        PeerThread first = new(new HostSession(scene, port, new StopwatchClock(), new HostOptions(), 1), port, "first host");
        first.Start();
        int udp = port.LocalAddress.ToEndPoint().Port;
        using PeerThread me = PeerThread.Join(new IPEndPoint(IPAddress.Loopback, udp));
        Assert.True(me.WaitUntilRunning(TimeSpan.FromSeconds(20)), me.Session.WhyNotRunning);
        int refused = 0;
        me.Refused += (_, _) => refused++;
        LiveWorld before = me.Session.World!;
        PeerThread? second = null;
        bool isBack = false;
        Stopwatch watch = Stopwatch.StartNew();
        for (int frame = 0; watch.Elapsed < TimeSpan.FromSeconds(20) && !isBack && (survives ? me.State != SessionState.Ended : me.State == SessionState.Running); frame++)
        {
            if (frame == 10)
            {
                first.Dispose(); // as if killed: neither is its port its own, nor does it say goodbye
                port.Dispose();
                second = PeerThread.Host(scene, udp, bind: IPAddress.Loopback);
            }

            if (frame % 3 == 0 && me.State == SessionState.Running)
            {
                _ = me.Do(PlayerAction.Impulse(ball, new Vector3D(0, 1, 0)));
            }

            isBack = me.Latest() is RenderSnapshot snapshot && snapshot.TryRead(ball, me.Session.DisplayTime, out _) && me.Session.World != before;
            Thread.Sleep(1000 / 60);
        }

        second?.Dispose();
        Assert.Equal((survives, true), (isBack, second is not null));
        Assert.InRange(refused, 0, 1); // the one at the moment of the loss
    }
}
