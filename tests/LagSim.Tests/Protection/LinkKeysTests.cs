using System;
using System.Collections.Generic;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>Both ends of a link agree which keys are in use, whatever the path loses, repeats and overtakes; old keys do not stay.</summary>
public sealed class LinkKeysTests
{
    private const ulong Session = 7;

    /// <summary>
    /// Drawn links of a day each, which lose up to half, repeat a tenth and hold each datagram up to 9 s: whatever comes for the first time is
    /// opened, and both ends are never more than one generation apart. The control: of what is held for up to 40 s, longer than keys are kept,
    /// some is not opened.
    /// </summary>
    [Theory]
    [InlineData(9, true)]
    [InlineData(40, false)]
    public void Open_OverDrawnPaths_IsPossibleAsLongAsKeysAreKept(double longestHold, bool isAllOpened)
    {
        int refused = 0, opened = 0, least = int.MaxValue;
        for (int seed = 1; seed <= 5; seed++)
        {
            Path path = new(seed, longestHold);
            path.Play(SimDuration.FromSeconds(86_400));
            Assert.InRange((long)path.Client.Keys.Generation - path.Host.Keys.Generation, 0, 1);
            refused += path.Refused;
            opened += path.Opened;
            least = Math.Min(least, (int)path.Host.Keys.Generation);
        }

        Assert.True(opened > 50_000);
        Assert.Equal(isAllOpened, refused == 0);
        Assert.InRange(least, 90, 96); // every quarter of an hour
    }

    [Fact]
    public void Tend_OnceTheOtherEndUsesFreshKeys_WipesTheFormer()
    {
        Path path = new(1, longestHold: 0);
        path.Play(SimDuration.FromSeconds(890));
        Assert.False(path.Client.Keys.HasFormer || path.Host.Keys.HasFormer);
        path.Play(SimDuration.FromSeconds(17));
        Assert.True(path.Client.Keys.HasFormer && path.Host.Keys.HasFormer);
        Assert.Equal((1u, 1u), (path.Client.Keys.Generation, path.Host.Keys.Generation));
        path.Play(SimDuration.FromSeconds(20));
        Assert.False(path.Client.Keys.HasFormer || path.Host.Keys.HasFormer);
    }

    /// <summary>A client that offers without end has a host agree once a minute at most, and an offer that is answered is not replaced.</summary>
    [Fact]
    public void Answer_ToAClientThatOffersWithoutEnd_ComesOnceAMinute()
    {
        (IDatagramCipher client, LinkSeal host) = Ends();
        SimTime now = SimTime.FromSeconds(100);
        host.Keys.Tend(now);
        int answered = 0;
        byte[] first = [], offer = new byte[IDatagramCipher.ExchangeBytes], sealing = new byte[WireFormat.MaxBytes], opened = new byte[WireFormat.MaxBytes];
        for (int n = 1; n <= 600; n++)
        {
            now += SimDuration.FromSeconds(1);
            uint next = host.Keys.Generation + 1;
            using IKeyExchange begun = client.BeginExchange([.. BitConverter.GetBytes(Session), .. BitConverter.GetBytes(next)], offer);
            if (host.Keys.TryAnswer(new KeyExchangeDatagram(Session, next, offer), now, out KeyExchangeDatagram reply))
            {
                answered++;
                first = [.. reply.Message];
                Assert.True(host.Keys.TryAnswer(new KeyExchangeDatagram(Session, next, offer), now, out reply));
                Assert.Equal(first, reply.Message.ToArray()); // the same again
                using IKeyExchange other = client.BeginExchange([.. BitConverter.GetBytes(Session), .. BitConverter.GetBytes(next)], new byte[48]);
                byte[] changed = [.. offer];
                changed[0] ^= 1;
                Assert.False(host.Keys.TryAnswer(new KeyExchangeDatagram(Session, next, changed), now, out _));
                client = begun.TryFinish(first)!;
                int length = SealedDatagram.Encode(Gone(), (ulong)n, client, sealing, (byte)next);
                Assert.True(SealedDatagram.TryDecode(sealing.AsSpan(0, length), out SealedDatagram one, out _));
                Assert.True(host.TryOpen(one, opened, out _, out _)); // the client uses them
                host.Keys.Tend(now);
            }
        }

        Assert.Equal(10, answered);
    }

    /// <summary>A message for another link, another generation or of other keys is no offer and no answer, and changes nothing.</summary>
    [Fact]
    public void Exchange_ForAnotherLinkOrGeneration_IsNotRead()
    {
        (IDatagramCipher client, IDatagramCipher host) = Ciphers();
        byte[] offer = new byte[IDatagramCipher.ExchangeBytes], answer = new byte[IDatagramCipher.ExchangeBytes];
        byte[] prologue = [.. BitConverter.GetBytes(Session), 1, 0, 0, 0];
        using IKeyExchange begun = client.BeginExchange(prologue, offer);
        foreach (int at in new[] { 0, 8 })
        {
            byte[] other = [.. prologue];
            other[at] ^= 1;
            Assert.Null(host.TryAnswerExchange(other, offer, answer));
        }

        for (int at = 0; at < offer.Length; at++)
        {
            byte[] changed = [.. offer];
            changed[at] ^= 4;
            Assert.Null(host.TryAnswerExchange(prologue, changed, answer));
        }

        Assert.Null(host.TryAnswerExchange(prologue, offer.AsSpan(1), answer));
        Assert.Null(Ciphers().Host.TryAnswerExchange(prologue.AsSpan(0, 11), offer, answer));
        using IDatagramCipher fresh = host.TryAnswerExchange(prologue, offer, answer)!;
        for (int at = 0; at < answer.Length; at++)
        {
            byte[] changed = [.. answer];
            changed[at] ^= 4;
            Assert.Null(begun.TryFinish(changed));
        }

        using IDatagramCipher its = begun.TryFinish(answer)!;
        byte[] made = new byte[19], plain = new byte[3];
        fresh.Seal(5, default, [1, 2, 3], made);
        Assert.True(its.TryOpen(5, default, made, plain));
        Assert.False(client.TryOpen(5, default, made, plain));
    }

    private static (NoiseCipher Client, NoiseCipher Host) Ciphers()
    {
        using NoiseSymmetricState state = NoiseHandshake.Begin([], new byte[32]);
        return (NoiseCipher.OfClient(state), NoiseCipher.OfHost(state));
    }

    private static (IDatagramCipher Client, LinkSeal Host) Ends()
    {
        (NoiseCipher client, NoiseCipher host) = Ciphers();
        return (client, new LinkSeal(host));
    }

    private static byte[] Gone()
    {
        byte[] bytes = new byte[WireFormat.LeaveBytes];
        new LeaveDatagram(Session, 1, LeaveReason.Left).Encode(bytes);
        return bytes;
    }

    /// <summary>Two ends that say something about every other second, over a path that is drawn.</summary>
    private sealed class Path
    {
        private readonly Random random;
        private readonly double hold;
        private readonly double lost;
        private readonly PriorityQueue<(LinkSeal To, byte[] Bytes), double> underWay = new();
        private readonly byte[] sealing = new byte[WireFormat.MaxBytes];
        private readonly byte[] opened = new byte[WireFormat.MaxBytes];
        private SimTime now = SimTime.FromSeconds(3);

        internal Path(int seed, double longestHold)
        {
            random = new Random(seed);
            hold = longestHold;
            lost = longestHold == 0 ? 0 : random.NextDouble() / 2;
            (NoiseCipher client, NoiseCipher host) = Ciphers();
            (Client, Host) = (new LinkSeal(client), new LinkSeal(host));
        }

        internal LinkSeal Client { get; }

        internal LinkSeal Host { get; }

        internal int Opened { get; private set; }

        internal int Refused { get; private set; }

        internal void Play(SimDuration time)
        {
            for (SimTime end = now + time; now < end; now += SimDuration.FromSeconds(0.1 + (3 * random.NextDouble())))
            {
                while (underWay.TryPeek(out (LinkSeal To, byte[] Bytes) one, out double at) && at <= now.ToSeconds())
                {
                    underWay.Dequeue();
                    Deliver(one.To, one.Bytes);
                }

                Client.Keys.Tend(now);
                Host.Keys.Tend(now);
                Assert.False(Client.Keys.AreTooOld(now) || Host.Keys.AreTooOld(now));
                Send(Client, Gone());
                Send(Host, Gone());
                if (Client.Keys.TryOffer(Session, now, out KeyExchangeDatagram offer))
                {
                    Send(Client, Written(DatagramType.KeyExchange, offer));
                }
            }
        }

        private static byte[] Written(DatagramType type, in KeyExchangeDatagram one)
        {
            byte[] bytes = new byte[WireFormat.KeyExchangeBytes];
            one.Encode(type, bytes);
            return bytes;
        }

        private void Send(LinkSeal from, byte[] datagram)
        {
            byte[] bytes = sealing[..from.Seal(datagram, sealing)];
            for (int copies = random.NextDouble() < 0.1 ? 2 : 1; copies > 0; copies--)
            {
                if (random.NextDouble() >= lost)
                {
                    underWay.Enqueue((from == Client ? Host : Client, bytes), now.ToSeconds() + (hold * random.NextDouble()));
                }
            }
        }

        private void Deliver(LinkSeal to, byte[] bytes)
        {
            Assert.True(SealedDatagram.TryDecode(bytes, out SealedDatagram one, out _));
            bool isOpened = to.TryOpen(one, opened, out int length, out bool isRepeated);
            Opened += isOpened ? 1 : 0;
            Refused += isOpened || isRepeated ? 0 : 1;
            if (!isOpened)
            {
                return;
            }

            DatagramType type = (DatagramType)opened[3];
            if (to == Host && KeyExchangeDatagram.TryDecode(opened.AsSpan(0, length), DatagramType.KeyExchange, out KeyExchangeDatagram offer, out _)
                && Host.Keys.TryAnswer(offer, now, out KeyExchangeDatagram reply))
            {
                Send(Host, Written(DatagramType.KeyExchangeReply, reply));
            }
            else if (to == Client && type == DatagramType.KeyExchangeReply
                && KeyExchangeDatagram.TryDecode(opened.AsSpan(0, length), type, out KeyExchangeDatagram its, out _))
            {
                Client.Keys.TryFinish(its);
            }
        }
    }
}
