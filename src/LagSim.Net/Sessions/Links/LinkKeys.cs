using System;
using System.Buffers.Binary;
using LagSim.Net.Protection;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// The keys of one end of a link, one generation after another: those in use, those before for what was overtaken, and those to come. A
/// client's end begins the exchange that makes the next ones; the host's answers.
/// </summary>
/// <remarks>
/// <para>Every sealed datagram says of which generation it is, so none is lost by a change. A client uses fresh keys from the answer on, a
/// host from the first datagram on that the client sealed with them: nobody seals what the other end cannot open yet. Whatever is lost, the
/// client offers the same message again, and the host gives the same answer.</para>
/// <para>For one thread.</para>
/// </remarks>
/// <param name="first">The keys of the handshake, generation 0.</param>
internal sealed class LinkKeys(IDatagramCipher first) : IDisposable
{
    /// <summary>How old keys are when a client begins to exchange them.</summary>
    internal static readonly SimDuration Interval = SimDuration.FromSeconds(15 * 60);

    /// <summary>How old keys become at most: then an end gives up the link.</summary>
    internal static readonly SimDuration MaxAge = SimDuration.FromSeconds(60 * 60);

    /// <summary>How old keys are at least before a host lets them be exchanged: a client cannot have it agree without end.</summary>
    internal static readonly SimDuration MinAge = SimDuration.FromSeconds(60);

    /// <summary>How long a client waits for an answer before it offers again.</summary>
    internal static readonly SimDuration Again = SimDuration.FromSeconds(1);

    /// <summary>How long the keys before are kept once the other end uses those after them, for what was overtaken.</summary>
    internal static readonly SimDuration Overtaken = SimDuration.FromSeconds(10);

    private readonly byte[] offer = new byte[IDatagramCipher.ExchangeBytes];
    private readonly byte[] answer = new byte[IDatagramCipher.ExchangeBytes];
    private IDatagramCipher current = first;
    private IDatagramCipher? before;
    private IDatagramCipher? next; // at a host that has answered
    private IKeyExchange? begun; // at a client that has offered
    private bool isInUse; // the other end has sealed something with the current keys
    private SimTime offered;
    private SimTime since = SimTime.MinValue; // when the current keys came, as far as is known
    private SimTime inUseSince = SimTime.MinValue;

    /// <summary>Which keys are in use here: how many exchanges there were.</summary>
    internal uint Generation { get; private set; }

    /// <summary>Whether the keys are wiped.</summary>
    internal bool IsWiped { get; private set; }

    /// <summary>Whether the keys before those in use are still there.</summary>
    internal bool HasFormer => before is not null;

    /// <summary>Wipes all keys.</summary>
    public void Dispose()
    {
        IsWiped = true;
        before?.Dispose();
        current.Dispose();
        next?.Dispose();
        begun?.Dispose();
    }

    /// <summary>Seals a datagram with the keys in use.</summary>
    internal int Seal(ReadOnlySpan<byte> datagram, ulong number, Span<byte> destination) =>
        SealedDatagram.Encode(datagram, number, current, destination, (byte)Generation);

    /// <summary>Opens a datagram with the keys that it says it has. One of the generation to come makes that the one in use.</summary>
    internal bool TryOpen(in SealedDatagram datagram, Span<byte> destination, out int length)
    {
        length = 0;
        IDatagramCipher? cipher = Of(datagram.Generation);
        if (IsWiped || cipher is null || !datagram.TryOpen(cipher, destination, out length))
        {
            return false;
        }

        if (cipher == next)
        {
            next = null;
            Advance(cipher);
        }

        isInUse |= cipher == current;
        return true;
    }

    /// <summary>Notes the time, and wipes keys that nothing needs any more.</summary>
    internal void Tend(SimTime now)
    {
        since = since == SimTime.MinValue ? now : since;
        if (before is null || !isInUse)
        {
            return;
        }

        inUseSince = inUseSince == SimTime.MinValue ? now : inUseSince;
        if (now - inUseSince > Overtaken)
        {
            before.Dispose();
            before = null;
        }
    }

    /// <summary>This machine slept: the exchange is due now, and nothing was amiss meanwhile.</summary>
    internal void NoteSuspend(SimTime now) => since = SimTime.Max(since, now - Interval);

    /// <summary>Whether the keys are so old that the link is to be given up: no exchange came about.</summary>
    internal bool AreTooOld(SimTime now) => since != SimTime.MinValue && now - since > MaxAge;

    /// <summary>At a client: makes the offer that is due, or due again.</summary>
    /// <param name="sessionId">The session id of the link.</param>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="offering">The offer; it belongs to this object.</param>
    internal bool TryOffer(ulong sessionId, SimTime now, out KeyExchangeDatagram offering)
    {
        bool isDue = !IsWiped && isInUse && since != SimTime.MinValue && now - since >= Interval && (begun is null || now - offered >= Again);
        if (isDue)
        {
            begun ??= current.BeginExchange(Prologue(sessionId, Generation + 1), offer);
            offered = now;
        }

        offering = new KeyExchangeDatagram(sessionId, Generation + 1, offer);
        return isDue;
    }

    /// <summary>At a client: takes the host's answer. False if it answers no offer that is open.</summary>
    internal bool TryFinish(in KeyExchangeDatagram reply)
    {
        if (IsWiped || begun is null || reply.Generation != Generation + 1 || begun.TryFinish(reply.Message) is not IDatagramCipher fresh)
        {
            return false;
        }

        begun.Dispose();
        begun = null;
        Advance(fresh);
        return true;
    }

    /// <summary>At a host: answers an offer; the same one gets the same answer. False for one that is not to be answered.</summary>
    /// <param name="offering">The offer.</param>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="reply">The answer; it belongs to this object.</param>
    internal bool TryAnswer(scoped in KeyExchangeDatagram offering, SimTime now, out KeyExchangeDatagram reply)
    {
        reply = new KeyExchangeDatagram(offering.SessionId, offering.Generation, answer);
        if (IsWiped || offering.Generation != Generation + 1)
        {
            return false;
        }

        if (next is not null)
        {
            return offering.Message.SequenceEqual(offer);
        }

        if (since == SimTime.MinValue || now - since < MinAge)
        {
            return false;
        }

        offering.Message.CopyTo(offer);
        next = current.TryAnswerExchange(Prologue(offering.SessionId, offering.Generation), offer, answer);
        return next is not null;
    }

    /// <summary>What both ends know of an exchange: the link, and which generation it makes.</summary>
    private static byte[] Prologue(ulong sessionId, uint generation)
    {
        byte[] bytes = new byte[sizeof(ulong) + sizeof(uint)];
        BinaryPrimitives.WriteUInt64LittleEndian(bytes, sessionId);
        BinaryPrimitives.WriteUInt32LittleEndian(bytes.AsSpan(sizeof(ulong)), generation);
        return bytes;
    }

    private IDatagramCipher? Of(byte generation) =>
        generation == (byte)Generation ? current
        : generation == (byte)(Generation + 1) ? next
        : generation == (byte)(Generation - 1) ? before
        : null;

    private void Advance(IDatagramCipher fresh)
    {
        before?.Dispose();
        before = current;
        current = fresh;
        Generation++;
        isInUse = false;
        since = inUseSince = SimTime.MinValue;
    }
}
