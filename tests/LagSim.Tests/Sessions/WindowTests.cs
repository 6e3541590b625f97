using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>How entries are chosen for updates, and put in order again, whatever becomes of the updates.</summary>
public sealed class WindowTests
{
    private static readonly SimDuration Resend = SimDuration.FromMilliseconds(30), Patience = SimDuration.FromMilliseconds(100);

    private readonly UpdateDatagram update = new();
    private readonly Entries source = new();
    private readonly SendWindow window = new(0);
    private SimTime now = At(1);

    [Fact]
    public void Fill_WhatFitsIntoOneDatagram_IsInEveryDatagramUntilAcknowledged()
    {
        source.Last = 20;
        Assert.Equal((1u, 20, false), Fill());
        Assert.Equal((1u, 20, false), Fill());
        window.Acknowledge(7);
        window.Acknowledge(3); // overtaken: says nothing
        source.Last = 22;
        Assert.Equal((8u, 15, false), Fill());
        window.Acknowledge(22);
        Assert.Equal((23u, 0, false), Fill());
    }

    [Fact]
    public void Fill_MoreThanFits_GoesOnWhereItWasAndRepeatsWhatIsOverdueOldestFirst()
    {
        source.Last = 60;
        Assert.Equal((1u, 23, true), Fill());
        Assert.Equal((24u, 23, true), Fill());
        Assert.Equal((47u, 14, false), Fill());
        Assert.Equal((61u, 0, false), Fill()); // nothing is due
        now += Resend;
        source.Last = 61;
        Assert.Equal((39u, 23, false), Fill()); // the new one, and what has room beside it
        now += Patience - Resend - SimDuration.OneTick;
        Assert.Equal((1u, 23, false), Fill()); // a resend interval has passed
        Assert.Equal((62u, 0, false), Fill());
        now += SimDuration.OneTick;
        Assert.Equal((1u, 23, true), Fill());
        Assert.Equal((24u, 23, true), Fill());
        Assert.Equal((47u, 14, false), Fill());
        window.Acknowledge(46);
        Assert.Equal((47u, 15, false), Fill());
    }

    [Fact]
    public void Fill_NothingIsEverAcknowledged_GrowsRareAndStopsAtTheWindow()
    {
        source.Last = 100_000;
        Dictionary<uint, int> times = [];
        for (int i = 0; i < 20_000; i++)
        {
            _ = Fill();
            for (uint n = update.FirstIndex; n < update.FirstIndex + update.Entries.Length; n++)
            {
                times[n] = times.GetValueOrDefault(n) + 1;
            }

            now += SimDuration.FromMilliseconds(1);
        }

        Assert.Equal(SendWindow.MaxEntries, times.Count);
        Assert.InRange(times[SendWindow.MaxEntries], 3, 10); // of twenty seconds: 0.1, 0.1, 0.2, 0.4 ... s apart
        Assert.InRange(times[1], 500, 700); // 20 s / 30 ms
    }

    [Theory]
    [InlineData(0)]
    [InlineData(10)]
    [InlineData(50)]
    public void Windows_DatagramsLostDoubledAndOvertaken_GiveEveryEntryOnceAndInOrder(int lossPercent)
    {
        for (int seed = 1; seed <= 5; seed++)
        {
            Random random = new(seed);
            Entries entries = new();
            SendWindow sender = new(0);
            ReceiveWindow receiver = new(0);
            List<(int At, uint First, UpdateEntry[] Held, uint Acknowledged)> way = [];
            List<uint> taken = [];
            for (int step = 0; taken.Count < 20_000; step++)
            {
                Assert.True(step < 100_000, $"seed {seed}: {taken.Count} after {step} ms");
                entries.Last = Math.Min(20_000, entries.Last + (uint)random.Next(8));
                SimTime time = At(1) + SimDuration.FromMilliseconds(step);
                bool more = true;
                for (int n = 0; more && n < SendWindow.MaxDatagramsAtOnce; n++)
                {
                    more = sender.Fill(update, entries, time, Patience, Resend);
                    for (int copies = random.Next(100) < lossPercent ? 0 : 1 + random.Next(2); copies > 0; copies--)
                    {
                        way.Add((step + 20 + random.Next(40), update.FirstIndex, update.Entries.ToArray(), receiver.Received));
                    }
                }

                foreach ((_, uint first, UpdateEntry[] held, uint acknowledged) in way.Where(d => d.At == step))
                {
                    for (int i = 0; i < held.Length; i++)
                    {
                        Assert.True(receiver.Put(first + (uint)i, held[i]));
                    }

                    while (receiver.HasNext)
                    {
                        taken.Add(receiver.Take().Sequence);
                    }

                    sender.Acknowledge(acknowledged);
                }

                way.RemoveAll(d => d.At <= step);
            }

            Assert.Equal(Enumerable.Range(1, 20_000).Select(n => (uint)n), taken);
            Assert.InRange(receiver.Room, 256, SendWindow.MaxEntries);
        }
    }

    [Fact]
    public void Put_OutOfOrderAgainOrTooFar_IsKeptOnceAndInBounds()
    {
        ReceiveWindow receiver = new(10);
        Assert.False(receiver.Put(10 + SendWindow.MaxEntries + 1, Entry(1)));
        Assert.False(receiver.Put(uint.MaxValue, Entry(1)));
        Assert.Equal(0, receiver.Room); // whoever sends such does not have room made
        Assert.True(receiver.Put(12, Entry(12)));
        Assert.True(receiver.Put(12, Entry(99)));
        Assert.True(receiver.Put(5, Entry(5)));
        Assert.False(receiver.HasNext);
        Assert.Throws<InvalidOperationException>(() => receiver.Take());
        Assert.True(receiver.Put(11, Entry(11)));
        Assert.True(receiver.Put(10 + SendWindow.MaxEntries, Entry(7)));
        Assert.Equal(SendWindow.MaxEntries, receiver.Room);
        Assert.Equal([11u, 12u], [receiver.Take().Sequence, receiver.Take().Sequence]);
        Assert.False(receiver.HasNext);
    }

    [Fact]
    public void Put_LastNumbersThereAre_AreTakenAndThenNoMore()
    {
        ReceiveWindow receiver = new(uint.MaxValue - 2);
        Assert.True(receiver.Put(uint.MaxValue, Entry(2)));
        Assert.True(receiver.Put(uint.MaxValue - 1, Entry(1)));
        Assert.True(receiver.Put(0, Entry(3)));
        Assert.Equal([1u, 2u], [receiver.Take().Sequence, receiver.Take().Sequence]);
        Assert.False(receiver.HasNext);
    }

    [Fact]
    public void Promise_BeyondAGap_CountsOnceTheGapIsClosed()
    {
        ReceiveWindow receiver = new(0);
        receiver.Promise(0, At(1));
        Assert.Equal(At(1), receiver.Promised);
        receiver.Put(1, Entry(1));
        receiver.Put(3, Entry(3));
        receiver.Promise(3, At(3));
        receiver.Promise(1, At(2));
        Assert.Equal(At(1), receiver.Promised);
        receiver.Take();
        Assert.Equal(At(2), receiver.Promised);
        receiver.Put(2, Entry(2));
        receiver.Take();
        Assert.Equal(At(2), receiver.Promised);
        receiver.Take();
        Assert.Equal(At(3), receiver.Promised);
        receiver.Promise(2, At(2.5)); // an older one
        Assert.Equal(At(3), receiver.Promised);
    }

    [Fact]
    public void Add_EachNumberOnce_WhateverTheirOrder()
    {
        for (int seed = 1; seed <= 50; seed++)
        {
            Random random = new(seed);
            SeenNumbers seen = new();
            HashSet<uint> known = [];
            uint newest = 0;
            for (int i = 0; i < 5000; i++)
            {
                uint number = (uint)Math.Max(0, newest + random.Next(-1500, random.Next(20) == 0 ? 2500 : 20));
                bool isNew = number > 0 && (number > newest || (newest - number < SeenNumbers.Span && !known.Contains(number)));
                Assert.Equal(isNew, seen.Add(number));
                known.Add(number);
                newest = Math.Max(newest, number);
                Assert.Equal(newest, seen.Newest);
            }
        }
    }

    private static UpdateEntry Entry(uint number) => new(Verdict.Pending, ExternalEvent.Impulse(At(2), 1, Math.Max(1, number), First, V(0, 1)));

    private (uint First, int Count, bool HasMore) Fill()
    {
        update.Clear();
        bool hasMore = window.Fill(update, source, now, Patience, Resend);
        Assert.InRange(update.EncodedLength, WireFormat.EmptyUpdateBytes, WireFormat.MaxBytes - WireFormat.StateHashBytes);
        return (update.FirstIndex, update.Entries.Length, hasMore);
    }

    private sealed class Entries : IEntrySource
    {
        public uint Last { get; set; }

        public UpdateEntry this[uint number] => number >= 1 && number <= Last ? Entry(number) : throw new ArgumentOutOfRangeException(nameof(number));
    }
}
