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
        Assert.Throws<InvalidOperationException>(() => queue.LeastSlot);
        Assert.Throws<InvalidOperationException>(() => queue.LeastKey);
        queue.Remove(5);
        Assert.False(queue.TryGet(5, out _));
        Assert.Equal(0, queue.Count);
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
                    slot = queue.LeastSlot;
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

            if (model.Count > 0 && (queue.LeastKey != model.Values.Min() || model[queue.LeastSlot] != queue.LeastKey))
            {
                return $"least {queue.LeastKey}, not {model.Values.Min()}, after {i}";
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
