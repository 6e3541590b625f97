using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Players who come back: after their own silence or the host's, from another address, after a restart of theirs or of the host.</summary>
public sealed class ComingBackTests
{
    [Theory]
    [InlineData(35, 60, true)] // longer than the time-out, shorter than the time for which it asks
    [InlineData(75, 60, false)]
    [InlineData(35, 0, false)]
    public void Join_WithAPassWhileTheHostStandsStill_AsksForAsLongAsTheOptionSays(double frozenSeconds, double rejoinSeconds, bool isLetIn)
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5), options: _ => Asking(rejoinSeconds)).Connect();
        PlayerPass pass = group.Client(1).Pass!.Value;
        group.Steps.Freeze(0);
        group.Steps.Freeze(1);
        ClientOptions options = Asking(rejoinSeconds) with { Pass = pass };
        ClientSession again = group.Join(7, 99, options);
        group.Run(frozenSeconds);
        group.Steps.Thaw(0);
        group.Run(5);
        Assert.Equal(isLetIn ? SessionState.Running : SessionState.Ended, again.State);
        Assert.Equal(isLetIn ? 1 : 0, again.Peer);
    }

    [Fact]
    public void Join_WithoutAPass_EndsAfterTheTimeout()
    {
        SessionGroup group = new(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(5));
        group.Steps.Freeze(0);
        ClientSession client = group.Join(7, 99, Asking(60));
        group.Run(11);
        Assert.Equal((SessionState.Ended, SessionEnd.HostSilent), (client.State, client.EndedBy));
    }

    [Fact]
    public void Join_WithAPassAndWelcomedByAHostThatThenStops_AsksAgainOnceItIsThere()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5)).Connect();
        ClientOptions options = Asking(60) with { Pass = group.Client(1).Pass!.Value };
        group.Steps.Freeze(1);
        ClientSession again = group.Join(7, 99, options);
        Assert.True(group.RunUntil(() => again.State == SessionState.Synchronising));
        group.Steps.Freeze(0);
        group.Run(30);
        group.Steps.Thaw(0);
        group.Run(5);
        Assert.Equal((SessionState.Running, 1), (again.State, again.Peer));
    }

    [Fact]
    public void Rejoining_OneWhoSleepsMeanwhile_DoesNotCountItsSleep()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5), options: _ => Asking(30)).Connect();
        group.Steps.Freeze(0);
        group.Run(15);
        Assert.Equal(SessionState.Rejoining, group.Client(1).State);
        group.Steps.Freeze(1);
        group.Run(60);
        group.Steps.Thaw(1);
        group.Run(5); // it has asked for 10 s of 30
        group.Steps.Thaw(0);
        group.Run(5);
        Assert.Equal((SessionState.Running, 1), (group.Client(1).State, group.Client(1).Peer));
    }

    [Fact]
    public void FellBehind_OneWhoStandsStillWhileOthersPlay_IsSilentAndNotTooSlow()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(50)).Connect();
        List<string> interruptions = [];
        group.Client(1).Interrupted += interruptions.Add;
        for (int round = 0; round < 3; round++)
        {
            for (int n = 0; n < 400; n++)
            {
                group.Do(2, PlayerAction.SetVelocity(BodyId.OfScene(0), V(0.1)));
                group.Run(0.05); // an event is always on its way
                if (n == 50)
                {
                    group.Steps.Freeze(1);
                }
            }

            group.Steps.Thaw(1);
            group.Run(10);
            Assert.Equal((SessionState.Running, 1 + round), (group.Client(1).State, interruptions.Count));
        }

        Assert.DoesNotContain(interruptions, why => why.Contains("too slow", System.StringComparison.Ordinal));
        Assert.Equal(group.Host.LogLength, group.Client(1).LogLength);
    }

    [Fact]
    public void Rejoin_ManyFreezesSoonAfterEachOther_AreNotTakenForCopiesOfNoUse()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5)).Connect();
        for (int round = 0; round < 6; round++)
        {
            group.Steps.Freeze(1);
            group.Run(15);
            group.Steps.Thaw(1);
            group.Run(10);
            Assert.Equal((SessionState.Running, 1), (group.Client(1).State, group.Client(1).Peer));
        }

        Assert.Equal(6, group.Client(1).Counters.Renewals);
        Assert.Equal(0, group.Client(1).Counters.StatesDiffered);
    }

    [Fact]
    public void Join_AnOldOneThatComesLate_DoesNotDisturbThePlayerWhoIsInAgain()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5)).Connect();
        byte[]? late = null;
        group.Network.Lose((from, _, datagram) =>
        {
            if (from != 1 || datagram.Span[3] != (byte)DatagramType.Join || late is not null)
            {
                return false;
            }

            late = datagram.ToArray(); // the first goes astray
            return true;
        });
        group.Cut(1, 0);
        group.Cut(0, 1);
        group.Run(12);
        Assert.Equal(SessionState.Rejoining, group.Client(1).State);
        group.Restore(1, 0);
        group.Restore(0, 1);
        Assert.True(group.RunUntil(() => group.Client(1).State == SessionState.Running && late is not null), "it was not let in again");
        group.Run(1);
        List<string> interruptions = [];
        group.Client(1).Interrupted += interruptions.Add;
        long renewals = group.Client(1).Counters.Renewals;

        // As its first attempt's, of another nonce than the one that was welcome: the cookie is good for it, so the host takes it for one that starts anew.
        PlayerPass pass = group.Client(1).Pass!.Value;
        Token128 cookie = default;
        const ulong old = 0x01D;
        byte[] request = new byte[WireFormat.ConnectRequestBytes];
        new ConnectRequestDatagram(old).Encode(request);
        group.Network.Lose((from, to, datagram) =>
        {
            if (from == 0 && to == 1 && ChallengeDatagram.TryDecode(datagram.Span, out ChallengeDatagram challenge, out _) && challenge.Nonce == old)
            {
                cookie = challenge.Cookie;
            }

            return false;
        });
        group.Ports[1].Send(request, PeerAddress.Virtual(0));
        group.Run(0.1);
        byte[] join = new byte[WireFormat.JoinBytes];
        new JoinDatagram(
            old, cookie, JoinCookies.Prove("", old, cookie), group.Scene.Hash, (uint)Simulation.FoldVersion, pass.Number,
            JoinCookies.Prove(pass.Secret, old, cookie)).Encode(join);
        group.Ports[1].Send(join, PeerAddress.Virtual(0));
        group.Run(30);
        Assert.Empty(interruptions);
        Assert.Equal((SessionState.Running, renewals), (group.Client(1).State, group.Client(1).Counters.Renewals));
        Assert.Equal(1, group.Host.ClientCount);
    }

    [Fact]
    public void SnapshotRequest_FromAnotherAddress_IsAnsweredByAChallengeUntilTheAddressIsShown()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(20)).Connect();
        group.Run(3);
        List<(int Length, DatagramType Type)> toNewAddress = [];
        bool hasMoved = false, isShown = false;
        int asked = 0;
        group.Network.Lose((from, to, datagram) =>
        {
            DatagramType type = (DatagramType)datagram.Span[3];
            isShown |= from == 2 && hasMoved && type == DatagramType.Move;
            asked += from == 2 && hasMoved && !isShown ? datagram.Length : 0;
            if (from == 0 && to == 2 && hasMoved && !isShown)
            {
                toNewAddress.Add((datagram.Length, type));
            }

            return from == 2 && hasMoved && !isShown && type == DatagramType.Update; // its fetches alone tell where it is
        });
        ClientSession late = group.Join(2, 99);
        Assert.True(group.RunUntil(() => late.State == SessionState.Synchronising));
        group.Network.Move(2, 1002);
        hasMoved = true;
        Assert.True(group.RunUntil(() => late.State == SessionState.Running, 5), $"{late.State} {late.EndReason}");
        Assert.True(isShown);
        Assert.Contains(toNewAddress, d => d.Type == DatagramType.MoveChallenge);
        Assert.True(toNewAddress.Sum(d => d.Length) <= 3 * asked, $"{toNewAddress.Sum(d => d.Length)} bytes for {asked}");
        Assert.DoesNotContain(toNewAddress, d => d.Type == DatagramType.SnapshotChunk && d.Length > 3 * WireFormat.SnapshotRequestBytes);
    }

    [Fact]
    public void Move_EveryTenSecondsOverALinkOfFourThereAndBack_IsNoSilence()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(2000)).Connect();
        List<string> interruptions = [];
        group.Client(1).Interrupted += interruptions.Add;
        for (int n = 0; n < 12; n++)
        {
            group.Network.Move(1, 1000 + n);
            group.Run(10);
        }

        group.Run(10);
        Assert.Empty(interruptions);
        Assert.Equal(SessionState.Running, group.Client(1).State);
        Assert.Equal(0, group.Client(1).Counters.StatesDiffered);
        Assert.True(group.Client(1).Counters.StatesAgreed > 90);
    }

    [Fact]
    public void Join_AnAddressThatChangesBeforeTheWelcome_GetsAnotherCookieSoon()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(20)).Connect();
        bool hasMoved = false;
        group.Network.Lose((from, _, datagram) => from == 2 && !hasMoved && datagram.Span[3] == (byte)DatagramType.Join);
        ClientSession late = group.Join(2, 99);
        group.Run(0.5);
        group.Network.Move(2, 1002); // its cookie is of the former address
        hasMoved = true;
        Assert.True(group.RunUntil(() => late.State == SessionState.Running, 5), $"{late.State} {late.EndReason}");
    }

    [Fact]
    public void PassGiven_BeforeThereIsAWorld_IsWhatComesBackWithTheNumber()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(20)).Connect();
        ClientSession late = group.Join(2, 99);
        List<(PlayerPass Pass, bool HasWorld)> given = [];
        late.PassGiven += pass => given.Add((pass, late.World is not null));
        Assert.True(group.RunUntil(() => given.Count > 0));
        group.Steps.Freeze(2); // killed at once
        Assert.Equal([(late.Pass!.Value, false)], given);
        group.Ports[2].Dispose();
        ClientSession again = group.Join(3, 100, new ClientOptions { Pass = given[0].Pass });
        Assert.True(group.RunUntil(() => again.State == SessionState.Running));
        Assert.Equal(late.Peer, again.Peer);
    }

    [Fact]
    public void Join_AHostThatWasStartedAnew_GivesTheNumberThatOneHadIfItIsFree()
    {
        SessionGroup first = new SessionGroup(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(5)).Connect();
        PlayerPass pass = first.Sessions.OfType<ClientSession>().Single(j => j.Peer == 2).Pass!.Value;

        SessionGroup second = new(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(5), options: _ => Asking(60));
        second.Run(1);
        ClientSession back = second.Join(1, 5, new ClientOptions { Pass = pass });
        Assert.True(second.RunUntil(() => back.State == SessionState.Running));
        Assert.Equal(2, back.Peer);
        Assert.NotEqual(pass, back.Pass); // of this host

        ClientSession other = second.Join(2, 6, new ClientOptions { Pass = pass }); // the number is taken, and the pass shows nothing
        Assert.True(second.RunUntil(() => other.State == SessionState.Running));
        Assert.Equal((1, SessionState.Running), (other.Peer, back.State));

        second.Run(60); // from then on a number cannot be chosen any more
        PlayerPass foreign = default;
        Assert.True(PlayerPass.TryParse("7-" + new string('a', 32), out foreign));
        ClientSession late = second.Join(3, 7, new ClientOptions { Pass = foreign });
        Assert.True(second.RunUntil(() => late.State == SessionState.Running));
        Assert.Equal(3, late.Peer);
    }

    private static ClientOptions Asking(double seconds) => new() { RejoinTime = SimDuration.FromSeconds(seconds) };
}
