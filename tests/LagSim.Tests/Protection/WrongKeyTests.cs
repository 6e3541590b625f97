using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Hosts;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>Who guesses connect keys at the host is slowed down, alone and all together, and the host's operator is told; who comes back is not.</summary>
public sealed class WrongKeyTests : IDisposable
{
    private const byte SecureRefusal = 17, Welcome = 2, Challenge = 6, Refusal = 3;
    private const string Key = "k300";

    private readonly HostIdentity identity = HostIdentity.Draw();
    private readonly PathAttacker network = new();
    private readonly List<KeyRefusal> told = [];
    private ulong nonce = 5000;

    public void Dispose() => identity.Dispose();

    /// <summary>The key is the 301st of a list that one machine tries within a minute. The control: as many wrong keys as one likes are free.</summary>
    [Theory]
    [InlineData(true, 5, false)]
    [InlineData(false, 5, false)]
    [InlineData(true, int.MaxValue, true)]
    [InlineData(false, int.MaxValue, true)]
    public void Guess_FromOneMachine_FindsTheKeyOnlyWithoutALimit(bool isProtected, int free, bool isFound)
    {
        SessionGroup group = Hosting(isProtected, new JoinLimits { FreeWrongKeys = free, WrongKeyBurstOfAll = 100_000 });
        bool found = false;
        for (int n = 0; n < 600 && !found; n++)
        {
            found = Guess(group, PeerAddress.Virtual(50), string.Create(CultureInfo.InvariantCulture, $"k{n}"), isProtected, 0.1) is null;
        }

        Assert.Equal(isFound, found);
        Assert.Equal(isFound ? 300 : 10, told.Count); // five, and after 1, 2, 4, 8 and 16 s another
        if (!isFound)
        {
            Assert.Equal((10, 10L, 32.0), (told[^1].Count, told[^1].CountOfAll, Math.Round(told[^1].Pause.ToSeconds())));
            Assert.Contains("number 10 from there and 10 in all; no key from there is looked at for 32 s", told[^1].Sentence, StringComparison.Ordinal);
            Assert.Equal(RefusalReason.TooManyWrongKeys, Guess(group, PeerAddress.Virtual(50), Key, isProtected, 0.1)); // not even the right one
            group.Run(33);
            Assert.Null(Guess(group, PeerAddress.Virtual(50), Key, isProtected, 0.1));
        }
    }

    /// <summary>A thousand machines guess once each. The control: no limit for all together. Who has the key gets in meanwhile.</summary>
    [Theory]
    [InlineData(100, 10.0)]
    [InlineData(1_000_000, 1e6)]
    public void Guess_FromAThousandMachines_IsLimitedInAll(int burst, double perSecond)
    {
        SessionGroup group = Hosting(true, new JoinLimits { WrongKeyBurstOfAll = burst, WrongKeysPerSecondOfAll = perSecond });
        for (int n = 0; n < 1000; n++)
        {
            Guess(group, PeerAddress.Virtual(1000 + n), "wrong", true, 0.004);
        }

        Assert.InRange(told.Count, burst > 1000 ? 1000 : 100, burst > 1000 ? 1000 : 100 + (10 * 5));
        ClientSession honest = group.Join(1, 7, new ClientOptions { Protection = new SecureClient(identity.Fingerprint), ConnectKey = Key });
        Assert.True(group.RunUntil(() => honest.State == SessionState.Running, 2), honest.EndReason);
    }

    /// <summary>Somebody behind the same address has guessed: a player who comes back by its pass does not wait, one who is new does.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Join_FromAMachineThatGuessed_WaitsUnlessItHasAPass(bool hasPass)
    {
        SessionGroup group = Hosting(true, new JoinLimits());
        ClientOptions options = new() { Protection = new SecureClient(identity.Fingerprint), ConnectKey = Key };
        ClientSession ada = group.Join(1, 7, options);
        Assert.True(group.RunUntil(() => ada.State == SessionState.Running, 3), ada.EndReason);
        for (int n = 0; n < 6; n++)
        {
            Guess(group, PeerAddress.Virtual(2), $"wrong {n}", true, 0.02);
        }

        ClientSession again = group.Join(2, 8, options with { Protection = new SecureClient(identity.Fingerprint), Pass = hasPass ? ada.Pass!.Value : default });
        Assert.True(group.RunUntil(() => again.State is SessionState.Running or SessionState.Ended, 3));
        Assert.Equal(hasPass ? SessionState.Running : SessionState.Ended, again.State);
        Assert.Equal(hasPass, again.Peer == ada.Peer);
        Assert.True(hasPass || again.EndReason!.StartsWith("The host refused: too many wrong keys came from this address; it looks at no key from here for another ", StringComparison.Ordinal), again.EndReason);
    }

    /// <summary>A player who is in, and so has a pass, guesses other players' keys with it no faster than anybody.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Guess_WithAPass_IsLimitedLikeAny(bool isProtected)
    {
        SessionGroup group = Hosting(isProtected, new JoinLimits());
        ClientSession ada = group.Join(1, 7, new ClientOptions { Protection = isProtected ? new SecureClient(identity.Fingerprint) : null, ConnectKey = Key });
        Assert.True(group.RunUntil(() => ada.State == SessionState.Running, 3), ada.EndReason);
        RefusalReason?[] answers = [.. Enumerable.Range(0, 9).Select(n => Guess(group, PeerAddress.Virtual(50), $"wrong {n}", isProtected, 0.02, ada.Pass!.Value))];
        Assert.Equal(5, told.Count);
        Assert.Equal(RefusalReason.TooManyWrongKeys, answers[^1]);
        Assert.Null(Guess(group, PeerAddress.Virtual(50), Key, isProtected, 0.02, ada.Pass!.Value)); // the control: with the right key it comes back
    }

    /// <summary>
    /// A player's key lets its owner in from a machine that is out for a while. So who guesses from there is slowed down and told of like any,
    /// and hears nothing of the ban. The control: with as many wrong keys as one likes he finds it. From a machine that is out for good not even
    /// the right key lets in.
    /// </summary>
    [Theory]
    [InlineData(true, false, 5)]
    [InlineData(false, false, 5)]
    [InlineData(true, true, 5)]
    [InlineData(false, true, 5)]
    [InlineData(true, false, int.MaxValue)]
    [InlineData(false, false, int.MaxValue)]
    [InlineData(false, true, int.MaxValue)]
    public void Guess_APlayersKeyFromAMachineThatIsOut_IsLimitedLikeAny(bool isProtected, bool isForGood, int free)
    {
        JoinLimits limits = new() { FreeWrongKeys = free, WrongKeyBurstOfAll = 100_000, HandshakeBurst = 1_000_000, HandshakesPerSecondOfAll = 1e6 };
        SessionGroup group = new(
            ScriptedActions.Box(), 1, LinkProfiles.Loopback, expected: 0, wrap: network.Wrap, options: _ => new HostOptions
            {
                Protection = isProtected ? new SecureHost(identity) : null,
                PlayerKeys = new Dictionary<byte, string> { [3] = Key },
                PlayerBudget = new PlayerBudget(1, 1),
                JoinLimits = limits,
            });
        group.Host.KeyRefused += told.Add;
        group.Run(1);
        for (ulong n = 1; n <= (isForGood ? 1UL : 2); n++)
        {
            ClientSession client = group.Join(50, n, new ClientOptions { Protection = isProtected ? new SecureClient(identity.Fingerprint) : null });
            Assert.True(group.RunUntil(() => client.State == SessionState.Running, 3), client.EndReason);
            if (isForGood)
            {
                Assert.Equal(PeerAddress.Virtual(50).Machine, group.Host.Ban(client.Peer));
            }
            else
            {
                group.Do(1, PlayerAction.SetVelocity(BodyId.OfScene(0), new Vector3D(1, 0, 0)));
            }

            Assert.True(group.RunUntil(() => client.EndedBy == SessionEnd.Kicked, 3), client.EndReason);
            group.DropLast();
        }

        Assert.Equal(RefusalReason.Banned, Guess(group, PeerAddress.Virtual(50), "", isProtected, 0.1)); // the machine is out
        List<RefusalReason?> answers = [];
        while (answers.Count < 400 && (answers.Count == 0 || answers[^1] is RefusalReason.WrongKey or RefusalReason.TooManyWrongKeys))
        {
            answers.Add(Guess(group, PeerAddress.Virtual(50), string.Create(CultureInfo.InvariantCulture, $"k{answers.Count}"), isProtected, 0.1));
        }

        bool isFound = free > 5;
        Assert.Equal(isFound ? 301 : 400, answers.Count);
        Assert.Equal(isFound ? isForGood ? RefusalReason.Banned : null : RefusalReason.TooManyWrongKeys, answers[^1]);
        Assert.Equal(isFound ? 300 : 10, told.Count); // five, and after 1, 2, 4, 8 and 16 s another
    }

    /// <summary>Where there is no key there is nothing to guess: wrong ones are refused, and keep nobody out.</summary>
    [Fact]
    public void Guess_AtAHostWithoutAKey_KeepsNobodyOut()
    {
        SessionGroup group = Hosting(true, new JoinLimits { WrongKeyBurstOfAll = 3, WrongKeysPerSecondOfAll = 0.001 }, "");
        for (int n = 0; n < 20; n++)
        {
            Assert.Equal(RefusalReason.WrongKey, Guess(group, PeerAddress.Virtual(50), $"wrong {n}", true, 0.02));
        }

        Assert.Empty(told);
        Assert.Null(Guess(group, PeerAddress.Virtual(50), "", true, 0.02));
    }

    /// <summary>Who has no key is told so, and guesses nothing: no pause follows, and nobody is told. Where a machine waits, it waits with no key too.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Join_WithoutAKey_IsNoGuess(bool isProtected)
    {
        SessionGroup group = Hosting(isProtected, new JoinLimits());
        for (int n = 0; n < 20; n++)
        {
            Assert.Equal(RefusalReason.WrongKey, Guess(group, PeerAddress.Virtual(50), "", isProtected, 0.02));
        }

        Assert.Empty(told);
        ClientSession without = group.Join(1, 7, new ClientOptions { Protection = isProtected ? new SecureClient(identity.Fingerprint) : null });
        Assert.True(group.RunUntil(() => without.State == SessionState.Ended, 3));
        Assert.Equal("The host refused: it needs a key, and this peer has none.", without.EndReason);
        for (int n = 0; n < 6; n++)
        {
            Guess(group, PeerAddress.Virtual(50), $"wrong {n}", isProtected, 0.02); // the control: these are guesses
        }

        Assert.Equal(5, told.Count);
        Assert.Equal(RefusalReason.TooManyWrongKeys, Guess(group, PeerAddress.Virtual(50), "", isProtected, 0.02));
    }

    /// <summary>On a slow link a join comes several times before it is answered. A typing error is one all the same.</summary>
    [Fact]
    public void Join_WithATypingErrorOverASlowLink_CountsOnce()
    {
        SessionGroup group = new(
            ScriptedActions.Box(), 2, LinkProfiles.PureDelay(400), wrap: network.Wrap, options: peer => peer == 0
                ? new HostOptions { Protection = new SecureHost(identity), ConnectKey = Key }
                : new ClientOptions { Protection = new SecureClient(identity.Fingerprint), ConnectKey = "k3OO" });
        group.Host.KeyRefused += told.Add;
        Assert.True(group.RunUntil(() => group.Client(1).State == SessionState.Ended, 5));
        Assert.Equal("The host refused: the key is wrong.", group.Client(1).EndReason);
        group.Run(1);
        Assert.True(network.Heard.Count(h => h.From == 1 && h.Bytes[3] == PathAttacker.SecureJoin) > 2);
        Assert.Equal((1, 0L), (told.Single().Count, told.Single().Pause.Ticks));
    }

    private SessionGroup Hosting(bool isProtected, JoinLimits limits, string key = Key)
    {
        limits.HandshakeBurst = 1_000_000; // another limit, of which this is not about
        limits.HandshakesPerSecondOfAll = 1e6;
        SessionGroup group = new(
            ScriptedActions.Box(), 1, LinkProfiles.Loopback, expected: 0, wrap: network.Wrap,
            options: _ => new HostOptions { Protection = isProtected ? new SecureHost(identity) : null, ConnectKey = key, JoinLimits = limits });
        group.Host.KeyRefused += told.Add;
        group.Run(1);
        return group;
    }

    /// <summary>Asks to be let in with a key; null if the host lets it in, 0 if it says nothing.</summary>
    private RefusalReason? Guess(SessionGroup group, PeerAddress from, string key, bool isProtected, double seconds, PlayerPass pass = default)
    {
        byte[] bytes = new byte[WireFormat.MaxBytes];
        nonce++;
        network.Send(from, 0, bytes[..new ConnectRequestDatagram(nonce).Encode(bytes)]);
        group.Run(seconds / 2);
        Assert.True(ChallengeDatagram.TryDecode(network.Last(0, Challenge), out ChallengeDatagram challenge, out _));
        Assert.Equal(nonce, challenge.Nonce);
        byte[] binding = isProtected ? new byte[IHostProtection.BindingBytes] : [];
        using IClientHandshake? handshake = isProtected
            ? SecureJoinDatagram.Begin(nonce, challenge.Cookie, challenge.Identity, new SecureClient(identity.Fingerprint)) : null;
        handshake?.WriteBinding(binding);
        JoinDatagram join = new(
            nonce, challenge.Cookie, JoinCookies.Prove(key, nonce, challenge.Cookie, binding), 0, (uint)Simulation.FoldVersion, pass.Number,
            pass.Number == 0 ? default : JoinCookies.Prove(pass.Secret, nonce, challenge.Cookie, binding));
        int length = isProtected ? IHostProtection.HandshakeOverhead + join.EncodedLength : join.Encode(bytes);
        if (isProtected)
        {
            SecureJoinDatagram.Encode(bytes, join, default, handshake!);
        }

        network.Send(from, 0, bytes[..length]);
        group.Run(seconds / 2);
        byte[] answer = network.Heard.FindLast(
            h => h.From == 0 && h.Bytes[3] is SecureRefusal or PathAttacker.SecureWelcome or Refusal or Welcome && BitConverter.ToUInt64(h.Bytes, 4) == nonce).Bytes;
        byte[] payload = new byte[WireFormat.SecureRefusalPayloadBytes];
        return answer is null ? (RefusalReason)0
            : answer[3] is PathAttacker.SecureWelcome or Welcome ? null
            : answer[3] == Refusal ? (RefusalReason)answer[12]
            : handshake!.TryReadRefusal(answer.AsSpan(12), payload) ? (RefusalReason)payload[0]
            : throw new InvalidOperationException("The refusal cannot be read.");
    }
}
