using System;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Protection;

/// <summary>Sessions whose datagrams are sealed: who gets in, who does not and is told why, and that all else is as without.</summary>
public sealed class ProtectedSessionTests : IDisposable
{
    private readonly HostIdentity identity = HostIdentity.Draw();

    public void Dispose() => identity.Dispose();

    [Theory]
    [InlineData("loopback")]
    [InlineData("wifi-busy")]
    [InlineData("awful")]
    [InlineData("dsl-256k")]
    public void Session_Protected_AgreesAsWithout(string link)
    {
        SessionGroup group = new(ScriptedActions.Box(), 3, LinkProfiles.All.Single(l => l.Name == link), options: Protected());
        group.Connect();
        int done = 0;
        for (; done < 40; done++)
        {
            group.Do(done % 3, PlayerAction.Impulse(done % 2 == 0 ? First : Second, V(0.5, 1)));
            group.Run(0.05);
        }

        Assert.True(group.Settle(done));
        group.Run(5);
        Assert.Null(group.Difference());
        Assert.All(group.Sessions, s => Assert.True(s.IsProtected && s.Counters.StatesDiffered == 0 && s.Counters.DatagramsForged == 0));
        Assert.All(group.Sessions, s => Assert.True(s.Counters.StatesAgreed > 0 || s == group.Host));
    }

    [Fact]
    public void Join_LateAndFirstUse_IsInAndKnowsTheHost()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, options: Protected());
        group.Connect();
        group.Run(5);
        SecureClient trusting = SecureClient.TrustOnFirstUse();
        Assert.Null(trusting.Host);
        ClientSession late = group.Join(2, 99, new ClientOptions { Protection = trusting });
        Assert.True(group.RunUntil(() => late.State == SessionState.Running, 5), late.EndReason);
        Assert.Equal(identity.Fingerprint, trusting.Host);
        Assert.Equal(0, late.Counters.DatagramsForged);
    }

    [Fact]
    public void Join_OtherFingerprint_IsNotLetInAndSaysWhy()
    {
        using HostIdentity other = HostIdentity.Draw();
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, options: Protected());
        group.Connect();
        ClientSession stranger = group.Join(2, 99, new ClientOptions { Protection = new SecureClient(other.Fingerprint) });
        Assert.True(group.RunUntil(() => stranger.State == SessionState.Ended, 15));
        Assert.Equal(SessionEnd.HostSilent, stranger.EndedBy);
        Assert.Contains("another identity than this peer was told", stranger.EndReason, StringComparison.Ordinal);
        Assert.True(stranger.Counters.DatagramsForged > 0);
        Assert.Equal(1, group.Host.ClientCount);
    }

    [Theory]
    [InlineData("right", null)]
    [InlineData("wrong", "the key is wrong")]
    [InlineData("", "it needs a key, and this peer has none")]
    public void Join_WithAConnectKey_IsDecidedAtOnce(string key, string? refusal)
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, options: Protected("right"));
        group.Connect();
        ClientSession client = group.Join(2, 99, new ClientOptions { Protection = new SecureClient(identity.Fingerprint), ConnectKey = key });
        Assert.True(group.RunUntil(() => client.State is SessionState.Running or SessionState.Ended, 2));
        Assert.Equal(refusal is null ? SessionState.Running : SessionState.Ended, client.State);
        Assert.Contains(refusal ?? "", client.EndReason ?? "", StringComparison.Ordinal);
        Assert.True(refusal is null || client.EndedBy == SessionEnd.Refused);
    }

    [Fact]
    public void Join_WithAPlayersKey_GetsThatNumber()
    {
        SessionGroup group = new(
            ScriptedActions.Box(), 2, LinkProfiles.Loopback, expected: 0,
            options: peer => peer == 0
                ? new HostOptions { Protection = new SecureHost(identity), PlayerKeys = new System.Collections.Generic.Dictionary<byte, string> { [5] = "five" } }
                : new ClientOptions { Protection = new SecureClient(identity.Fingerprint), ConnectKey = "five" });
        group.Connect();
        Assert.Equal(5, group.Sessions[1].Peer);
    }

    [Fact]
    public void Join_OneOfTheTwoUnprotected_SaysSo()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, options: Protected());
        group.Connect();
        ClientSession plain = group.Join(2, 99);
        Assert.True(group.RunUntil(() => plain.State == SessionState.Ended, 2));
        Assert.Contains("its session is protected", plain.EndReason, StringComparison.Ordinal);
        Assert.False(plain.IsProtected);

        SessionGroup open = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback);
        open.Connect();
        ClientSession secure = open.Join(2, 99, new ClientOptions { Protection = SecureClient.TrustOnFirstUse() });
        Assert.True(open.RunUntil(() => secure.State == SessionState.Ended, 15));
        Assert.Contains("whose session is not protected", secure.EndReason, StringComparison.Ordinal);
        Assert.Equal(1, open.Host.ClientCount);
    }

    [Fact]
    public void Host_RestartedWithItsIdentity_IsKnownAgainAtOnce()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, options: Protected(), expected: 0);
        group.Connect();
        group.Run(3);
        HostSession restarted = Restart(group, identity);
        Assert.True(group.RunUntil(() => group.Client(1).State == SessionState.Rejoining, 3)); // a reset, not the time-out of 10 s
        Assert.True(group.RunUntil(() => group.Client(1).State == SessionState.Running, 5), group.Client(1).EndReason);
        Assert.Equal(1, restarted.ClientCount);
        Assert.Equal(1, group.Client(1).Counters.Renewals);
    }

    [Fact]
    public void Host_RestartedAsAnother_IsNotJoined()
    {
        using HostIdentity other = HostIdentity.Draw();
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, options: Protected(), expected: 0);
        group.Connect();
        HostSession restarted = Restart(group, other);
        group.Run(60);
        Assert.Equal((SessionState.Rejoining, 0), (group.Client(1).State, restarted.ClientCount));
        Assert.True(group.RunUntil(() => group.Client(1).State == SessionState.Ended, 130));
        Assert.Contains("another identity", group.Client(1).EndReason, StringComparison.Ordinal);
    }

    /// <summary>
    /// A game that sends a player away as soon as it comes, in the handler that tells it so: the link's keys are wiped in the middle of a
    /// step.
    /// </summary>
    [Fact]
    public void Client_KickedAsItComes_EndsNothingElse()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, options: Protected());
        group.Connect();
        group.Host.ClientCame += link => Assert.True(group.Host.Kick(link.Peer));
        ClientSession late = group.Join(2, 99, new ClientOptions { Protection = new SecureClient(identity.Fingerprint) });
        Assert.True(group.RunUntil(() => late.State == SessionState.Ended, 3));
        Assert.Equal((SessionEnd.Kicked, 1, SessionState.Running), (late.EndedBy, group.Host.ClientCount, group.Host.State));
    }

    [Fact]
    public void Client_KickedOrLeaving_IsTold()
    {
        SessionGroup group = new(ScriptedActions.Box(), 3, LinkProfiles.Loopback, options: Protected());
        group.Connect();
        Assert.True(group.Host.Kick(1));
        group.Run(0.5);
        Assert.Equal(SessionEnd.Kicked, group.Client(1).EndedBy);
        group.Client(2).Leave();
        group.Run(0.5);
        Assert.Equal(0, group.Host.ClientCount);
    }

    [Fact]
    public void Datagrams_OfAProtectedSession_FitAndCostWhatThePageSays()
    {
        int longest = 0;
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, options: Protected());
        SessionGroup open = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback);
        long sealedBytes = 0, plainBytes = 0, sealedOnes = 0, plainOnes = 0;
        bool isTelling = false;
        group.Network.Lose((_, _, datagram) => Count(datagram.Length, ref sealedBytes, ref sealedOnes));
        open.Network.Lose((_, _, datagram) => Count(datagram.Length, ref plainBytes, ref plainOnes));
        foreach (SessionGroup one in new[] { group, open })
        {
            isTelling = false;
            one.Connect();
            one.Run(5);
            isTelling = true;
            one.Run(60);
        }

        Assert.Equal(plainOnes, sealedOnes);
        Assert.Equal(plainBytes + (WireFormat.SealBytes * plainOnes), sealedBytes);
        Assert.True(longest <= WireFormat.MaxBytes);

        bool Count(int length, ref long bytes, ref long ones)
        {
            longest = Math.Max(longest, length);
            bytes += isTelling ? length : 0;
            ones += isTelling ? 1 : 0;
            return false;
        }
    }

    private static HostSession Restart(SessionGroup group, HostIdentity with) => group.RestartHost(new HostOptions { Protection = new SecureHost(with) });

    private Func<int, SessionOptions> Protected(string key = "") => peer => peer == 0
        ? new HostOptions { Protection = new SecureHost(identity), ConnectKey = key }
        : new ClientOptions { Protection = new SecureClient(identity.Fingerprint), ConnectKey = key };
}
