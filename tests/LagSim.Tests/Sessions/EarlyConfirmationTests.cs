using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>What has happened is final as soon as the links allow, and no event is refused for it.</summary>
public sealed class EarlyConfirmationTests
{
    private static readonly SimDuration History = SimDuration.FromSeconds(3);

    private static readonly LinkProfile SlowUp = new("slow up", toHost: new LinkLeg(180, 20), fromHost: new LinkLeg(5, 2));

    private static readonly LinkProfile SlowDown = new("slow down", toHost: new LinkLeg(5, 2), fromHost: new LinkLeg(180, 20));

    [Theory]
    [InlineData(true, 0, 0.06)]
    [InlineData(false, 3, 4)] // the control: a host that does nothing steps its world once a second
    public void Watermark_OfAWorldWithoutPeers_IsAtOnce(bool early, double least, double most)
    {
        SessionGroup group = Group(early, 1, LinkProfiles.Lan);
        Assert.InRange(WorstBehind(group, 5), least, most);
    }

    [Theory]
    [InlineData(true, 0.04, 0.35)]
    [InlineData(false, 3, 4)] // the control: a host that does nothing steps its world once a second
    public void Watermark_OverTheAtlantic_FollowsTheLinks(bool early, double least, double most)
    {
        SessionGroup group = Group(early, 3, LinkProfiles.Transatlantic);
        Assert.InRange(WorstBehind(group, 20), least, most);
    }

    [Fact]
    public void Contacts_OverTheAtlantic_AreConfirmedOnEveryPeerWithinATenthOfTheHistory()
    {
        Assert.InRange(LatestConfirmation(early: true, out int told), 0.04, 0.5);
        Assert.InRange(LatestConfirmation(early: false, out int later), 3, 6); // the control
        Assert.True(told > 20 && later > 20, $"{told} {later}");
    }

    [Theory]
    [InlineData("transatlantic")]
    [InlineData("wifi-busy")]
    [InlineData("4g")]
    [InlineData("awful")]
    [InlineData("starlink")]
    [InlineData("dsl-256k")]
    public void Events_OfHonestClients_AreNeverTooLateForIt(string profile)
    {
        for (int seed = 1; seed <= 4; seed++)
        {
            SessionGroup group = Group(true, 4, LinkProfiles.Get(profile), (ulong)seed);
            List<ExternalEvent> done = new ScriptedActions(seed, maxSpawns: 8) { HasHands = true }.DoIn(group, 60, 0.06);
            Assert.True(group.Settle(done.Count), $"seed {seed}");
            Assert.DoesNotContain(group.Log.Values, entry => entry.Verdict == Verdict.TooLate);
            Assert.All(group.Sessions, session => Assert.Equal(0, session.Counters.EventsLost));
            group.Run(1);
            Assert.Null(group.Difference());
        }
    }

    [Fact]
    public void Events_MoreThanTheHostTakes_AreNotTooLateWhenTheyAreTaken()
    {
        SessionGroup group = Group(true, 2, LinkProfiles.PureDelay(30), events: 20);
        for (int n = 0; n < 60; n++)
        {
            group.Do(1, PlayerAction.Impulse(First, V(0, 0.1)));
            group.Run(0.01);
        }

        Assert.True(group.Settle(60));
        Assert.True(group.Host.Counters.EventsDeferred > 0, "none was left for later");
        Assert.Equal(60, group.Host.Counters.EventsAccepted);
    }

    [Fact]
    public void Newcomers_WhoActAtOnce_AreNotTooLate()
    {
        int acted = 0;
        foreach (LinkProfile link in new[] { SlowUp, SlowDown, LinkProfiles.WifiBusy, LinkProfiles.Lan })
        {
            for (int seed = 1; seed <= 8; seed++)
            {
                SessionGroup group = Group(true, 1, link, (ulong)seed); // alone: whatever is past is final
                group.Run(4);
                for (int address = 1; address <= 2; address++)
                {
                    ClientSession client = group.Join(address, (ulong)address);
                    Assert.True(group.RunUntil(() => client.State == SessionState.Running));
                    group.Do(address, PlayerAction.SetVelocity(First, V(address)));
                    acted++;
                }

                Assert.True(group.Settle(2));
                Assert.Equal(2, group.Host.Counters.EventsAccepted);
                group.Run(1);
                Assert.Null(group.Difference());
            }
        }

        Assert.Equal(64, acted);
    }

    [Fact]
    public void Rejoined_AfterASilence_ActsOn()
    {
        SessionGroup group = Group(true, 3, LinkProfiles.PureDelay(20));
        for (int round = 0; round < 3; round++)
        {
            group.Cut(1, 0);
            group.Cut(0, 1);
            Assert.True(group.RunUntil(() => group.Host.ClientCount == 1, 20));
            group.Restore(1, 0);
            group.Restore(0, 1);
            Assert.True(group.RunUntil(() => group.Host.ClientCount == 2 && group.Client(1).State == SessionState.Running, 20));
            group.Do(1, PlayerAction.SetVelocity(First, V(1)));
            Assert.True(group.Settle(round + 1));
        }

        Assert.Equal(3, group.Host.Counters.EventsAccepted);
    }

    [Fact]
    public void Watermark_WhileAPlayerIsSilent_GoesOnByTheHistory_AndWithoutHimByTheOthers()
    {
        SessionGroup group = Group(true, 3, LinkProfiles.PureDelay(20));
        group.Cut(1, 0);
        group.Run(4.5);
        Assert.InRange(Behind(group), 2.9, 3.1);
        group.Run(4);
        Assert.Equal(1, group.Host.ClientCount);
        Assert.InRange(Behind(group), 0, 0.2);
    }

    [Fact]
    public void Spectators_AreNotWaitedFor()
    {
        SessionGroup group = Group(true, 2, LinkProfiles.PureDelay(20));
        group.Network.Connect(5, 0, LinkProfiles.PureDelay(600));
        ClientSession watcher = group.Join(5, 55, new ClientOptions { Role = PeerRole.Spectator });
        Assert.True(group.RunUntil(() => watcher.State == SessionState.Running));
        Assert.InRange(WorstBehind(group, 5), 0.02, 0.2);
        Assert.Equal(2, group.Host.ClientCount);
    }

    [Fact]
    public void Promise_ThatIsBroken_IsHeldAgainstWhoMadeIt()
    {
        foreach (double promised in new[] { double.NaN, -0.1, 0.0, 5.0 })
        {
            SessionGroup group = Group(true, 1, LinkProfiles.Lan);
            RawClient client = new(group);
            group.Run(1);
            SimTime now = group.Host.SharedTime.Now;
            if (!double.IsNaN(promised))
            {
                client.Promise(1, now + SimDuration.FromSeconds(promised));
            }

            SimTime stamp = now - SimDuration.FromMilliseconds(50);
            client.Claim(1, ExternalEvent.Teleport(stamp, client.Peer, 1, First, V(0, 4)));
            Assert.Equal(promised >= 0 ? Verdict.TooLate : Verdict.Accepted, group.Log[1].Verdict);
            Assert.True(group.Host.Watermark <= group.Host.SharedTime.Now);
        }
    }

    [Fact]
    public void Promise_IsOnlyMadeToAHostThatAsksForIt()
    {
        foreach (bool early in new[] { true, false })
        {
            SessionGroup group = Group(early, 2, LinkProfiles.PureDelay(10));
            long before = group.Client(1).Counters.DatagramsSent;
            group.Run(10);
            Assert.InRange(group.Client(1).Counters.DatagramsSent - before, early ? 150 : 1, early ? 250 : 30);
        }
    }

    private static SessionGroup Group(
        bool early, int peers, LinkProfile link, ulong seed = 1, int events = 500, Func<int, ContactNotices?>? contacts = null) => new SessionGroup(
            ScriptedActions.Box(), peers, link, seed, peer => new HostOptions
            {
                ConfirmsEarly = early,
                MaxEventsPerSecond = events,
                Window = new LatencyCompensationWindow(History, SimDuration.FromMilliseconds(60)).WithLocalLag(EventKind.Impulse, SimDuration.FromMilliseconds(50)),
                Timeout = SimDuration.FromSeconds(6),
                Contacts = contacts?.Invoke(peer),
            }).Connect();

    private static double Behind(SessionGroup group) => (group.Host.SharedTime.Now - group.Host.Watermark).ToSeconds();

    /// <summary>The most by which the watermark was behind, once a history has passed.</summary>
    private static double WorstBehind(SessionGroup group, double seconds)
    {
        group.Run(History.ToSeconds() + 1);
        double worst = 0;
        for (int n = 0; n < 100 * seconds; n++)
        {
            group.Run(0.01);
            worst = Math.Max(worst, Behind(group));
        }

        return worst;
    }

    /// <summary>How long after it happened the last contact was confirmed on any peer.</summary>
    private static double LatestConfirmation(bool early, out int told)
    {
        List<ContactNotices> all = [.. Enumerable.Range(0, 3).Select(_ => new ContactNotices())];
        SessionGroup group = Group(early, 3, LinkProfiles.Transatlantic, contacts: peer => all[peer]);
        double latest = 0;
        told = 0;
        for (int n = 0; n < 1000; n++)
        {
            if (n % 50 == 0)
            {
                group.Do(n % 3, PlayerAction.SetVelocity(First, V(0, 3)));
            }

            group.Run(0.01);
            for (int peer = 0; peer < all.Count; peer++)
            {
                while (all[peer].TryRead(out ContactNotice notice))
                {
                    if (notice.Kind == NoticeKind.Confirmed)
                    {
                        told++;
                        latest = Math.Max(latest, (group.Sessions[peer].SharedTime.Now - notice.Time).ToSeconds());
                    }
                }
            }
        }

        return latest;
    }
}
