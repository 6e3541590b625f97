using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>
/// A host changes its key: who knows the former one joins and is told the new one, for as long as was said; and nobody else can tell them one.
/// </summary>
public sealed class KeyChangeTests : IDisposable
{
    private static readonly DateTimeOffset Noon = new(2026, 11, 27, 12, 0, 0, TimeSpan.Zero);

    private readonly HostIdentity former = HostIdentity.Draw();
    private readonly HostIdentity changed;
    private readonly PathAttacker attacker = new();
    private readonly List<(int At, SessionState State, HostFingerprint? Host)> told = []; // by the sessions: by which, in which state, and which host
    private DateTimeOffset now = Noon;

    public KeyChangeTests() => changed = former.ChangeKey(TimeSpan.FromDays(30), Noon);

    public void Dispose()
    {
        former.Dispose();
        changed.Dispose();
    }

    [Fact]
    public void Join_WithTheFormerFingerprint_IsInAndLearnsTheNewOne()
    {
        SessionGroup group = Hosting(changed);
        SecureClient knowsFormer = new(former.Fingerprint), knowsNew = new(changed.Fingerprint), trusting = SecureClient.TrustOnFirstUse();
        Assert.Equal(SessionState.Running, Joined(group, 1, knowsFormer).State);
        Assert.Equal(SessionState.Running, Joined(group, 2, knowsNew).State);
        Assert.Equal(SessionState.Running, Joined(group, 3, trusting).State);
        Assert.All([knowsFormer, knowsNew, trusting], client => Assert.Equal(changed.Fingerprint, client.Host));
        group.Run(5);
        Assert.Equal([(1, SessionState.Synchronising, changed.Fingerprint)], told); // before there is a world, and not who knew it
        Assert.All(group.Sessions, s => Assert.Equal((0L, 0L), (s.Counters.DatagramsForged, s.Counters.StatesDiffered)));
    }

    /// <summary>The host restarts with its changed key while a client plays, and later without the former one: the client follows.</summary>
    [Fact]
    public void Session_OfAHostThatChangesItsKey_GoesOn()
    {
        SessionGroup group = Hosting(former);
        SecureClient client = new(former.Fingerprint);
        ClientSession session = Joined(group, 1, client);
        Assert.Empty(told);
        group.RestartHost(new HostOptions { Protection = Host(changed) });
        Assert.True(group.RunUntil(() => session.Counters.Renewals == 1 && session.State == SessionState.Running, 30), session.EndReason);
        Assert.Equal([(1, SessionState.Rejoining, changed.Fingerprint)], told);
        using HostIdentity alone = changed.ForgetFormerKeys();
        group.RestartHost(new HostOptions { Protection = Host(alone) });
        Assert.True(group.RunUntil(() => session.Counters.Renewals == 2 && session.State == SessionState.Running, 30), session.EndReason);
        Assert.Single(told);
        Assert.Equal(changed.Fingerprint, client.Host);
    }

    /// <summary>
    /// A thief answers in the host's place with a key of its own, for which none vouches, and shows the former public key or its own. Only who
    /// trusts whoever answers joins it: the control.
    /// </summary>
    [Theory]
    [InlineData(false, false, false)]
    [InlineData(true, false, false)]
    [InlineData(false, true, true)]
    public void Play_TheHostWithAKeyOfOnesOwn_OnlyToWhoTrustsAnyone(bool showsFormer, bool isTrusting, bool isJoined)
    {
        using HostIdentity own = HostIdentity.Draw();
        SecureHost thief = new(own);
        SessionGroup group = new(
            ScriptedActions.Box(), 1, LinkProfiles.Loopback, expected: 0,
            options: _ => new HostOptions { Protection = showsFormer ? new Showing(former, thief) : thief });
        SecureClient client = isTrusting ? SecureClient.TrustOnFirstUse() : new SecureClient(former.Fingerprint);
        ClientSession session = Joined(group, 1, client);
        Assert.Equal(isJoined ? SessionState.Running : SessionState.Ended, session.State);
        Assert.Empty(told);
        Assert.Equal(isJoined ? own.Fingerprint : former.Fingerprint, client.Host);
    }

    /// <summary>
    /// The former key has been stolen. Who has been told the new one is not taken in any more; the control, and what remains, is a client that
    /// knows only the stolen one: the thief is its host, and tells it a key of its own.
    /// </summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Play_TheHostWithTheStolenKey_OnlyToWhoKnowsNoNewerOne(bool isTold)
    {
        SecureClient client = new(former.Fingerprint);
        if (isTold)
        {
            Assert.Equal(SessionState.Running, Joined(Hosting(changed), 1, client).State);
            client = new SecureClient(Assert.Single(told).Host!.Value); // as it was remembered
            told.Clear();
        }

        using HostIdentity thief = former.ChangeKey(TimeSpan.FromDays(300), Noon);
        ClientSession session = Joined(Hosting(thief), 1, client);
        Assert.Equal(isTold ? SessionState.Ended : SessionState.Running, session.State);
        Assert.Equal(isTold ? [] : [(1, SessionState.Synchronising, thief.Fingerprint)], told);
    }

    /// <summary>From the stated instant on the host does not answer to its former key; a second before it does.</summary>
    [Theory]
    [InlineData(-1, true)]
    [InlineData(0, false)]
    [InlineData(3600, false)]
    public void Join_WithTheFormerFingerprint_OnlyBeforeItsTimeIsOver(int secondsLater, bool isIn)
    {
        now = Noon.AddDays(30).AddSeconds(secondsLater);
        ClientSession session = Joined(Hosting(changed), 1, new SecureClient(former.Fingerprint));
        Assert.Equal(isIn ? SessionState.Running : SessionState.Ended, session.State);
        Assert.Contains(isIn ? "" : "another identity than this peer was told", session.EndReason ?? "", StringComparison.Ordinal);
    }

    /// <summary>
    /// The welcome by which a host told one client its new fingerprint is sent to another client of it, and to one that joins another host. It
    /// proves nothing there. The control: a handshake that has not drawn a key of its own takes the recorded answer once more.
    /// </summary>
    [Fact]
    public void Replay_TheWelcomeThatTellsANewFingerprint_TellsItNobodyElse()
    {
        SessionGroup group = Hosting(changed);
        Assert.Equal(SessionState.Running, Joined(group, 1, new SecureClient(former.Fingerprint)).State);
        byte[] welcome = attacker.Last(0, PathAttacker.SecureWelcome);
        using HostIdentity other = HostIdentity.Draw();
        foreach ((HostIdentity host, HostIdentity known) in new[] { (changed, former), (other, other) })
        {
            SessionGroup next = Hosting(host);
            SecureClient client = new(known.Fingerprint);
            int replayed = 0;
            attacker.Drops = (from, bytes) =>
            {
                if (from == 0 && bytes[3] == PathAttacker.SecureWelcome)
                {
                    attacker.Send(0, 1, [.. bytes[..12], .. welcome[12..]]); // with this attempt's nonce
                    replayed++;
                }

                return from == 0 && bytes[3] == PathAttacker.SecureWelcome;
            };
            told.Clear();
            ClientSession session = Asking(next, 1, client);
            next.Run(3);
            Assert.True(replayed > 0 && session.Counters.DatagramsForged >= replayed);
            Assert.Equal((SessionState.Joining, 0, known.Fingerprint), (session.State, told.Count, client.Host));
            attacker.Drops = (_, _) => false;
        }

        byte[] shown = new byte[IHostProtection.IdentityBytes], wanted = new byte[16], join = new byte[48], payload = [], answer = new byte[64];
        former.Fingerprint.Write(wanted);
        int shownKey = Host(changed).WriteIdentity(wanted, shown);
        using Curve25519KeyPair own = Curve25519KeyPair.Draw();
        HostFingerprint first = default, again = default, fresh = default;
        using ClientHandshake one = Begun(own, newest => first = newest), same = Begun(own, newest => again = newest), another = Begun(Curve25519KeyPair.Draw(), newest => fresh = newest);
        one.Write(payload, join);
        same.Write(payload, new byte[48]);
        another.Write(payload, new byte[48]);
        using IHostHandshake read = Host(changed).TryRead(shownKey, [1], join, payload)!;
        read.Accept("", payload, answer).Dispose();
        Assert.NotNull(one.TryFinish("", answer, payload));
        Assert.NotNull(same.TryFinish("", answer, payload)); // the control
        Assert.Null(another.TryFinish("", answer, payload));
        Assert.Equal((changed.Fingerprint, changed.Fingerprint, default), (first, again, fresh));
        Assert.Equal((true, true, false), (one.IsHostKeyChanged, same.IsHostKeyChanged, another.IsHostKeyChanged));

        ClientHandshake Begun(Curve25519KeyPair keys, Action<HostFingerprint> finished)
        {
            NoiseSymmetricState state = NoiseHandshake.Begin([1], shown);
            Assert.True(NoiseHandshake.TryMixFirst(state, keys, shown));
            return new ClientHandshake(state, keys, former.Fingerprint, finished);
        }
    }

    /// <summary>Somebody on the path changes which host a client asks for: it can hold up the join, and no more.</summary>
    [Fact]
    public void Change_WhichHostAClientAsksFor_HoldsItUpAndNoMore()
    {
        SessionGroup group = Hosting(changed);
        attacker.Drops = (from, bytes) =>
        {
            bytes.AsSpan(12, bytes[3] == 1 ? 16 : 0).Clear();
            return false;
        };
        SecureClient client = new(former.Fingerprint);
        ClientSession session = Asking(group, 1, client);
        group.Run(3);
        Assert.Equal((SessionState.Joining, 0, former.Fingerprint, changed.Fingerprint), (session.State, told.Count, client.Host, client.Other));
        attacker.Drops = (_, _) => false;
        Assert.True(group.RunUntil(() => session.State == SessionState.Running, 5));
        Assert.Equal([(1, SessionState.Synchronising, changed.Fingerprint)], told);
    }

    /// <summary>A backend's tokens name the host by the fingerprint that the backend knows: the former one counts as long as the key does.</summary>
    [Theory]
    [InlineData(29, TokenFault.None)]
    [InlineData(30, TokenFault.OtherHost)]
    public void Token_ForTheFormerFingerprint_CountsAsLongAsTheKeyDoes(int days, TokenFault fault)
    {
        using TokenIssuer issuer = TokenIssuer.Draw();
        now = Noon.AddDays(days);
        SecureHost host = new(changed, issuer.Key, () => now);
        Assert.Equal(fault, host.ReadToken(issuer.Issue(new PlayerAdmission("ada"), former.Fingerprint, now: now)).Fault);
        Assert.Equal(TokenFault.None, host.ReadToken(issuer.Issue(new PlayerAdmission("ada"), changed.Fingerprint, now: now)).Fault);
    }

    [Fact]
    public void Text_OfAnIdentityWithFormerKeys_IsReadBackAndHasOneSpelling()
    {
        using HostIdentity third = changed.ChangeKey(TimeSpan.FromHours(1), Noon.AddDays(1));
        Assert.Equal([(changed.Fingerprint, Noon.AddDays(1).AddHours(1)), (former.Fingerprint, Noon.AddDays(30))], third.FormerKeys.Select(key => (key.Fingerprint, key.Until)));
        string text = third.ToSecretText();
        Assert.True(HostIdentity.TryParse(text, out HostIdentity? read));
        Assert.Equal((text, third.Fingerprint), (read!.ToSecretText(), read.Fingerprint));
        Assert.Equal(third.FormerKeys.Select(key => key.ToString()), read.FormerKeys.Select(key => key.ToString()));
        Assert.Equal($"{former.Fingerprint} until 2026-12-27 12:00:00Z", third.FormerKeys[1].ToString());
        string key = new('a', 64);
        foreach (string bad in new[]
        {
            "", key[1..], $"{key} ", $"{key} {key}", $"{key} {key}@", $"{key} {key}@-1", $"{key} {key}@ 1", $"{key}  {key}@1", $"{key} {key}@1@1",
            $"{key} {key}@99999999999999", $"{key} {key[1..]}@1", string.Join(' ', Enumerable.Repeat($"{key}@1", 2)),
            $"{key} {string.Join(' ', Enumerable.Repeat($"{key}@1", 5))}",
        })
        {
            Assert.False(HostIdentity.TryParse(bad, out _), bad);
        }

        Assert.True(HostIdentity.TryParse($"{key} {string.Join(' ', Enumerable.Repeat($"{key}@1", 4))}", out HostIdentity? most));
        Assert.Equal(4, most!.FormerKeys.Count);
        third.Dispose();
        Assert.Throws<ObjectDisposedException>(third.ToSecretText);
        Assert.Throws<ObjectDisposedException>(() => third.FormerKeys[0].Keys.PrivateKey.ToArray());
        Assert.Equal(64, former.ToSecretText().Length); // each identity has keys of its own
    }

    [Fact]
    public void ChangeKey_OutOfRangeOrTooOften_SaysWhatIsAllowed()
    {
        foreach (TimeSpan wrong in new[] { TimeSpan.FromSeconds(-1), TimeSpan.FromDays(366.1) })
        {
            ArgumentOutOfRangeException refused = Assert.Throws<ArgumentOutOfRangeException>(() => former.ChangeKey(wrong));
            Assert.Contains("zero to 366 days", refused.Message, StringComparison.Ordinal);
        }

        HostIdentity last = former;
        for (int n = 0; n < HostIdentity.MaxFormerKeys; n++)
        {
            last = last.ChangeKey(TimeSpan.FromDays(1), Noon);
        }

        Assert.Equal(4, last.FormerKeys.Count);
        InvalidOperationException full = Assert.Throws<InvalidOperationException>(() => last.ChangeKey(TimeSpan.FromDays(1), Noon));
        Assert.Contains("keeps 4 former keys already", full.Message, StringComparison.Ordinal);
        Assert.Single(last.ChangeKey(TimeSpan.FromDays(1), Noon.AddDays(1)).FormerKeys); // the time of the others is over
        Assert.Empty(last.ChangeKey(TimeSpan.Zero, Noon).FormerKeys);
        Assert.Equal(last.Fingerprint, last.ForgetFormerKeys().Fingerprint);
        Assert.Empty(last.ForgetFormerKeys().FormerKeys);
    }

    /// <summary>
    /// The host reads a join by the one key that it showed for it, so that forged ones cost it no more after its key has changed. The control: a
    /// host that tries all keys it has.
    /// </summary>
    [Theory]
    [InlineData(false, 1)]
    [InlineData(true, 5)]
    public void Read_AForgedJoin_AgreesOnceHoweverManyFormerKeysThereAre(bool triesAll, int each)
    {
        HostIdentity many = changed;
        List<HostFingerprint> known = [HostIdentity.Draw().Fingerprint, former.Fingerprint, changed.Fingerprint];
        for (int n = 1; n < HostIdentity.MaxFormerKeys; n++)
        {
            many = many.ChangeKey(TimeSpan.FromDays(30), Noon);
            known.Add(many.Fingerprint);
        }

        SecureHost real = Host(many);
        SessionGroup group = new(
            ScriptedActions.Box(), 1, LinkProfiles.Loopback, expected: 0, wrap: attacker.Wrap,
            options: _ => new HostOptions { Protection = triesAll ? new TryingAll(real) : real });
        group.Run(1);
        byte[] bytes = new byte[WireFormat.MaxBytes], wanted = new byte[Token128.Bytes], join = new byte[WireFormat.SecureJoinBytes];
        Random random = new(1);
        foreach (HostFingerprint one in known)
        {
            one.Write(wanted);
            attacker.Send(50, 0, bytes[..new ConnectRequestDatagram(77, new Token128(wanted)).Encode(bytes)]);
            group.Run(0.02);
            Assert.True(ChallengeDatagram.TryDecode(attacker.Last(0, 6), out ChallengeDatagram challenge, out _));
            random.NextBytes(join);
            JoinDatagram.WritePrologue(join, DatagramType.SecureJoin, 77, challenge.Cookie);
            attacker.Send(50, 0, [.. join]);
            group.Run(0.02);
        }

        Assert.Equal(known.Count * each, Agreements(many));
        Assert.Equal(known.Count, group.Host.Counters.DatagramsForged);
        for (int n = 1; n < known.Count; n++)
        {
            Assert.Equal(SessionState.Running, Joined(group, n, new SecureClient(known[n])).State); // each of its keys counts
        }

        static long Agreements(HostIdentity identity) => identity.Keys.Agreements + identity.FormerKeys.Sum(one => one.Keys.Agreements);
    }

    private ClientSession Asking(SessionGroup group, int at, SecureClient protection)
    {
        ClientSession session = group.Join(at, 7 + (ulong)at, new ClientOptions { Protection = protection });
        session.HostKeyChanged += () => told.Add((at, session.State, protection.Host));
        return session;
    }

    private ClientSession Joined(SessionGroup group, int at, SecureClient protection)
    {
        ClientSession session = Asking(group, at, protection);
        Assert.True(group.RunUntil(() => session.State is SessionState.Running or SessionState.Ended, 15));
        return session;
    }

    private SecureHost Host(HostIdentity identity) => new(identity, null, () => now);

    private SessionGroup Hosting(HostIdentity identity) => new(
        ScriptedActions.Box(), 1, LinkProfiles.Loopback, expected: 0, wrap: attacker.Wrap, options: _ => new HostOptions { Protection = Host(identity) });

    /// <summary>A host that shows another's public key, and does not have the private one.</summary>
    private sealed class Showing(HostIdentity other, SecureHost real) : IHostProtection
    {
        public bool RequiresToken => real.RequiresToken;

        public IHostHandshake? TryRead(int key, ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> payload) => real.TryRead(key, prologue, message, payload);

        public TokenReading ReadToken(ReadOnlySpan<byte> token) => real.ReadToken(token);

        public bool TryUseToken(ReadOnlySpan<byte> token) => real.TryUseToken(token);

        public int WriteIdentity(ReadOnlySpan<byte> wanted, Span<byte> destination)
        {
            other.Keys.PublicKey.CopyTo(destination);
            return 0;
        }

        public void WriteResetKey(ReadOnlySpan<byte> link, Span<byte> key) => real.WriteResetKey(link, key);
    }

    /// <summary>A host that tries each key that it may have.</summary>
    private sealed class TryingAll(SecureHost real) : IHostProtection
    {
        public bool RequiresToken => real.RequiresToken;

        public IHostHandshake? TryRead(int key, ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> payload)
        {
            IHostHandshake? read = null;
            for (int n = 0; n < IHostProtection.MaxKeys && read is null; n++)
            {
                read = real.TryRead(n, prologue, message, payload);
            }

            return read;
        }

        public TokenReading ReadToken(ReadOnlySpan<byte> token) => real.ReadToken(token);

        public bool TryUseToken(ReadOnlySpan<byte> token) => real.TryUseToken(token);

        public int WriteIdentity(ReadOnlySpan<byte> wanted, Span<byte> destination) => real.WriteIdentity(wanted, destination);

        public void WriteResetKey(ReadOnlySpan<byte> link, Span<byte> key) => real.WriteResetKey(link, key);
    }
}
