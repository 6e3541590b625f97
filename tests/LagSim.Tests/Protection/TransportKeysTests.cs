using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>No key ever sees a nonce twice, keys change where the page says, and what is old or came before is not taken.</summary>
public sealed class TransportKeysTests
{
    private static readonly byte[] First = [.. Enumerable.Range(0, 32).Select(n => (byte)n)];

    /// <summary>Noise's REKEY by hand: what the key makes of 32 zeros with the highest nonce.</summary>
    [Fact]
    public void Seal_AcrossKeys_UsesTheKeysOfThePage()
    {
        using TransportKeys keys = new(First);
        byte[] key = First, plain = [1, 2, 3], made = new byte[19], byHand = new byte[19];
        for (ulong period = 0; period < 4; period++)
        {
            foreach (ulong number in new[] { (period * TransportKeys.Span) + 1, ((period + 1) * TransportKeys.Span) - 1 })
            {
                keys.Seal(number, default, plain, made);
                using Aead cipher = new BouncyCastleAead(key);
                cipher.Seal(number, default, plain, byHand);
                Assert.Equal(byHand, made);
            }

            byte[] next = new byte[48];
            using Aead rekey = new BouncyCastleAead(key);
            rekey.Seal(ulong.MaxValue, default, new byte[32], next);
            key = next[..32];
        }
    }

    /// <summary>
    /// The key after the one in use is nowhere in managed memory before it is needed, nor after that as bytes. The control: a key that is kept
    /// beside its cipher is found.
    /// </summary>
    [Fact]
    public void Next_BeforeAndAfterItIsNeeded_IsNotKeptAsBytes()
    {
        byte[] next = new byte[48], later = new byte[48];
        using Aead first = new BouncyCastleAead(First);
        first.Seal(ulong.MaxValue, default, new byte[32], next);
        using Aead second = new BouncyCastleAead(next.AsSpan(0, 32));
        second.Seal(ulong.MaxValue, default, new byte[32], later);
        using TransportKeys keys = new(First);
        Assert.False(Holds(keys, next[..32]));
        byte[] plain = new byte[3], made = Sealed(keys, TransportKeys.Span);
        using TransportKeys its = new(First);
        Assert.True(its.TryOpen(TransportKeys.Span, default, made, plain));
        Assert.False(Holds(keys, next[..32]) || Holds(keys, later[..32]) || Holds(its, next[..32]) || Holds(its, later[..32]));
        Assert.True(Holds((keys, next[..32]), next[..32]));
    }

    [Fact]
    public void Open_AroundAChangeOfKeys_TakesWhatIsNear()
    {
        using TransportKeys sending = new(First), receiving = new(First);
        const ulong span = TransportKeys.Span;
        byte[] before = Sealed(sending, span - 1), after = Sealed(sending, span), later = Sealed(sending, 2 * span), much = Sealed(sending, 5 * span);
        byte[] plain = new byte[3];
        Assert.True(receiving.TryOpen(span, default, after, plain));
        Assert.True(receiving.TryOpen(span - 1, default, before, plain)); // overtaken
        byte[] forged = [.. later];
        forged[0] ^= 1;
        Assert.False(receiving.TryOpen(2 * span, default, forged, plain)); // moves no key on
        Assert.True(receiving.TryOpen(span - 1, default, before, plain));
        Assert.True(receiving.TryOpen(2 * span, default, later, plain));
        Assert.False(receiving.TryOpen(span - 1, default, before, plain)); // its key is gone
        Assert.True(receiving.TryOpen(span, default, after, plain));
        Assert.False(receiving.TryOpen(5 * span, default, much, plain)); // no link loses that many in a row
    }

    /// <summary>
    /// A nonce repeats only if a number does, and numbers count up to 2^48 within a link, whose keys no other link has: 2^32 datagrams are
    /// far below.
    /// </summary>
    [Fact]
    public void Numbers_OfALink_NeverRepeatAndEndBeforeTheyWrap()
    {
        CountingCipher cipher = new();
        using LinkSeal seal = new(cipher);
        byte[] datagram = new byte[WireFormat.LeaveBytes], sealing = new byte[WireFormat.MaxBytes];
        for (int n = 0; n < 100_000; n++)
        {
            seal.Seal(datagram, sealing);
        }

        Assert.Equal(Enumerable.Range(1, 100_000).Select(n => (ulong)n), cipher.Sealed);
        Assert.True(SealedDatagram.MaxNumber / (1UL << 32) == 65_535);
        const double perSecond = 100_000;
        Assert.True(SealedDatagram.MaxNumber / perSecond / 86_400 / 365 > 89);
    }

    /// <summary>Each handshake has keys of its own, though host, client, connect key and prologue are the same.</summary>
    [Fact]
    public void Keys_OfManyHandshakes_AreAllDifferent()
    {
        using HostIdentity identity = HostIdentity.Draw();
        SecureHost host = new(identity);
        byte[] plain = new byte[32], sealedOnes = new byte[48], payload = new byte[5], message = new byte[53], shown = new byte[32];
        host.WriteIdentity(shown);
        HashSet<string> all = [];
        for (int n = 0; n < 50; n++)
        {
            using IClientHandshake mine = new SecureClient(identity.Fingerprint).Begin(shown, [1])!;
            mine.Write(payload, message);
            using IHostHandshake its = host.TryRead([1], message, payload)!;
            byte[] answer = new byte[53];
            using IDatagramCipher hostEnd = its.Accept("key", payload, answer);
            using IDatagramCipher clientEnd = mine.TryFinish("key", answer, payload)!;
            foreach (IDatagramCipher end in new[] { hostEnd, clientEnd })
            {
                end.Seal(1, default, plain, sealedOnes);
                Assert.True(all.Add(Convert.ToHexString(sealedOnes)));
            }
        }
    }

    [Fact]
    public void Open_RepeatedOvertakenAndOld_TakesEachNumberOnce()
    {
        (LinkSeal a, LinkSeal b) = Link();
        List<byte[]> sent = [];
        byte[] buffer = new byte[WireFormat.MaxBytes], opened = new byte[WireFormat.MaxBytes];
        for (int n = 0; n < 3000; n++)
        {
            byte[] datagram = new byte[WireFormat.LeaveBytes + (n % 5)];
            new LeaveDatagram(7, (byte)n, LeaveReason.Left).Encode(datagram);
            sent.Add([.. buffer.AsSpan(0, a.Seal(datagram, buffer))]);
        }

        Random random = new(3);
        HashSet<int> taken = [];
        int newest = -1;
        for (int n = 0; n < 20_000; n++)
        {
            int which = Math.Clamp((n * 3000 / 20_000) + random.Next(-1400, 200), 0, 2999);
            Assert.True(SealedDatagram.TryDecode(sent[which], out SealedDatagram one, out _));
            bool isNew = b.TryOpen(one, opened, out int length, out bool isRepeated);
            Assert.Equal(which > newest || (newest - which < SeenNumbers.Span && !taken.Contains(which)), isNew);
            Assert.Equal(!isNew, isRepeated);
            newest = Math.Max(newest, which);
            Assert.True(!isNew || (taken.Add(which) && opened[12] == (byte)which && length == sent[which].Length - WireFormat.SealBytes));
        }

        Assert.True(taken.Count > 1000);
    }

    /// <summary>
    /// Of two million changed datagrams not one is taken, by host or client, and the link goes on: bits flipped, bytes set, cut, made longer, joined with
    /// others, at random and at each place.
    /// </summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Open_TwoMillionMutations_TakesNoneAndGoesOn(bool atHost)
    {
        (LinkSeal client, LinkSeal host) = Link();
        (LinkSeal a, LinkSeal b) = atHost ? (client, host) : (host, client);
        Random random = new(20261127);
        byte[] buffer = new byte[WireFormat.MaxBytes], opened = new byte[WireFormat.MaxBytes], datagram = new byte[90];
        new LeaveDatagram(7, 1, LeaveReason.Left).Encode(datagram);
        byte[] real = [.. buffer.AsSpan(0, a.Seal(datagram, buffer))];
        int undecoded = 0, refused = 0;
        for (int n = 0; n < 2_000_000; n++)
        {
            int length = real.Length;
            real.CopyTo(buffer, 0);
            int at = random.Next(4, length);
            switch (random.Next(4))
            {
                case 0:
                    buffer[at] ^= (byte)(1 << random.Next(8));
                    break;
                case 1:
                    buffer[at] += (byte)random.Next(1, 256);
                    break;
                case 2:
                    length = random.Next(1, length);
                    break;
                default:
                    buffer[length++] = (byte)random.Next(256);
                    break;
            }

            if (!SealedDatagram.TryDecode(buffer.AsSpan(0, length), out SealedDatagram one, out _))
            {
                undecoded++;
            }
            else if (one.SessionId == 7) // another one is no link of this peer's
            {
                Assert.False(b.TryOpen(one, opened, out _, out _));
                refused++;
            }
        }

        Assert.True(undecoded > 100_000 && refused > 1_000_000);
        Assert.True(SealedDatagram.TryDecode(real, out SealedDatagram last, out _));
        Assert.True(b.TryOpen(last, opened, out int taken, out _));
        Assert.Equal(datagram, opened[..taken]);
    }

    private static (LinkSeal A, LinkSeal B) Link()
    {
        NoiseSymmetricState state = NoiseHandshake.Begin([], new byte[32]);
        return (new LinkSeal(NoiseCipher.OfClient(state)), new LinkSeal(NoiseCipher.OfHost(state)));
    }

    /// <summary>Whether an object, or what it refers to, has these bytes in an array.</summary>
    private static bool Holds(object of, byte[] bytes)
    {
        Stack<object> open = new([of]);
        HashSet<object> seen = new(ReferenceEqualityComparer.Instance);
        while (open.TryPop(out object? one))
        {
            if (one is byte[] array && array.AsSpan().IndexOf(bytes) >= 0)
            {
                return true;
            }

            for (Type? type = one.GetType(); type is not null && !type.IsArray && !type.IsPrimitive && seen.Count < 1000; type = type.BaseType)
            {
                foreach (FieldInfo field in type.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic))
                {
                    if (!field.FieldType.IsPrimitive && !field.FieldType.IsPointer && field.GetValue(one) is object held && seen.Add(held))
                    {
                        open.Push(held);
                    }
                }
            }
        }

        return false;
    }

    private static byte[] Sealed(TransportKeys keys, ulong number)
    {
        byte[] made = new byte[19];
        keys.Seal(number, default, [1, 2, 3], made);
        return made;
    }

    private sealed class CountingCipher : IDatagramCipher
    {
        internal List<ulong> Sealed { get; } = [];

        public void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination) => Sealed.Add(number);

        public bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain) => false;

        public void Dispose()
        {
        }
    }
}
