using System;
using System.Linq;
using System.Security.Cryptography;
using System.Text;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Protection;

/// <summary>
/// What somebody on the path can do to a protected session: delay and drop, nothing else. Each attack is seen to succeed against a session
/// without protection.
/// </summary>
public sealed class PathAttackTests : IDisposable
{
    private const double Mark = 12.345678901234567; // a height that nothing else has
    private const string Key = "k777777";

    private readonly HostIdentity identity = HostIdentity.Draw();
    private readonly PathAttacker attacker = new();

    public void Dispose() => identity.Dispose();

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Read_WhatPlayersDo_OnlyWithoutProtection(bool isProtected)
    {
        SessionGroup group = Playing(isProtected);
        group.Do(1, PlayerAction.Teleport(First, V(0, Mark), V(0)));
        Assert.True(group.Settle(1));
        byte[] mark = BitConverter.GetBytes(Mark);
        Assert.Equal(isProtected, !attacker.Heard.Exists(h => h.Bytes.AsSpan().IndexOf(mark) >= 0));
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Forge_AnActInAPlayersName_OnlyWithoutProtection(bool isProtected)
    {
        SessionGroup group = Playing(isProtected);
        group.Do(1, PlayerAction.Impulse(Second, V(0, 0.1)));
        Assert.True(group.Settle(1));
        byte[] heard = LastOf(1), host = LastOf(0);
        uint sequence = isProtected ? 1 : PathAttacker.U32(host, PathAttacker.EventsReceivedAt) + 1;
        long now = isProtected ? group.Host.Watermark.Ticks + (1L << 39) : PathAttacker.I64(host, PathAttacker.WatermarkAt) + (1L << 39);
        for (int n = 0; n < 20; n++)
        {
            attacker.Send(1, 0, PathAttacker.Teleport(heard, group.Sessions[1].Peer, (uint)(900 + n), sequence, now, Mark));
        }

        group.Run(0.5);
        Assert.Equal(isProtected ? 1 : 2, group.Host.Counters.EventsAccepted);
        Assert.Equal(!isProtected, group.Log.Values.Any(e => e.Event.Position.Y == Mark));
        Assert.Equal(isProtected ? 20 : 0, group.Host.Counters.DatagramsForged);
        AssertGoesOn(group, isProtected);
    }

    /// <summary>A datagram is held, changed in one place, and sent on; the true one is lost.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Change_AnActOnItsWay_OnlyWithoutProtection(bool isProtected)
    {
        SessionGroup group = Playing(isProtected);
        byte[] mark = BitConverter.GetBytes(Mark);
        int changed = 0;
        attacker.Drops = (from, bytes) =>
        {
            int at = isProtected ? 40 : bytes.AsSpan().IndexOf(mark);
            if (from != 1 || at < 0 || changed == 3)
            {
                return false;
            }

            changed++;
            bytes[at + 6] ^= 0x10; // in the height: to 6 m or 24 m, or something else where it cannot be read
            attacker.Send(1, 0, bytes);
            return true;
        };
        group.Do(1, PlayerAction.Teleport(First, V(0, Mark), V(0)));
        Assert.True(group.Settle(1));
        Assert.Equal(isProtected, group.Log.Values.Single().Event.Position.Y == Mark);
        Assert.Equal(isProtected ? 3 : 0, group.Host.Counters.DatagramsForged);
        attacker.Drops = (_, _) => false;
        AssertGoesOn(group, isProtected);
    }

    /// <summary>What was heard is sent again from another address; who answers the challenge has the link from then on.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Replay_FromAnotherAddress_MovesTheLinkOnlyWithoutProtection(bool isProtected)
    {
        SessionGroup group = Playing(isProtected);
        attacker.Drops = (from, _) => from == 1;
        group.Run(2.5);
        attacker.Send(PeerAddress.Virtual(66), 0, LastOf(1)); // the host has not had it
        group.Run(0.1);
        const byte moveChallenge = 14, move = 13;
        if (attacker.HasHeard(0, moveChallenge))
        {
            byte[] challenge = attacker.Last(0, moveChallenge), answer = PathAttacker.Head(move, 29);
            challenge.AsSpan(4, 8).CopyTo(answer.AsSpan(4));
            answer[12] = group.Sessions[1].Peer;
            challenge.AsSpan(12, 16).CopyTo(answer.AsSpan(13));
            attacker.Send(PeerAddress.Virtual(66), 0, answer);
        }

        group.Run(0.1);
        Assert.Equal(isProtected ? PeerAddress.Virtual(1) : PeerAddress.Virtual(66), group.Host.Links.Single().Address);
        attacker.Drops = (_, _) => false;
        if (isProtected)
        {
            AssertGoesOn(group, isProtected);
        }
    }

    [Fact]
    public void Replay_EverythingInAnyOrder_HasNoEffect()
    {
        SessionGroup group = Playing(isProtected: true);
        for (int n = 0; n < 30; n++)
        {
            group.Do(n % 2, PlayerAction.Impulse(First, V(0, 0.5)));
            group.Run(0.05);
        }

        Assert.True(group.Settle(30));
        (int From, byte[] Bytes)[] all = [.. attacker.Heard];
        Random random = new(1);
        for (int n = 0; n < 20_000; n++)
        {
            (int from, byte[] bytes) = all[random.Next(all.Length)];
            attacker.Send(from, 1 - from, bytes); // where it went
            attacker.Send(1 - from, from, bytes); // and back
            if (n % 1000 == 0)
            {
                group.Run(0.05);
            }
        }

        Assert.Equal((30L, 30L), (group.Host.Counters.EventsAccepted, group.Client(1).Counters.EventsAccepted));
        AssertGoesOn(group, isProtected: true);
    }

    /// <summary>
    /// The host's own datagrams come back to it as if a client had sent them; where they can be changed, with a number it has not had.
    /// </summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Reflect_WhatTheHostSent_IsTakenOnlyWithoutProtection(bool isProtected)
    {
        SessionGroup group = Playing(isProtected);
        for (int n = 0; n < 10; n++)
        {
            group.Run(2.5);
            byte[] reflected = [.. LastOf(0)];
            if (!isProtected)
            {
                BitConverter.TryWriteBytes(reflected.AsSpan(PathAttacker.NumberAt), (uint)(900 + n));
            }

            attacker.Send(1, 0, reflected);
        }

        group.Run(0.1);
        Assert.Equal(isProtected, group.Host.Links.Single().RoundTrip > SimDuration.Zero && group.Host.Counters.DatagramsForged == 10);
        Assert.Equal(!isProtected, group.Host.Counters is { DatagramsForged: 0, DatagramsIgnored: < 10 });
        AssertGoesOn(group, isProtected);
    }

    /// <summary>The host has given up a client that was cut off, and says so; on the way it becomes the end of the session.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Change_WhyAClientIsGone_OnlyWithoutProtection(bool isProtected)
    {
        const byte reset = 18, hostEnded = 3;
        SessionGroup group = Playing(isProtected);
        attacker.Drops = (_, _) => true;
        group.Run(11);
        Assert.Equal((0, SessionState.Rejoining), (group.Host.ClientCount, group.Client(1).State));
        attacker.Drops = (from, bytes) =>
        {
            if (from == 0 && bytes[3] is PathAttacker.Leave or reset)
            {
                bytes[isProtected ? 12 : 13] = hostEnded;
            }

            return from == 1;
        };
        long forged = group.Client(1).Counters.DatagramsForged;
        attacker.Send(1, 0, LastOf(1)); // of the link that the host does not have any more
        group.Run(0.1);
        Assert.True(attacker.HasHeard(0, isProtected ? reset : PathAttacker.Leave));
        Assert.Equal(isProtected ? SessionState.Rejoining : SessionState.Ended, group.Client(1).State);
        Assert.Equal(forged + (isProtected ? 1 : 0), group.Client(1).Counters.DatagramsForged);
        attacker.Drops = (_, _) => false;
        Assert.Equal(isProtected, group.RunUntil(() => group.Client(1).State == SessionState.Running, 5));
    }

    /// <summary>One number far ahead, and everything the client sends from then on is old.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Cut_ALinkWithOneNumber_OnlyWithoutProtection(bool isProtected)
    {
        SessionGroup group = Playing(isProtected);
        int interruptions = 0;
        group.Client(1).Interrupted += _ => interruptions++;
        attacker.Send(1, 0, PathAttacker.Empty(LastOf(1), group.Sessions[1].Peer, uint.MaxValue));
        group.Run(12);
        Assert.Equal(isProtected, interruptions == 0);
        AssertGoesOn(group, isProtected);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Kick_AClientWithOneDatagram_OnlyWithoutProtection(bool isProtected)
    {
        SessionGroup group = Playing(isProtected);
        ulong session = PathAttacker.U64(LastOf(1), PathAttacker.SessionAt);
        attacker.Send(1, 0, PathAttacker.Gone(session, group.Sessions[1].Peer, 1));
        group.Run(0.1);
        Assert.Equal(isProtected ? 1 : 0, group.Host.ClientCount);
        AssertGoesOn(group, isProtected);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void End_TheSessionAsTheHost_OnlyWithoutProtection(bool isProtected)
    {
        SessionGroup group = Playing(isProtected);
        ulong session = PathAttacker.U64(LastOf(1), PathAttacker.SessionAt);
        for (byte reason = 1; reason <= 7; reason++)
        {
            attacker.Send(0, 1, PathAttacker.Gone(session, 0, reason));
            byte[] reset = PathAttacker.Head(18, 29); // as good as anybody can make it
            BitConverter.TryWriteBytes(reset.AsSpan(4), session);
            reset[12] = reason;
            RandomNumberGenerator.Fill(reset.AsSpan(13));
            attacker.Send(0, 1, reset);
        }

        group.Run(0.1);
        Assert.Equal(isProtected ? SessionState.Running : SessionState.Ended, group.Client(1).State);
        AssertGoesOn(group, isProtected);
    }

    /// <summary>
    /// A client that is joining is told that it may not, that the host speaks another version, and is sent cookies that are none, as long as
    /// it takes.
    /// </summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Refuse_AJoinAsTheHost_OnlyWithoutProtection(bool isProtected)
    {
        SessionGroup group = Group(isProtected);
        Random random = new(4);
        attacker.Drops = (from, bytes) =>
        {
            if (from == 1 && bytes[3] is 1 or PathAttacker.Join or PathAttacker.SecureJoin)
            {
                byte[] refusal = PathAttacker.Head(3, 13);
                bytes.AsSpan(4, 8).CopyTo(refusal.AsSpan(4));
                refusal[12] = 4; // full
                attacker.Send(0, 1, refusal);
                byte[] version = [.. refusal];
                version[2] = 77;
                attacker.Send(0, 1, version);
                if (attacker.HasHeard(0, 6))
                {
                    byte[] challenge = attacker.Last(0, 6); // the host's identity, a cookie of nobody's
                    bytes.AsSpan(4, 8).CopyTo(challenge.AsSpan(4));
                    for (int n = 0; n < 3; n++)
                    {
                        random.NextBytes(challenge.AsSpan(12, 16));
                        attacker.Send(0, 1, [.. challenge]);
                    }
                }
            }

            return false;
        };
        Assert.Equal(isProtected, group.RunUntil(() => group.Client(1).State == SessionState.Running, 4));
    }

    /// <summary>
    /// Before each join of a client comes another to the host, with the same nonce and cookie and in the client's name: one that is in order,
    /// of a key that the attacker drew. The client gets in all the same.
    /// </summary>
    [Fact]
    public void Join_InTheNameOfAClientThatJoins_DoesNotKeepItOut()
    {
        SessionGroup group = new(
            ScriptedActions.Box(), 1, LinkProfiles.PureDelay(20), expected: 0, wrap: attacker.Wrap, options: _ => new HostOptions { Protection = new SecureHost(identity) });
        group.Run(1);
        int made = 0;
        attacker.Drops = (from, bytes) =>
        {
            if (from == 1 && bytes[3] == PathAttacker.SecureJoin)
            {
                attacker.Send(1, 0, OfAnotherKey(bytes));
                made++;
            }

            return false;
        };
        ClientSession client = group.Join(1, 7, new ClientOptions { Protection = new SecureClient(identity.Fingerprint) });
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 2));
        Assert.True(made > 0);

        byte[] OfAnotherKey(byte[] heard)
        {
            Assert.True(ChallengeDatagram.TryDecode(attacker.Last(0, 6), out ChallengeDatagram challenge, out _));
            ulong nonce = BitConverter.ToUInt64(heard, 4);
            using IClientHandshake own = SecureJoinDatagram.Begin(nonce, challenge.Cookie, challenge.Identity, new SecureClient(identity.Fingerprint))!;
            byte[] forged = new byte[heard.Length], binding = new byte[IHostProtection.BindingBytes];
            own.WriteBinding(binding);
            JoinDatagram join = new(
                nonce, challenge.Cookie, JoinCookies.Prove("", nonce, challenge.Cookie, binding), 0, (uint)Simulation.FoldVersion);
            SecureJoinDatagram.Encode(forged, join, default, own);
            Assert.Equal(heard[..28], forged[..28]);
            return forged;
        }
    }

    /// <summary>
    /// Another host answers in the host's place. A client that knows whom it wants does not join it; one that trusts whoever answers first
    /// does, as one without protection.
    /// </summary>
    [Theory]
    [InlineData("unprotected", true)]
    [InlineData("trust on first use", true)]
    [InlineData("pinned", false)]
    public void Play_TheHost_OnlyToWhoDoesNotKnowIt(string client, bool isJoined)
    {
        using HostIdentity other = HostIdentity.Draw();
        Scene scene = ScriptedActions.Box();
        SessionGroup group = new(scene, 2, LinkProfiles.Loopback, options: peer => peer == 0
            ? new HostOptions { Protection = client == "unprotected" ? null : new SecureHost(other) } // the false one, at the host's address
            : new ClientOptions
            {
                Protection = client == "unprotected" ? null : client == "pinned" ? new SecureClient(identity.Fingerprint) : SecureClient.TrustOnFirstUse(),
            });
        group.RunUntil(() => group.Client(1).State is SessionState.Running or SessionState.Ended, 15);
        Assert.Equal(isJoined ? SessionState.Running : SessionState.Ended, group.Client(1).State);
    }

    /// <summary>A join was recorded; now a million keys are tried on it.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Guess_TheKeyOfARecordedJoin_OnlyWithoutProtection(bool isProtected)
    {
        Playing(isProtected);
        byte[] join = attacker.Last(1, isProtected ? PathAttacker.SecureJoin : PathAttacker.Join);
        byte[] whole = [.. attacker.Heard.SelectMany(h => h.Bytes)];
        byte[] proved = [.. "LagSim key proof"u8, .. join[4..28]]; // nonce and cookie
        if (isProtected)
        {
            byte[] hash = SHA256.HashData("Noise_NKpsk2_25519_ChaChaPoly_SHA256"u8);
            foreach (byte[] seen in new[] { join[..28], attacker.Last(0, 6)[28..60], join[28..60] }) // prologue, the host's key, the client's
            {
                hash = SHA256.HashData([.. hash, .. seen]);
            }

            proved = [.. proved, .. hash];
        }

        string? found = null;
        byte[] proof = new byte[32];
        for (int n = 0; n < 1_000_000 && found is null; n++)
        {
            string guess = $"k{n}";
            HMACSHA256.HashData(Encoding.UTF8.GetBytes(guess), proved, proof);
            bool isIt = isProtected && n % 10_000 == 7777 % 10_000
                ? whole.AsSpan().IndexOf(proof.AsSpan(0, 16)) >= 0 // the right one among them, against all that was ever sent
                : join.AsSpan(28).IndexOf(proof.AsSpan(0, 16)) >= 0;
            found = isIt ? guess : null;
        }

        Assert.Equal(isProtected ? null : Key, found);
    }

    private SessionGroup Group(bool isProtected) => new(
        ScriptedActions.Box(), 2, LinkProfiles.Loopback, wrap: attacker.Wrap, options: peer => peer == 0
            ? new HostOptions { Protection = isProtected ? new SecureHost(identity) : null, ConnectKey = Key }
            : new ClientOptions { Protection = isProtected ? new SecureClient(identity.Fingerprint) : null, ConnectKey = Key });

    private SessionGroup Playing(bool isProtected)
    {
        SessionGroup group = Group(isProtected);
        group.IsTapped = false; // the attacker speaks as the host
        group.Connect();
        group.Run(1);
        return group;
    }

    /// <summary>The last update of a peer, or what seals it.</summary>
    private byte[] LastOf(int peer) => attacker.Heard.FindLast(h => h.From == peer && h.Bytes[3] is PathAttacker.Update or PathAttacker.Sealed).Bytes;

    /// <summary>
    /// A protected session goes on as if nothing had been: the client's next act takes effect everywhere, and all states agree.
    /// </summary>
    private static void AssertGoesOn(SessionGroup group, bool isProtected)
    {
        long done = group.Host.Counters.EventsAccepted + group.Host.Counters.EventsRefused;
        if (!isProtected)
        {
            return;
        }

        group.Do(1, PlayerAction.Impulse(First, V(0, 0.25)));
        Assert.True(group.Settle((int)done + 1, 2));
        group.Run(2);
        Assert.Equal((SessionState.Running, 1), (group.Client(1).State, group.Host.ClientCount));
        Assert.All(group.Sessions, s => Assert.Equal((0L, 0L, 0L), (s.Counters.StatesDiffered, s.Counters.EventsLost, s.Counters.Renewals)));
        Assert.Null(group.Difference());
    }
}
