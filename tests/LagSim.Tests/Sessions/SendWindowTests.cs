using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Which entries go out when, and again when, by the numbers that each datagram carries.</summary>
public sealed class SendWindowTests
{
    private const uint Many = 10_000;

    private static readonly SimDuration Answer = SimDuration.FromMilliseconds(50);
    private static readonly SimDuration Interval = SimDuration.FromMilliseconds(20);

    private readonly UpdateDatagram update = new();

    [Fact]
    public void WhatFitsIntoOneDatagram_TravelsInEveryOneUntilItIsAcknowledged()
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = 3 };
        Assert.Equal((1u, 3u), Next(window, entries, 0));
        Assert.Equal((1u, 3u), Next(window, entries, 1));
        window.Acknowledge(2);
        window.Acknowledge(1); // overtaken: says nothing
        Assert.Equal((3u, 3u), Next(window, entries, 2));
        entries.Last = 4;
        Assert.Equal((3u, 4u), Next(window, entries, 3));
        window.Acknowledge(4);
        Assert.Equal((5u, 4u), Next(window, entries, 4)); // none
    }

    [Fact]
    public void OfMoreThanThat_EachDatagramCarriesWhatHasNotBeenSent_UpToTheWindow()
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = Many };
        List<(uint First, uint Last)> sent = Burst(window, entries, 0);
        AreInOneRow(sent, 1, SendWindow.MaxEntries);
        Assert.True(sent.Count > SendWindow.MaxEntries / UpdateDatagram.MaxEntries, $"{sent.Count}");

        // It grows by what is acknowledged, and by no more.
        uint acknowledged = sent[2].Last;
        window.Acknowledge(acknowledged);
        AreInOneRow(Burst(window, entries, 1), SendWindow.MaxEntries + 1, acknowledged + SendWindow.MaxEntries);
    }

    [Fact]
    public void WhatIsNotAcknowledgedInTime_IsSentAgainFromTheOldestOn_AndNotBefore()
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = 1000 };
        uint end = Burst(window, entries, 0)[0].Last;
        Assert.Equal(1u, Next(window, entries, 20).First); // an interval is over: filled up from the oldest
        Assert.False(window.HasLost);
        window.Acknowledge(end);
        Assert.Equal(end + 1, Next(window, entries, 49).First); // again an interval
        Assert.Equal((1001u, 1000u), Next(window, entries, 49.5)); // nothing: no interval is over, and answers may come
        Assert.False(window.HasLost);
        Assert.Equal(end + 1, Next(window, entries, 50).First); // no answer: at once
        Assert.True(window.HasLost);
        window.Acknowledge(1000);
        Assert.False(window.HasLost);
    }

    [Fact]
    public void WhoAnswersNothing_IsSentLessAndLess()
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = Many };
        int[] datagrams = [.. Enumerable.Range(0, 8).Select(part => Enumerable.Range(0, 250).Sum(tick => Tick(window, entries, (part * 250) + tick)))];
        Assert.True(datagrams[^1] * 4 < datagrams[0], string.Join(", ", datagrams));
        Assert.True(datagrams[^1] > 0, "it asks on, at the interval");
    }

    [Fact]
    public void Knots_TravelTwiceAndThenWait()
    {
        SendWindow window = new(0);
        Entries entries = new() { Last = 1, AreKnots = true };
        Assert.Equal((1u, 1u), Next(window, entries, 0));
        entries.Last = 2;
        Assert.Equal((1u, 2u), Next(window, entries, 5));
        entries.Last = 3;
        Assert.Equal((2u, 3u), Next(window, entries, 10)); // the first has travelled twice
        Assert.Equal((1u, 3u), Next(window, entries, 200)); // lost: all, from the oldest on
        Assert.True(window.HasLost);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void NumbersUpToTheGreatest_AreSentAsAnyOthers(bool areKnots)
    {
        SendWindow window = new(uint.MaxValue - 2);
        Entries entries = new() { Last = uint.MaxValue, AreKnots = areKnots };
        Assert.Equal((uint.MaxValue - 1, uint.MaxValue), Next(window, entries, 0));
        window.Acknowledge(uint.MaxValue - 1);
        Assert.Equal((uint.MaxValue, uint.MaxValue), Next(window, entries, 1));
    }

    private static void AreInOneRow(List<(uint First, uint Last)> sent, uint first, uint last)
    {
        Assert.Equal(first, sent[0].First);
        Assert.All(sent.Zip(sent.Skip(1)), pair => Assert.Equal(pair.First.Last + 1, pair.Second.First));
        Assert.Equal(last, sent[^1].Last);
    }

    /// <summary>The numbers of the next datagram; the second is the lesser where it carries none.</summary>
    private (uint First, uint Last) Next(SendWindow window, Entries entries, double milliseconds)
    {
        Fill(window, entries, milliseconds);
        return Carried();
    }

    /// <summary>All datagrams that are to go out at one time.</summary>
    private List<(uint First, uint Last)> Burst(SendWindow window, Entries entries, double milliseconds)
    {
        List<(uint First, uint Last)> sent = [];
        bool hasMore;
        do
        {
            hasMore = Fill(window, entries, milliseconds);
            sent.Add(Carried());
        }
        while (hasMore);
        return sent;
    }

    /// <summary>How many datagrams with entries a session sends in a millisecond.</summary>
    private int Tick(SendWindow window, Entries entries, double milliseconds)
    {
        int sent = 0;
        bool hasMore = true;
        for (int n = 0; hasMore && n < SendWindow.MaxDatagramsAtOnce; n++)
        {
            hasMore = Fill(window, entries, milliseconds);
            sent += update.Held.Length > 0 ? 1 : 0;
        }

        return sent;
    }

    private bool Fill(SendWindow window, Entries entries, double milliseconds)
    {
        update.Clear();
        return window.Fill(update, entries, SimTime.FromSeconds(milliseconds / 1000), new ResendTimes(Answer, SimDuration.Zero, Interval));
    }

    private (uint First, uint Last) Carried() => (update.FirstIndex, update.FirstIndex + (uint)update.Held.Length - 1);

    private sealed class Entries : IEntrySource
    {
        internal bool AreKnots { get; init; }

        public uint Last { get; set; }

        public UpdateEntry this[uint number] => AreKnots
            ? new UpdateEntry(Verdict.Accepted, ExternalEvent.HoldKnot(SimTime.Zero, 1, number, BodyId.OfScene(0), Vector3D.Zero, Vector3D.Zero))
            : new UpdateEntry(Verdict.Accepted, number);
    }
}
