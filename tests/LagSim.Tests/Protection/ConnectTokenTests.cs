using System;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Protection;

/// <summary>Sessions whose players a backend admits: who has a good token is in once, who has not is told what to do.</summary>
public sealed class ConnectTokenTests : IDisposable
{
    private static readonly DateTimeOffset Noon = new(2026, 11, 27, 12, 0, 0, TimeSpan.Zero);
    private static readonly PlayerAdmission Ada = new("account 4711", "Ada");

    private readonly HostIdentity identity = HostIdentity.Draw();
    private readonly TokenIssuer issuer = TokenIssuer.Draw();
    private DateTimeOffset hostClock = Noon;

    public void Dispose()
    {
        identity.Dispose();
        issuer.Dispose();
    }

    [Fact]
    public void Join_WithAToken_IsInAsThatPlayer()
    {
        SessionGroup group = Hosting();
        ClientSession ada = Join(group, 1, issuer.Issue(new PlayerAdmission("account 4711", "Ada Lovelace", number: 3), identity.Fingerprint, now: Noon));
        Assert.True(group.RunUntil(() => ada.State == SessionState.Running, 3), ada.EndReason);
        Assert.Equal(3, ada.Peer);
        PlayerAdmission known = group.Host.AdmissionOf(3)!;
        Assert.Equal(("account 4711", "Ada Lovelace", PlayerRights.All), (known.PlayerId, known.Name, known.Rights));
        Assert.Null(group.Host.AdmissionOf(1));
    }

    [Theory]
    [InlineData("none", "admits only players with a connect token")]
    [InlineData("changed", "not a valid connect token, or it was altered")]
    [InlineData("noise", "not a valid connect token")]
    [InlineData("of another key", "from another backend")]
    [InlineData("for another host", "for another host")]
    [InlineData("expired", "over 3 s ago, by the host's clock")]
    [InlineData("clock an hour fast", "over 3540 s ago, by the host's clock")]
    [InlineData("clock an hour slow", "begins in 3590 s, by the host's clock")]
    [InlineData("used", "came in with the connect token before")]
    public void Join_WithAnythingElse_IsRefusedWithWhatToDo(string what, string why)
    {
        SessionGroup group = Hosting();
        using TokenIssuer other = TokenIssuer.Draw();
        using HostIdentity otherHost = HostIdentity.Draw();
        byte[] token = (what == "of another key" ? other : issuer).Issue(
            Ada, what == "for another host" ? otherHost.Fingerprint : identity.Fingerprint, now: Noon);
        switch (what)
        {
            case "none":
                token = [];
                break;
            case "changed":
                token[^70] ^= 1;
                break;
            case "noise":
                Random.Shared.NextBytes(token);
                break;
            case "expired":
                hostClock = Noon.AddSeconds(63);
                break;
            case "clock an hour fast":
                hostClock = Noon.AddHours(1);
                break;
            case "clock an hour slow":
                hostClock = Noon.AddHours(-1);
                break;
            case "used":
                ClientSession first = Join(group, 1, token);
                Assert.True(group.RunUntil(() => first.State == SessionState.Running, 3));
                break;
        }

        ClientSession client = Join(group, 2, token);
        Assert.True(group.RunUntil(() => client.State is SessionState.Ended or SessionState.Running, 3));
        Assert.Equal((SessionState.Ended, SessionEnd.Refused), (client.State, client.EndedBy));
        Assert.Contains(why, client.EndReason, StringComparison.Ordinal);
    }

    [Fact]
    public void Join_SameTokenTwiceAtOnce_LetsOneIn()
    {
        SessionGroup group = Hosting();
        byte[] token = issuer.Issue(Ada, identity.Fingerprint, now: Noon);
        ClientSession[] both = [Join(group, 1, token), Join(group, 2, token)];
        Assert.True(group.RunUntil(() => both.All(c => c.State is SessionState.Running or SessionState.Ended), 5));
        Assert.Equal(1, group.Host.ClientCount);
        Assert.Contains("before", both.Single(c => c.State == SessionState.Ended).EndReason, StringComparison.Ordinal);
    }

    /// <summary>One player has one place: another token for it moves it there, with its number.</summary>
    [Fact]
    public void Join_SamePlayerWithAnotherToken_TakesItsPlaceOver()
    {
        SessionGroup group = Hosting();
        ClientSession first = Join(group, 1, issuer.Issue(Ada, identity.Fingerprint, now: Noon));
        Assert.True(group.RunUntil(() => first.State == SessionState.Running, 3));
        ClientSession second = Join(group, 2, issuer.Issue(Ada, identity.Fingerprint, now: Noon));
        Assert.True(group.RunUntil(() => second.State == SessionState.Running && first.State == SessionState.Ended, 5), second.EndReason);
        Assert.Equal((first.Peer, 1), (second.Peer, group.Host.ClientCount));
        Assert.Contains("came in from elsewhere", first.EndReason, StringComparison.Ordinal);
    }

    /// <summary>Who is sent away for its cost and comes back by its pass may do no more than its token says.</summary>
    [Theory]
    [InlineData(PlayerRights.Act, Verdict.NoRight)]
    [InlineData(PlayerRights.All, Verdict.Accepted)] // the control
    public void Join_ByThePassOfOneThatWasSentAway_HasTheRightsOfItsToken(PlayerRights rights, Verdict expected)
    {
        SessionGroup group = Hosting(new PlayerBudget(1, 60));
        ClientSession ada = Join(group, 1, issuer.Issue(new PlayerAdmission("ada", "Ada", rights), identity.Fingerprint, now: Noon));
        Assert.True(group.RunUntil(() => ada.State == SessionState.Running, 3), ada.EndReason);
        PlayerPass pass = ada.Pass!.Value;
        for (int n = 0; n < 100 && ada.State == SessionState.Running; n++)
        {
            ada.Do(PlayerAction.SetVelocity(BodyId.OfScene(0), new Vector3D(0, 1, 0)));
            group.Run(0.02);
        }

        Assert.Equal(SessionEnd.Kicked, ada.EndedBy);
        ClientSession early = Return(2);
        Assert.True(group.RunUntil(() => early.State == SessionState.Ended, 3));
        Assert.Contains("shut out this player", early.EndReason, StringComparison.Ordinal);
        group.Run(61);
        ClientSession again = Return(3);
        Assert.True(group.RunUntil(() => again.State == SessionState.Running, 3), again.EndReason);
        Assert.Equal("ada", group.Host.AdmissionOf(again.Peer)?.PlayerId);
        Verdict? verdict = null;
        group.Host.Logged += entry => verdict = entry.Event.Peer == again.Peer ? entry.Verdict : verdict;
        again.Do(PlayerAction.Spawn(new BodySpec(0.25, 1, 0.5), new Vector3D(0, 2, 0), default));
        group.Run(0.5);
        Assert.Equal(expected, verdict);

        ClientSession Return(int address) => group.Join(
            address, (ulong)(1000 + address), new ClientOptions { Protection = new SecureClient(identity.Fingerprint), Pass = pass });
    }

    /// <summary>A token gives no number that another player has, nor one that a key is for; the player may have another number later.</summary>
    [Fact]
    public void Join_WithTheNumberOfAnother_IsRefusedAndTheTokenNotUsed()
    {
        SessionGroup group = Hosting();
        ClientSession ada = Join(group, 1, issuer.Issue(new PlayerAdmission("ada", number: 3), identity.Fingerprint, now: Noon));
        Assert.True(group.RunUntil(() => ada.State == SessionState.Running, 3));
        byte[] token = issuer.Issue(new PlayerAdmission("bob", number: 3), identity.Fingerprint, now: Noon);
        ClientSession bob = Join(group, 2, token);
        Assert.True(group.RunUntil(() => bob.State == SessionState.Ended, 3));
        Assert.Contains("full", bob.EndReason, StringComparison.Ordinal);
        Assert.Equal((SessionState.Running, 1), (ada.State, group.Host.ClientCount));
        ada.Leave();
        group.Run(0.2);
        bob = Join(group, 4, token);
        Assert.True(group.RunUntil(() => bob.State == SessionState.Running, 3), bob.EndReason);
        Assert.Equal(3, bob.Peer);

        ClientSession keyed = Join(group, 5, issuer.Issue(new PlayerAdmission("eve", number: 8), identity.Fingerprint, now: Noon));
        Assert.True(group.RunUntil(() => keyed.State == SessionState.Ended, 3));
        Assert.Contains("full", keyed.EndReason, StringComparison.Ordinal);
    }

    /// <summary>A player that is sent away while another join of it is on its way, by its pass, is not let in by that either.</summary>
    [Fact]
    public void Join_ByAPassThatBecameVoidMeanwhile_IsRefused()
    {
        SessionGroup group = Hosting();
        ClientSession ada = Join(group, 1, issuer.Issue(Ada, identity.Fingerprint, now: Noon));
        Assert.True(group.RunUntil(() => ada.State == SessionState.Running, 3));
        ClientSession again = group.Join(2, 99, new ClientOptions { Protection = new SecureClient(identity.Fingerprint), Pass = ada.Pass!.Value });
        Assert.True(group.RunUntil(() => again.State == SessionState.Synchronising, 3));
        Assert.True(group.Host.Kick(ada.Peer));
        Assert.True(group.RunUntil(() => again.State is SessionState.Ended or SessionState.Running, 3));
        Assert.Contains("admits only players with a connect token", again.EndReason, StringComparison.Ordinal);
        Assert.Equal(0, group.Host.ClientCount);
    }

    /// <summary>Seven players of one school: limits by address are not for who has a token, as each has one place.</summary>
    [Fact]
    public void Join_ManyPlayers_EachHasAPlace()
    {
        SessionGroup group = Hosting();
        ClientSession[] all = [.. Enumerable.Range(1, SessionOptions.MaxClients - 1).Select(n => Join(group, n, issuer.Issue(new PlayerAdmission($"p{n}"), identity.Fingerprint, now: Noon)))];
        Assert.True(group.RunUntil(() => all.All(c => c.State == SessionState.Running), 10), string.Join(" ", all.Select(c => c.EndReason)));
        ClientSession last = Join(group, 40, issuer.Issue(new PlayerAdmission("one more"), identity.Fingerprint, now: Noon));
        Assert.True(group.RunUntil(() => last.State == SessionState.Ended, 3));
        Assert.Contains("full", last.EndReason, StringComparison.Ordinal);
    }

    /// <summary>A player who comes back by its pass, and with the key of another number, has that and no other.</summary>
    [Fact]
    public void Join_ByAPassAndTheKeyOfAnotherNumber_HasOnePlace()
    {
        SessionGroup group = Hosting();
        ClientSession ada = Join(group, 1, issuer.Issue(Ada, identity.Fingerprint, now: Noon));
        Assert.True(group.RunUntil(() => ada.State == SessionState.Running, 3));
        ClientSession again = group.Join(
            2, 99, new ClientOptions { Protection = new SecureClient(identity.Fingerprint), Pass = ada.Pass!.Value, ConnectKey = "a key" });
        Assert.True(group.RunUntil(() => again.State == SessionState.Running && ada.State == SessionState.Ended, 3), again.EndReason);
        Assert.Equal((1, 8), (group.Host.ClientCount, again.Peer));
    }

    /// <summary>A player with two good tokens who comes in twice at once has one place all the same.</summary>
    [Fact]
    public void Join_SamePlayerTwiceAtOnce_HasOnePlace()
    {
        SessionGroup group = Hosting();
        ClientSession[] both = [.. Enumerable.Range(1, 2).Select(n => Join(group, n, issuer.Issue(Ada, identity.Fingerprint, now: Noon)))];
        Assert.True(group.RunUntil(() => both.Count(c => c.State == SessionState.Running) == 1 && both.Count(c => c.State == SessionState.Ended) == 1, 5));
        Assert.Equal((1, 1), (group.Host.ClientCount, both.Single(c => c.State == SessionState.Running).Peer)); // and keeps its number
    }

    [Theory]
    [InlineData(0)]
    [InlineData(5)]
    public void Rejoin_AfterSilence_NeedsNoOtherToken(int minutes)
    {
        SessionGroup group = Hosting();
        ClientSession ada = Join(group, 1, issuer.Issue(Ada, identity.Fingerprint, now: Noon));
        Assert.True(group.RunUntil(() => ada.State == SessionState.Running, 3));
        group.Cut(1, 0);
        group.Cut(0, 1);
        Assert.True(group.RunUntil(() => ada.State == SessionState.Rejoining && group.Host.ClientCount == 0, 30));
        hostClock = Noon.AddMinutes(minutes); // its token, which it still shows, is used, and later over
        group.Restore(1, 0);
        group.Restore(0, 1);
        Assert.True(group.RunUntil(() => ada.State == SessionState.Running, 10), ada.EndReason);
        Assert.Equal("Ada", group.Host.AdmissionOf(ada.Peer)!.Name);
    }

    [Theory]
    [InlineData(PlayerRights.None, Verdict.NoRight, Verdict.NoRight)]
    [InlineData(PlayerRights.Act, Verdict.Accepted, Verdict.NoRight)]
    [InlineData(PlayerRights.Spawn, Verdict.NoRight, Verdict.Accepted)]
    [InlineData(PlayerRights.All, Verdict.Accepted, Verdict.Accepted)]
    public void Do_WhatTheTokenGrants_AndNothingElse(PlayerRights rights, Verdict impulse, Verdict spawn)
    {
        SessionGroup group = Hosting();
        ClientSession ada = Join(group, 1, issuer.Issue(new PlayerAdmission("a", rights: rights), identity.Fingerprint, now: Noon));
        Assert.True(group.RunUntil(() => ada.State == SessionState.Running, 3));
        group.Do(1, PlayerAction.Impulse(First, V(0, 1)));
        group.Do(1, PlayerAction.Spawn(Ball(), V(0, 30)));
        Assert.True(group.Settle(2));
        Assert.Equal([impulse, spawn], group.Log.Values.Select(e => e.Verdict));
    }

    [Fact]
    public void Token_ForWhoeverAnswersFirst_IsRefused()
    {
        SessionGroup group = Hosting();
        byte[] token = issuer.Issue(Ada, identity.Fingerprint, now: Noon);
        Assert.Throws<ArgumentException>(() => group.Join(1, 7, new ClientOptions { Protection = SecureClient.TrustOnFirstUse(), Token = token }));
        Assert.Throws<ArgumentException>(() => group.Join(2, 7, new ClientOptions { Token = token }));
        ArgumentException tooLong = Assert.Throws<ArgumentException>(
            () => group.Join(3, 7, new ClientOptions { Protection = new SecureClient(identity.Fingerprint), Token = new byte[257] }));
        Assert.Contains("257 bytes", tooLong.Message, StringComparison.Ordinal);
    }

    /// <summary>Whatever is done to a token, it is not taken for a good one, and nothing throws.</summary>
    [Fact]
    public void Read_ChangedAnywhere_IsNotGood()
    {
        SecureHost host = new(identity, issuer.Key, () => Noon);
        byte[] token = issuer.Issue(new PlayerAdmission("é", new string('x', 64), PlayerRights.Act, 8), identity.Fingerprint, now: Noon);
        Assert.Equal(TokenFault.None, host.ReadToken(token).Fault);
        Assert.InRange(token.Length, 1, IHostProtection.MaxTokenBytes);
        for (int bit = 0; bit < 8 * token.Length; bit++)
        {
            byte[] changed = [.. token];
            changed[bit / 8] ^= (byte)(1 << (bit % 8));
            Assert.NotEqual(TokenFault.None, host.ReadToken(changed).Fault);
        }

        for (int length = 0; length < token.Length; length++)
        {
            Assert.Equal(TokenFault.Damaged, host.ReadToken(token.AsSpan(0, length)).Fault);
        }

        Assert.Equal(TokenFault.Damaged, host.ReadToken([.. token, 0]).Fault);
        Assert.False(new SecureHost(identity).RequiresToken);
        Assert.Equal(TokenFault.OtherIssuer, new SecureHost(identity).ReadToken(token).Fault);
    }

    /// <summary>Two joins with one token began before it expired; the second gets ready after that.</summary>
    [Fact]
    public void Use_AgainAfterItExpired_IsRefused()
    {
        SecureHost host = new(identity, issuer.Key, () => hostClock);
        byte[] token = issuer.Issue(Ada, identity.Fingerprint, now: Noon), other = issuer.Issue(Ada, identity.Fingerprint, now: Noon);
        Assert.True(host.TryUseToken(token));
        hostClock = Noon.AddMinutes(20);
        Assert.True(host.TryUseToken(other)); // whatever is forgotten is forgotten now
        Assert.False(host.TryUseToken(token));
    }

    /// <summary>
    /// The host's date is moved ahead for a while, another player comes in, and it is moved back: the used token is shown again. The control
    /// forgets by the date, a day after a token ends, as the host once did.
    /// </summary>
    [Fact]
    public void Use_AgainAfterTheClockWasMoved_OnlyWhereTheDateForgets()
    {
        TimeSpan elapsed = TimeSpan.Zero;
        SecureHost host = new(identity, issuer.Key, () => hostClock, () => elapsed);
        byte[] token = issuer.Issue(Ada, identity.Fingerprint, now: Noon);
        Assert.True(host.TryUseToken(token));
        hostClock = Noon.AddDays(3);
        elapsed = TimeSpan.FromSeconds(5);
        Assert.True(host.TryUseToken(issuer.Issue(new PlayerAdmission("bob"), identity.Fingerprint, now: hostClock)));
        Assert.True(ConnectToken.TryReadId(token, out _, out long until));
        bool isForgottenByDate = until + 86_400 <= hostClock.ToUnixTimeSeconds();
        hostClock = Noon.AddSeconds(10);
        Assert.Equal(TokenFault.Used, host.ReadToken(token).Fault);
        Assert.False(host.TryUseToken(token));
        Assert.True(isForgottenByDate && until > hostClock.ToUnixTimeSeconds()); // forgotten, and good again
        Assert.Equal(TokenFault.None, new SecureHost(identity, issuer.Key, () => hostClock).ReadToken(token).Fault);
    }

    /// <summary>After two days used tokens are forgotten; a date that is moved back then does not bring one back, and new ones are good.</summary>
    [Fact]
    public void Use_ForgottenWithTheClockMovedBack_IsRefused()
    {
        TimeSpan elapsed = TimeSpan.Zero;
        SecureHost host = new(identity, issuer.Key, () => hostClock, () => elapsed);
        byte[] token = issuer.Issue(Ada, identity.Fingerprint, now: Noon);
        Assert.True(host.TryUseToken(token));
        elapsed = TimeSpan.FromDays(2);
        hostClock = Noon.AddDays(2);
        byte[] later = issuer.Issue(Ada, identity.Fingerprint, now: hostClock);
        Assert.True(host.TryUseToken(later));
        Assert.Equal(TokenFault.None, host.ReadToken(issuer.Issue(Ada, identity.Fingerprint, now: hostClock)).Fault);
        hostClock = Noon.AddSeconds(10);
        Assert.Equal(TokenFault.Expired, host.ReadToken(token).Fault);
        Assert.False(host.TryUseToken(token));
    }

    [Fact]
    public void Issue_OutOfRange_IsRefused()
    {
        Assert.Throws<ArgumentException>(() => issuer.Issue(Ada, default));
        Assert.Throws<ArgumentOutOfRangeException>(() => issuer.Issue(Ada, identity.Fingerprint, TimeSpan.FromDays(2)));
        Assert.Throws<ArgumentException>(() => new PlayerAdmission(""));
        Assert.Throws<ArgumentException>(() => new PlayerAdmission(new string('é', 33)));
        Assert.Throws<ArgumentException>(() => new PlayerAdmission("\ud800"));
        Assert.Throws<ArgumentException>(() => new PlayerAdmission("a", "\u001b[2J"));
        Assert.Throws<ArgumentOutOfRangeException>(() => new PlayerAdmission("a", number: 17));
        Assert.Throws<ArgumentOutOfRangeException>(() => new PlayerAdmission("a", rights: (PlayerRights)4));
        Assert.True(TokenIssuer.TryParse(issuer.ToSecretText(), out TokenIssuer? again));
        Assert.Equal(issuer.Key, again!.Key);
        again.Dispose();
        Assert.True(TokenKey.TryParse(issuer.Key.ToString(), out TokenKey? key) && key!.Equals(issuer.Key));
        Assert.False(TokenKey.TryParse(new string('f', 64), out _)); // no point of the curve
        Assert.DoesNotContain(issuer.ToSecretText(), issuer.ToString(), StringComparison.Ordinal);
    }

    private SessionGroup Hosting(PlayerBudget? budget = null)
    {
        SessionGroup group = new(
            ScriptedActions.Box(), 1, LinkProfiles.Loopback, expected: 0,
            options: _ => new HostOptions
            {
                Protection = new SecureHost(identity, issuer.Key, () => hostClock),
                PlayerBudget = budget ?? PlayerBudget.Default,
                PlayerKeys = new System.Collections.Generic.Dictionary<byte, string> { [8] = "a key" },
            });
        group.Run(1);
        return group;
    }

    private ClientSession Join(SessionGroup group, int address, byte[] token) => group.Join(
        address, (ulong)(1000 + address), new ClientOptions { Protection = new SecureClient(identity.Fingerprint), Token = token });
}
