using System;
using System.Diagnostics.CodeAnalysis;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>Asks a host to let this peer in: connect request, cookie, join, and then a welcome or a refusal.</summary>
internal sealed class JoinRequests(
    JoinAttempts attempts, HostConnection connection, PlayerSeat seat, LastAnswer answer, SharedWorld world,
    SessionStatus status, DatagramSender sender, SessionCounters counters, IClock clock, ClientOptions options)
{
    /// <summary>
    /// How many joins are made a second, and how many answers tried, and at once: each costs an agreement or two. Only somebody on the path
    /// can make it more than a few.
    /// </summary>
    private const int HandshakesPerSecond = 50;

    private readonly RateLimit joins = new(HandshakesPerSecond, HandshakesPerSecond, clock.Now);
    private readonly RateLimit answers = new(HandshakesPerSecond, HandshakesPerSecond, clock.Now);

    /// <summary>Raised when the host that lets this peer in has another key from now on, for which the one that was known vouches.</summary>
    internal event Action? HostKeyChanged;

    /// <summary>Asks if it is time to.</summary>
    internal void Tend(SimTime now)
    {
        if (attempts.Current is not JoinAttempt attempt || attempt.Due > now)
        {
            return;
        }

        if (attempt.Next(now) is PreparedJoin join)
        {
            sender.Send(join.Bytes, connection.Host);
        }
        else
        {
            Span<byte> bytes = stackalloc byte[WireFormat.ConnectRequestBytes];
            Span<byte> wanted = stackalloc byte[IHostProtection.FingerprintBytes];
            wanted.Clear();
            options.Protection?.WriteWanted(wanted);
            int length = new ConnectRequestDatagram(attempt.Nonce, new Token128(wanted)).Encode(bytes);
            foreach (PeerAddress to in connection.ToAsk(now - attempt.Began))
            {
                sender.Send(bytes.Slice(0, length), to);
            }
        }
    }

    internal void OnChallenge(in ChallengeDatagram challenge, PeerAddress from)
    {
        SimTime now = clock.Now;
        if (attempts.Current is not JoinAttempt attempt || attempt.IsWelcome || challenge.Nonce != attempt.Nonce)
        {
            counters.DatagramsIgnored++;
        }
        else if (!attempt.Has(challenge.Cookie, now))
        {
            Join(attempt, challenge, from, now);
        }
    }

    /// <summary>Handles a challenge of this peer's address, which the host does not know for this peer.</summary>
    internal void OnMoveChallenge(in MoveChallengeDatagram challenge)
    {
        if (connection.Link is not UpdateLink link || challenge.SessionId != link.SessionId)
        {
            counters.DatagramsIgnored++;
            return;
        }

        // The host is alive, though it sends nothing else until the address is confirmed.
        link.NoteHeard(clock.Now);
        Span<byte> bytes = stackalloc byte[WireFormat.MoveBytes];
        sender.Send(bytes.Slice(0, new MoveDatagram(link.SessionId, link.Self, challenge.Cookie).Encode(bytes)), link);
    }

    internal void OnWelcome(in WelcomeDatagram welcome)
    {
        if (options.IsProtected || attempts.Current is not JoinAttempt attempt || welcome.Nonce != attempt.Nonce)
        {
            counters.DatagramsIgnored++;
        }
        else if (!attempt.IsWelcome)
        {
            Enter(attempt, attempt.Joins.Count > 0 ? attempt.Joins[0] : null, welcome, null);
        }
    }

    internal void OnSecureWelcome(in SecureAnswerDatagram answer)
    {
        if (!IsOfAttempt(answer, out JoinAttempt? attempt))
        {
            return;
        }

        Span<byte> payload = stackalloc byte[WireFormat.SecureWelcomePayloadBytes];
        IDatagramCipher? cipher = null;
        PreparedJoin? answered = null;
        for (int n = 0; cipher is null && n < attempt.Joins.Count && answers.TrySpend(clock.Now); n++)
        {
            answered = attempt.Joins[n];
            cipher = answered.Handshake?.TryFinish(options.ConnectKey, answer.Message, payload);
        }

        if (cipher is null)
        {
            counters.DatagramsForged++;
            return;
        }

        WireReader reader = new(payload);
        WelcomeDatagram welcome = WelcomeDatagram.ReadTerms(ref reader, answer.Nonce);
        LinkSeal seal = new(cipher, Token128.Read(ref reader));
        bool isKeyChanged = answered!.Handshake!.IsHostKeyChanged; // the attempt wipes the handshake
        if (counters.IsWellFormed(reader.Finish(out _)))
        {
            Enter(attempt, answered, welcome, seal);
            if (isKeyChanged)
            {
                HostKeyChanged?.Invoke();
            }
        }
        else
        {
            seal.Dispose();
        }
    }

    internal void OnSecureRefusal(in SecureAnswerDatagram answer)
    {
        if (!IsOfAttempt(answer, out JoinAttempt? attempt))
        {
            return;
        }

        Span<byte> payload = stackalloc byte[WireFormat.SecureRefusalPayloadBytes];
        bool isRead = false;
        for (int n = 0; !isRead && n < attempt.Joins.Count && answers.TrySpend(clock.Now); n++)
        {
            isRead = attempt.Joins[n].Handshake?.TryReadRefusal(answer.Message, payload) == true;
        }

        if (!isRead)
        {
            counters.DatagramsForged++;
            return;
        }

        WireReader reader = new(payload);
        RefusalReason reason = (RefusalReason)reader.ReadByte();
        uint secondsOff = reader.ReadUInt32();
        if (counters.IsWellFormed(RefusalDatagram.IsOne(reason)))
        {
            End(reason, Sentence(reason, secondsOff));
        }
    }

    /// <summary>Handles a refusal that is not part of a handshake.</summary>
    /// <param name="refusal">The refusal: of the current attempt, or over the link of the session id that it has for a nonce.</param>
    /// <param name="isSealed">Whether it came over the protected link.</param>
    /// <param name="from">Where it came from.</param>
    internal void OnRefusal(in RefusalDatagram refusal, bool isSealed, PeerAddress from)
    {
        bool isOfLink = connection.Link is UpdateLink link && refusal.Nonce == link.SessionId && isSealed == options.IsProtected;
        if (isOfLink && attempts.Current is not null)
        {
            End(refusal.Reason, Sentence(refusal.Reason));
        }
        else
        {
            TakeUnproven(refusal.Nonce, refusal.Reason, Sentence(refusal.Reason), from);
        }
    }

    /// <summary>Handles a host that speaks another version of the protocol.</summary>
    internal void OnOtherVersion(ulong nonce, byte version, PeerAddress from) =>
        TakeUnproven(nonce, null, $"it speaks version {version} of the protocol, this peer {WireFormat.Version}.", from);

    private string Sentence(RefusalReason reason, uint secondsOff = 0) => reason switch
    {
        RefusalReason.VersionDiffers => "it speaks another version of the protocol.",
        RefusalReason.SceneDiffers => "it has another scene now. A session keeps its scene; start a new one to join that.",
        RefusalReason.WrongKey => options.ConnectKey.Length > 0 ? "the key is wrong." : "it needs a key, and this peer has none.",
        RefusalReason.Full => "the session is full.",
        RefusalReason.TooLarge => "its world is too large to be copied.",
        RefusalReason.FoldDiffers => $"it computes worlds by other rules than this peer, whose fold version is {Simulation.FoldVersion}."
            + " Both need the same version of LagSim.",
        RefusalReason.Banned => "it has shut out this player, or this address.",
        RefusalReason.TooManyFromOneAddress =>
            "as many as may join from one address have joined from this one (the host's MaxClientsPerAddress).",
        RefusalReason.ProtectedOnly =>
            "its session is protected, and this peer's is not. Join with protection, by the host's address with its fingerprint.",
        RefusalReason.TokenMissing => "it admits only players with a connect token. Ask the game's backend for one.",
        RefusalReason.TokenDamaged => "that is not a valid connect token, or it was altered. Ask for another.",
        RefusalReason.TokenOfOtherIssuer => "the connect token is from another backend than this host's.",
        RefusalReason.TokenOfOtherHost => "the connect token is for another host. Ask for one for this host.",
        RefusalReason.TokenExpired => $"the connect token's time was over {secondsOff} s ago, by the host's clock. Ask for another;"
            + " if that is refused too, the clocks of host and backend differ.",
        RefusalReason.TokenNotYetValid => $"the connect token's time begins in {secondsOff} s, by the host's clock: the clocks of"
            + " host and backend differ.",
        RefusalReason.TokenUsed => "a player came in with the connect token before. Ask for another.",
        RefusalReason.TooManyWrongKeys => "too many wrong keys came from this address; it looks at no key from here for "
            + (secondsOff > 0 ? $"another {secondsOff} s." : "a while."),
        _ => $"reason {(int)reason}.",
    };

    /// <summary>Whether an answer may belong to a handshake that waits for one; if not, it is counted.</summary>
    private bool IsOfAttempt(in SecureAnswerDatagram answer, [NotNullWhen(true)] out JoinAttempt? attempt)
    {
        attempt = attempts.Current;
        if (options.IsProtected && attempt is { IsWelcome: false } && attempt.Nonce == answer.Nonce && attempt.Joins.Count > 0)
        {
            return true;
        }

        counters.DatagramsIgnored++;
        return false;
    }

    /// <summary>Makes the join that brings a cookie back, and the handshake with the host that sent it.</summary>
    private void Join(JoinAttempt attempt, in ChallengeDatagram challenge, PeerAddress from, SimTime now)
    {
        if (options.Protection is not IClientProtection protection)
        {
            JoinDatagram join = Claims(attempt.Nonce, challenge.Cookie, default);
            byte[] plain = new byte[join.EncodedLength];
            join.Encode(plain);
            connection.Choose(from);
            attempt.Take(new PreparedJoin(challenge.Cookie, plain, null, now), now);
        }
        else if (challenge.Identity.IsNone)
        {
            counters.DatagramsIgnored++;
            answer.NoteNoProtection();
        }
        else if (!joins.TrySpend(now))
        {
            counters.DatagramsIgnored++;
        }
        else
        {
            IClientHandshake? handshake = SecureJoinDatagram.Begin(attempt.Nonce, challenge.Cookie, challenge.Identity, protection);
            if (handshake is null)
            {
                counters.DatagramsForged++;
                answer.NoteOtherHost();
                return;
            }

            Span<byte> binding = stackalloc byte[IHostProtection.BindingBytes];
            handshake.WriteBinding(binding);
            JoinDatagram join = Claims(attempt.Nonce, challenge.Cookie, binding);
            byte[] secure = new byte[IHostProtection.HandshakeOverhead + join.EncodedLength + options.Token.Length];
            SecureJoinDatagram.Encode(secure, join, options.Token.Span, handshake);
            connection.Choose(from);
            attempt.Take(new PreparedJoin(challenge.Cookie, secure, handshake, now), now);
        }
    }

    /// <summary>What this peer tells the host of itself, with proofs for this nonce and cookie, and this handshake if there is one.</summary>
    private JoinDatagram Claims(ulong nonce, Token128 cookie, ReadOnlySpan<byte> binding)
    {
        PlayerPass former = seat.Pass ?? default;
        return new JoinDatagram(
            nonce, cookie, JoinCookies.Prove(options.ConnectKey, nonce, cookie, binding), world.Scene?.HashButSeed ?? 0, (uint)Simulation.FoldVersion,
            former.Number, former.Number == 0 ? default : JoinCookies.Prove(former.Secret, nonce, cookie, binding), (byte)options.Role, options.Name);
    }

    private void Enter(JoinAttempt attempt, PreparedJoin? answered, in WelcomeDatagram welcome, LinkSeal? seal)
    {
        SimTime now = clock.Now;
        answer.Forget();
        attempt.Take(welcome, answered, now);
        connection.Open(welcome, seal, now);
        status.State = status.State == SessionState.Joining ? SessionState.Synchronising : status.State;
    }

    /// <summary>
    /// Handles a refusal in clear text: in a session without protection it counts, in a protected one it may be anybody's.
    /// </summary>
    private void TakeUnproven(ulong nonce, RefusalReason? reason, string why, PeerAddress from)
    {
        if (attempts.Current is not JoinAttempt attempt || nonce != attempt.Nonce)
        {
            counters.DatagramsIgnored++;
        }
        else if (options.IsProtected)
        {
            counters.DatagramsForged++;
            answer.NoteUnproven(why);
        }
        else
        {
            connection.Choose(from);
            End(reason, why);
        }
    }

    private void End(RefusalReason? reason, string why)
    {
        string sentence = $"The {connection.Name} refused: {why}";
        bool isKnown = status.IsRejoining || (options.Pass.Number > 0 && clock.Now - attempts.Began <= options.RejoinTime);
        if (isKnown && reason is RefusalReason.Full or RefusalReason.TooManyFromOneAddress or RefusalReason.TooManyWrongKeys)
        {
            attempts.Restart(clock.Now + SimDuration.FromSeconds(1)); // a place may become free
            connection.Close();
            answer.NoteRefusal(sentence);
        }
        else
        {
            status.Refuse(reason, sentence);
        }
    }
}
