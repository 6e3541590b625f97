using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>No key ever sees a nonce twice, and what is old or came before is not taken.</summary>
public sealed class LinkSealTests
{
    /// <summary>
    /// A nonce repeats only if a number does, and numbers count up to 2^40 within a link, whose keys no other link has: no session lasts long
    /// enough to need them all.
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
        const double perSecond = 100_000, secondsOfADay = 86_400;
        Assert.InRange(SealedDatagram.MaxNumber / perSecond / secondsOfADay, 127, 128);
        Assert.InRange(SessionParts.MaxClock.ToSeconds() / secondsOfADay, 23, 24);
    }

    /// <summary>Each handshake has keys of its own, though host, client, connect key and prologue are the same.</summary>
    [Fact]
    public void Keys_OfManyHandshakes_AreAllDifferent()
    {
        using HostIdentity identity = HostIdentity.Draw();
        SecureHost host = new(identity);
        byte[] plain = new byte[32], sealedOnes = new byte[48], payload = new byte[5], message = new byte[53], shown = new byte[32];
        host.WriteIdentity(new byte[16], shown);
        HashSet<string> all = [];
        for (int n = 0; n < 50; n++)
        {
            using IClientHandshake mine = new SecureClient(identity.Fingerprint).Begin(shown, [1])!;
            mine.Write(payload, message);
            using IHostHandshake its = host.TryRead(0, [1], message, payload)!;
            byte[] answer = new byte[payload.Length + IHostProtection.WelcomeOverhead];
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

    private sealed class CountingCipher : IDatagramCipher
    {
        internal List<ulong> Sealed { get; } = [];

        public void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination) => Sealed.Add(number);

        public bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain) => false;

        public IKeyExchange BeginExchange(ReadOnlySpan<byte> prologue, Span<byte> message) => throw new InvalidOperationException();

        public IDatagramCipher? TryAnswerExchange(ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> answer) => null;

        public void Dispose()
        {
        }
    }
}
