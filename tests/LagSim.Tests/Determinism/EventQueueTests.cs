using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Determinism;

/// <summary>The queue against a model that looks through everything.</summary>
public sealed class EventQueueTests
{
    private const int Slots = 40;

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void Queue_AnySequenceOfOperations_AgreesWithTheModel(int seed)
    {
        Assert.Null(FirstDisagreement(seed, (queue, slot, key) => queue.Set(slot, key)));
    }

    [Fact]
    public void Check_QueueThatNeverMovesAnEventBack_IsSeenToFail()
    {
        Assert.NotNull(FirstDisagreement(1, (queue, slot, key) =>
        {
            if (!queue.TryGet(slot, out EventKey old) || key < old)
            {
                queue.Set(slot, key);
            }
        }));
    }

    [Fact]
    public void Least_NothingPending_Throws()
    {
        EventQueue queue = new();
        Assert.Throws<InvalidOperationException>(() => queue.MinSlot);
        Assert.Throws<InvalidOperationException>(() => queue.MinKey);
        queue.Remove(5);
        Assert.False(queue.TryGet(5, out _));
        Assert.Equal(0, queue.Count);
    }

    [Theory]
    [InlineData(1, 1_000, 1e12)]
    [InlineData(2, 3_000, 1e3)]
    [InlineData(3, 500, 1)]
    [InlineData(4, 2_000, 4e18)]
    public void Queue_ManyThatMoveAlongInTime_PopsInOrder(int seed, int slots, double span)
    {
        Random random = new(seed);
        EventQueue queue = new();
        SortedSet<(EventKey Key, int Slot)> model = [];
        long now = span > 1e18 ? long.MinValue : -5_000;
        for (int i = 0; i < 20 * slots; i++)
        {
            // Grows, moves along, is emptied; now and then somebody goes back to before what is at hand, as a heal does, and all at once.
            int phase = i / slots;
            bool isTaken = phase >= 17 || (phase > 2 && random.Next(3) > 0);
            int slot = isTaken && queue.Count > 0 ? queue.MinSlot : random.Next(slots);
            now = isTaken && queue.Count > 0 ? queue.MinKey.Time.Ticks : now;
            if (queue.TryGet(slot, out EventKey old))
            {
                Assert.True(model.Remove((old, slot)));
                if (phase >= 17 || random.Next(4) == 0)
                {
                    queue.Remove(slot);
                }
            }

            if (phase < 17 && (!isTaken || random.Next(8) > 0))
            {
                double ahead = phase == 9 ? -0.5 * random.NextDouble() : random.Next(20) == 0 ? 30 * random.NextDouble() : random.NextDouble() * random.NextDouble();
                double ticks = Math.Min(9e18, Math.Max(-9e18, now + (span * ahead)));
                EventKey key = new(SimTime.FromTicks((long)ticks), (uint)random.Next(2), EventKind.Impact, BodyId.OfScene(slot), BodyId.OfScene(slot), 0, 0);
                queue.Set(slot, key);
                model.Add((key, slot));
            }
            else
            {
                queue.Remove(slot);
            }

            Assert.Equal(model.Count, queue.Count);
            if (model.Count > 0)
            {
                Assert.Equal(model.Min, (queue.MinKey, queue.MinSlot));
            }
        }

        while (queue.TryGetLeast(out int least, out EventKey minKey))
        {
            Assert.Equal(model.Min, (minKey, least));
            model.Remove(model.Min);
            queue.Remove(least);
        }

        Assert.Empty(model);
    }

    [Fact]
    public void AreTheOnlyLeast_AnyQueue_AgreesWithALookAtAll()
    {
        Random random = new(1);
        int alone = 0, crowded = 0;
        for (int i = 0; i < 3_000; i++)
        {
            EventQueue queue = new();
            int count = 2 + random.Next(12);
            long[] ticks = new long[count];
            EventKey shared = new(SimTime.FromTicks(7), 0, EventKind.Impact, BodyId.OfScene(0), BodyId.OfScene(1), 0, 0);
            for (int slot = 0; slot < count; slot++)
            {
                ticks[slot] = slot < 2 ? 7 : 7 + random.Next(8);
                queue.Set(slot, slot < 2 ? shared : new EventKey(SimTime.FromTicks(ticks[slot]), 1, EventKind.Impact, BodyId.OfScene(slot), BodyId.OfScene(slot), 0, 0));
            }

            int least = queue.MinSlot;
            bool expected = ticks.Count(t => t == 7) == 2;
            Assert.Equal(expected, queue.AreTheOnlyLeast(1 - least, shared));
            alone += expected ? 1 : 0;
            crowded += expected ? 0 : 1;
            Assert.False(queue.AreTheOnlyLeast(count - 1 == 1 - least ? count : count - 1, shared), "who waits for something else, or for nothing");
        }

        Assert.True(alone > 300 && crowded > 300, $"{alone} alone, {crowded} not");
    }

    private static string? FirstDisagreement(int seed, Action<EventQueue, int, EventKey> set)
    {
        Random random = new(seed);
        EventQueue queue = new();
        SortedDictionary<int, EventKey> model = [];
        for (int i = 0; i < 20_000; i++)
        {
            int slot = random.Next(Slots);
            switch (random.Next(5))
            {
                case 0:
                    queue.Remove(slot);
                    model.Remove(slot);
                    break;
                case 1 when queue.Count > 0:
                    // As the event loop does: take the least.
                    slot = queue.MinSlot;
                    queue.Remove(slot);
                    model.Remove(slot);
                    break;
                default:
                    EventKey key = Key(random);
                    set(queue, slot, key);
                    model[slot] = key;
                    break;
            }

            if (queue.Count != model.Count)
            {
                return $"count {queue.Count}, not {model.Count}, after {i}";
            }

            if (model.Count > 0 && (queue.MinKey != model.Values.Min() || model[queue.MinSlot] != queue.MinKey))
            {
                return $"least {queue.MinKey}, not {model.Values.Min()}, after {i}";
            }

            bool has = queue.TryGet(slot, out EventKey pending);
            if (has != model.TryGetValue(slot, out EventKey expected) || (has && pending != expected))
            {
                return $"slot {slot} after {i}";
            }
        }

        return null;
    }

    private static EventKey Key(Random random) => new(
        SimTime.FromTicks(random.Next(6)), (uint)random.Next(2), random.Next(2) == 0 ? EventKind.Impact : EventKind.StepEnd,
        BodyId.OfScene(random.Next(3)), BodyId.OfScene(random.Next(3)), 0, 0);
}
