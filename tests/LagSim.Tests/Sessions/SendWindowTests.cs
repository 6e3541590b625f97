using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Which entries go out when, and again when, by the numbers that each datagram carries.</summary>
public sealed class SendWindowTests
{
    private const uint Many = 10_000;
    private const int Wide = 2000; // more than fits
    private const int Own = 100;

    private readonly UpdateDatagram update = new();

    [Fact]
    public void WithRoom_WhatFitsIntoOneDatagram_TravelsInEveryOneUntilItIsAcknowledged()
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = 3 };
        Assert.Equal((1u, 3u), Next(window, entries));
        Assert.Equal((1u, 3u), Next(window, entries));
        window.Acknowledge(2);
        window.Acknowledge(1); // overtaken: says nothing
        Assert.Equal((3u, 3u), Next(window, entries));
        entries.Last = 4;
        Assert.Equal((3u, 4u), Next(window, entries));
        window.Acknowledge(4);
        Assert.Equal((5u, 4u), Next(window, entries)); // none
    }

    /// <summary>An entry goes in as many updates in a row as the losses of the link ask for, and then no more, unless all of them are lost.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(5)]
    public void Copies_EachEntryTravelsInThatManyUpdatesInARow(int copies)
    {
        SendWindow window = new(0);
        Entries entries = new();
        Dictionary<uint, int> times = [];
        for (uint n = 1; n <= 200; n++)
        {
            entries.Last = n * 3;
            (uint first, uint last) = Next(window, entries, copies: copies);
            for (uint number = first; number <= last; number++)
            {
                times[number] = times.GetValueOrDefault(number) + 1;
            }
        }

        Assert.All(times, entry => Assert.Equal(System.Math.Min(copies, 200 - (int)((entry.Key - 1) / 3)), entry.Value));
        for (int left = copies - 1; left > 0; left--)
        {
            Assert.True(window.HasCopiesLeft(copies));
            Assert.Equal((601u - (3 * (uint)left), 600u), Next(window, entries, copies: copies));
        }

        Assert.False(window.HasCopiesLeft(copies));
        Assert.Equal((601u, 600u), Next(window, entries, copies: copies)); // none
        window.Acknowledge(590);
        window.Lose(598, 600);
        Assert.Equal((591u, 600u), Next(window, entries, copies: copies)); // lost: all, and again and again
        Assert.Equal((591u, 600u), Next(window, entries, copies: copies));
    }

    [Fact]
    public void WithoutRoom_EachEntryTravelsOnce_AndAgainWhenItIsLost()
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = 3 };
        Assert.Equal((1u, 3u), Next(window, entries, 0));
        Assert.Equal((4u, 3u), Next(window, entries, 0));
        entries.Last = 5;
        Assert.Equal((4u, 5u), Next(window, entries, 0));
        window.Lose(2, 3);
        Assert.True(window.HasNeeded(entries));
        Assert.Equal((2u, 3u), Next(window, entries, 0));
        Assert.False(window.HasNeeded(entries));
        Assert.Equal((6u, 5u), Next(window, entries, 0));
    }

    [Fact]
    public void WithSomeRoom_NoMoreIsRepeatedThanThat()
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = 10 }; // of 5 bytes each
        Assert.Equal((1u, 10u), Next(window, entries, 0));
        entries.Last = 11;
        update.Clear();
        Assert.Equal(15, window.Fill(update, entries, 16, Own, Wide, LossRuns.MaxCopies));
        Assert.Equal((8u, 11u), Carried());
        update.Clear();
        Assert.Equal(Own + 20, window.Fill(update, entries, Own + 24, Own, Wide, LossRuns.MaxCopies)); // nothing new: the oldest
        Assert.Equal((1u, 4u), Carried());
    }

    [Fact]
    public void OfMoreThanADatagram_EachCarriesWhatHasNotBeenSent_UpToTheWindow()
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = Many };
        List<(uint First, uint Last)> sent = Burst(window, entries);
        AreInOneRow(sent, 1, SendWindow.MaxEntries);
        Assert.True(sent.Count > SendWindow.MaxEntries / UpdateDatagram.MaxEntries, $"{sent.Count}");

        // It grows by what is acknowledged, and by no more.
        uint acknowledged = sent[2].Last;
        window.Acknowledge(acknowledged);
        AreInOneRow(Burst(window, entries), SendWindow.MaxEntries + 1, acknowledged + SendWindow.MaxEntries);
    }

    [Fact]
    public void Lost_FromTheOldestOn_AndOnlyOnce()
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = 1000 };
        List<(uint First, uint Last)> sent = Burst(window, entries);
        window.Lose(sent[2].First, sent[2].Last);
        window.Lose(sent[0].First, sent[0].Last);
        window.Lose(sent[0].First, sent[0].Last);
        window.Acknowledge(10);
        Assert.Equal((11u, sent[0].Last), Next(window, entries, 0));
        Assert.Equal(sent[2], Next(window, entries, 0));
        Assert.False(window.HasNeeded(entries));
        window.Lose(1, uint.MaxValue); // all there was
        AreInOneRow(Burst(window, entries), 11, 1000);
    }

    [Fact]
    public void AnyOrder_OfLossesAndAcknowledgements_SendsAllThatIsNeededAndNothingElse()
    {
        for (int seed = 0; seed < 300; seed++)
        {
            System.Random random = new(seed);
            uint before = (uint)random.Next(100);
            SendWindow window = new(before);
            Entries entries = new() { Last = before };
            HashSet<uint> needed = [];
            for (int step = 0; step < 400; step++)
            {
                switch (random.Next(4))
                {
                    case 0:
                        for (int n = random.Next(400); n > 0; n--)
                        {
                            needed.Add(++entries.Last);
                        }

                        break;
                    case 1 when window.Sent > window.Acknowledged:
                        uint upTo = window.Acknowledged + 1 + (uint)random.Next((int)(window.Sent - window.Acknowledged));
                        window.Acknowledge(upTo);
                        needed.RemoveWhere(n => n <= upTo);
                        break;
                    case 2 when window.Sent > window.Acknowledged:
                        uint first = window.Acknowledged + 1 + (uint)random.Next((int)(window.Sent - window.Acknowledged));
                        uint last = first + (uint)random.Next((int)(window.Sent - first + 1));
                        window.Lose(first, last);
                        for (uint n = first; n <= last; n++)
                        {
                            needed.Add(n);
                        }

                        break;
                    default:
                        Assert.Equal(needed.Any(n => n <= window.Acknowledged + SendWindow.MaxEntries), window.HasNeeded(entries));
                        (uint from, uint to) = Next(window, entries, 0);
                        for (uint n = from; n <= to && to >= from; n++)
                        {
                            Assert.True(needed.Remove(n), $"seed {seed}, step {step}: {n} was not needed");
                        }

                        break;
                }
            }

            Burst(window, entries, 0).ForEach(carried => needed.RemoveWhere(n => n >= carried.First && n <= carried.Last));
            Assert.DoesNotContain(needed, n => n <= window.Acknowledged + SendWindow.MaxEntries);
        }
    }

    [Fact]
    public void Keyframes_TravelTwiceAndThenWait()
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = 1, AreKeyframes = true };
        Assert.Equal((1u, 1u), Next(window, entries));
        entries.Last = 2;
        Assert.Equal((1u, 2u), Next(window, entries));
        entries.Last = 3;
        Assert.Equal((2u, 3u), Next(window, entries)); // the first has travelled twice
        window.Lose(1, 3);
        Assert.Equal((1u, 3u), Next(window, entries)); // lost: all, from the oldest on
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void NumbersUpToTheGreatest_AreSentAsAnyOthers(bool areKeyframes)
    {
        SendWindow window = new(uint.MaxValue - 2);
        Entries entries = new() { Last = uint.MaxValue, AreKeyframes = areKeyframes };
        Assert.Equal((uint.MaxValue - 1, uint.MaxValue), Next(window, entries));
        window.Acknowledge(uint.MaxValue - 1);
        if (!areKeyframes)
        {
            Assert.Equal((uint.MaxValue, uint.MaxValue), Next(window, entries));
        }

        window.Lose(uint.MaxValue, uint.MaxValue);
        Assert.Equal((uint.MaxValue, uint.MaxValue), Next(window, entries, 0));
    }

    /// <summary>A link that carries little gets short updates, and every entry goes all the same.</summary>
    [Theory]
    [InlineData(-50, 1)] // one always goes
    [InlineData(12, 2)] // entries of 5 bytes each
    [InlineData(25, 5)]
    [InlineData(Wide, 10)]
    public void WithLittleRoomInAnUpdate_EachCarriesWhatFits_AndAllGo(int room, int each)
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = 10 };
        uint sent = 0;
        while (window.HasNeeded(entries))
        {
            (uint first, uint last) = Next(window, entries, 0, room);
            Assert.Equal((sent + 1, (uint)System.Math.Min(10, sent + each)), (first, last));
            sent = last;
        }

        Assert.Equal(10u, sent);
    }

    private static void AreInOneRow(List<(uint First, uint Last)> sent, uint first, uint last)
    {
        Assert.Equal(first, sent[0].First);
        Assert.All(sent.Zip(sent.Skip(1)), pair => Assert.Equal(pair.First.Last + 1, pair.Second.First));
        Assert.Equal(last, sent[^1].Last);
    }

    /// <summary>The numbers of the next datagram; the second is the lesser where it carries none.</summary>
    private (uint First, uint Last) Next(SendWindow window, Entries entries, int repetition = 10_000, int room = Wide, int copies = LossRuns.MaxCopies)
    {
        update.Clear();
        window.Fill(update, entries, repetition, Own, room, copies);
        return Carried();
    }

    /// <summary>All datagrams that have to go.</summary>
    private List<(uint First, uint Last)> Burst(SendWindow window, Entries entries, int repetition = 0)
    {
        List<(uint First, uint Last)> sent = [];
        while (window.HasNeeded(entries))
        {
            sent.Add(Next(window, entries, repetition));
        }

        return sent;
    }

    private (uint First, uint Last) Carried() => (update.FirstIndex, update.FirstIndex + (uint)update.Held.Length - 1);

    private sealed class Entries : IEntrySource
    {
        internal bool AreKeyframes { get; init; }

        public uint Last { get; set; }

        public UpdateEntry this[uint number] => AreKeyframes
            ? new UpdateEntry(Verdict.Accepted, ExternalEvent.HoldKeyframe(SimTime.Zero, 1, number, BodyId.OfScene(0), Vector3D.Zero, Vector3D.Zero))
            : new UpdateEntry(Verdict.Accepted, number);
    }
}
