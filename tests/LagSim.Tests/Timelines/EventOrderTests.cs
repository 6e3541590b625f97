using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;

namespace LagSim.Tests.Timelines;

/// <summary>The order of events that come in any order: what is found in it, and that finding takes a time of log n.</summary>
public sealed class EventOrderTests
{
    private const int Events = 4096;

    public enum Arrival
    {
        InOrder,
        Reversed,
        Shuffled,
        FromBothEnds,
        Halving,
    }

    [Theory]
    [InlineData(Arrival.InOrder)]
    [InlineData(Arrival.Reversed)]
    [InlineData(Arrival.Shuffled)]
    [InlineData(Arrival.FromBothEnds)]
    [InlineData(Arrival.Halving)]
    public void Tree_OfEventsInAnyOrder_IsNotDeepAndFindsEach(Arrival arrival)
    {
        EventOrder order = new();
        int root = EventOrder.None;
        List<int> left = new();
        foreach (int n in Ordered(arrival))
        {
            order.Add(ref root, n, Key(n));
            left.Add(n);
        }

        IsNotDeep(order, root, left.Count);
        foreach (int n in Ordered(arrival).Where(n => n % 3 != 0))
        {
            order.Remove(ref root, n);
        }

        left = left.Where(n => n % 3 == 0).OrderBy(n => n).ToList();
        IsNotDeep(order, root, left.Count);
        for (int n = 0; n < Events; n++)
        {
            Assert.Equal(left.Where(m => m < n).DefaultIfEmpty(EventOrder.None).Last(), order.LastBefore(root, Key(n)));
            Assert.Equal(left.Where(m => m > n).DefaultIfEmpty(EventOrder.None).First(), order.FirstAfter(root, Key(n)));
        }

        foreach (int n in left)
        {
            order.Remove(ref root, n);
        }

        Assert.Equal(EventOrder.None, root);
    }

    /// <summary>The control: a tree that is not balanced is a list where events come in order.</summary>
    [Fact]
    public void Tree_ThatIsNotBalanced_IsSeenToBeDeep()
    {
        EventOrder order = new FaultyEventOrder();
        int root = EventOrder.None;
        foreach (int n in Ordered(Arrival.InOrder))
        {
            order.Add(ref root, n, Key(n));
        }

        Assert.Equal(Events, order.DepthOf(root));
    }

    /// <summary>No search goes down by more than two of a level, and each level has at least twice the events of the one above.</summary>
    private static void IsNotDeep(EventOrder order, int root, int count) =>
        Assert.InRange(order.DepthOf(root), 1, 2 * Math.Log(count + 1, 2));

    private static EventKey Key(int n) => new(SimTime.FromTicks(n / 2), 0, EventKind.Impulse, BodyId.OfScene(0), BodyId.OfScene(0), 1, (uint)n);

    private static IEnumerable<int> Ordered(Arrival arrival)
    {
        int[] all = Enumerable.Range(0, Events).ToArray();
        if (arrival == Arrival.Shuffled)
        {
            new Random(1).Shuffle(all);
        }

        return arrival switch
        {
            Arrival.Reversed => all.Reverse(),
            Arrival.FromBothEnds => all.Select(n => n % 2 == 0 ? n / 2 : Events - 1 - (n / 2)),
            Arrival.Halving => all.OrderBy(n => n % 64).ThenByDescending(n => n),
            _ => all,
        };
    }
}
