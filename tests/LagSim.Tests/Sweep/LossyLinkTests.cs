using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Links;
using LagSim.Harness.Peers;
using LagSim.Harness.Scenes;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sweep;

/// <summary>How late news is where datagrams are lost in bursts and jitter is large, but nothing is full: no queue may be seen there.</summary>
public sealed class LossyLinkTests(ITestOutputHelper output)
{
    private const int Joiners = 3;
    private const int Seconds = 30;
    private const ulong Seeds = 16;

    /// <summary>
    /// The link takes 0.2 s, 0.4 s with its jitter. Each repetition after 30 ms, a burst of five lost datagrams costs 0.15 s, and one of thirty, of which
    /// one in a thousand bursts is, 0.9 s. Where a queue is seen, repetitions come a round trip apart, and a burst of five costs two seconds.
    /// </summary>
    [Fact]
    public void News_OnTheAwfulLink_IsHeardOfWithinBursts()
    {
        double latest = Latenesses(SessionFault.None).Max();
        double control = Latenesses(SessionFault.CountsTripsAgain).Max();
        output.WriteLine(FormattableString.Invariant($"the latest of {Seeds * Joiners * (Seconds - 1)} acts: {latest:0.00} s; where trips are counted again {control:0.00} s"));
        Assert.InRange(latest, 0.2, 1.3);
        Assert.True(control > 1.5);
    }

    private static List<double> Latenesses(SessionFault fault)
    {
        List<double> late = [];
        for (ulong seed = 1; seed <= Seeds; seed++)
        {
            VirtualClock clock = new(SimTime.FromSeconds(10));
            VirtualNetwork network = new(clock, seed, LinkProfiles.Awful);
            VirtualSteps steps = new(network);
            List<Session> sessions = [.. Enumerable.Range(0, Joiners + 1).Select(Add)];
            HostSession host = (HostSession)sessions[0];
            host.Logged += entry => late.Add((host.SharedTime.Now - entry.Event.Time).ToSeconds());
            while (!sessions.TrueForAll(s => s.State == SessionState.Running) && clock.Now < SimTime.FromSeconds(60))
            {
                steps.Advance(clock.Now + SimDuration.FromMilliseconds(10));
            }

            SimTime start = clock.Now;
            for (int second = 1; second < Seconds; second++)
            {
                RunTo(start + SimDuration.FromSeconds(second));
                for (int n = 1; n <= Joiners; n++)
                {
                    sessions[n].Do(PlayerAction.Impulse(BodyId.OfScene(n), new Vector3D(0.1, 0, -0.1)));
                    steps.Wake(n);
                }
            }

            RunTo(clock.Now + SimDuration.FromSeconds(5));

            Session Add(int number)
            {
                IDatagramPort port = network.CreatePort(number);
                SessionOptions options = new()
                {
                    ExpectedJoiners = Joiners,
                    Window = new(SimDuration.FromSeconds(5), SimDuration.FromMilliseconds(250)), // so that whatever comes late is accepted, and seen
                    Cancellation = TestContext.Current.CancellationToken,
                };
                Session session = number == 0
                    ? new HostSession(BuiltInScenes.Billiards(), port, clock, options, seed)
                    : new JoinerSession(null, port, clock, options, PeerAddress.Virtual(0), seed + (ulong)number);
                if (number > 0)
                {
                    network.Connect(number, 0, LinkProfiles.Awful);
                }

                session.Fault = fault;
                steps.Add(session, port);
                return session;
            }

            void RunTo(SimTime time)
            {
                while (clock.Now < time)
                {
                    steps.Advance(time);
                }
            }
        }

        Assert.Equal((int)Seeds * Joiners * (Seconds - 1), late.Count);
        return late;
    }
}
