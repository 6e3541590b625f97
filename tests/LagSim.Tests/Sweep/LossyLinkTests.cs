using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sweep;

/// <summary>
/// How late events are where datagrams are lost in bursts and jitter is large, but nothing is full: no queue may be seen there.
/// </summary>
public sealed class LossyLinkTests(ITestOutputHelper output)
{
    private const int Clients = 3;
    private const int Seconds = 30;
    private const ulong Seeds = 16;

    /// <summary>
    /// The link takes 0.2 s, 0.4 s with its jitter. Where what is lost is repeated every 30 ms, a burst of five datagrams costs 0.15
    /// s, and one of thirty, which one in a thousand is, 0.9 s. Where a queue is seen, repetitions come a round trip apart, and a
    /// burst of five costs two seconds.
    /// </summary>
    [Fact]
    public void Events_OnTheAwfulLink_AreHeardOfWithinBursts()
    {
        double latest = Latenesses(SessionFault.None).Max();
        double control = Latenesses(SessionFault.CountsTripsAgain).Max();
        output.WriteLine(FormattableString.Invariant($"the latest event: {latest:0.00} s; where trips are counted again {control:0.00} s"));
        Assert.InRange(latest, 0.2, 1.3);
        Assert.True(control > 1.5);
    }

    private static List<double> Latenesses(SessionFault fault)
    {
        List<double> late = [];
        for (ulong seed = 1; seed <= Seeds; seed++)
        {
            SessionGroup group = new(BuiltInScenes.Billiards(), Clients + 1, LinkProfiles.Awful, seed, _ => new HostOptions
            {
                // Whatever comes late is to be accepted, and seen.
                Window = new(SimDuration.FromSeconds(5), SimDuration.FromMilliseconds(250)),
                Cancellation = TestContext.Current.CancellationToken,
            });
            foreach (Session session in group.Sessions)
            {
                session.Put(fault);
            }

            group.Host.Logged += entry => late.Add((group.Host.SharedTime.Now - entry.Event.Time).ToSeconds());
            group.Connect();
            for (int second = 1; second < Seconds; second++)
            {
                group.Run(1);
                for (int peer = 1; peer <= Clients; peer++)
                {
                    group.Do(peer, PlayerAction.Impulse(BodyId.OfScene(peer), new Vector3D(0.1, 0, -0.1)));
                }
            }

            Assert.True(group.Settle(Clients * (Seconds - 1)));
        }

        return late;
    }
}
