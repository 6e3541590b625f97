using System.Collections.Generic;
using BenchmarkDotNet.Attributes;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>
/// The hold model, the standard test of event queues (Jones 1986): take the least event, put one back at a random later time. Every fourth
/// time another slot's event is replaced, as an impact does; .NET's queue cannot replace, so there the old one stays and is skipped when it
/// comes up.
/// </summary>
[MemoryDiagnoser]
public class EventQueueBenchmark
{
    private const int Holds = 1000;

    private readonly SeededRandom random = new(1);
    private readonly Comparer<EventKey> comparer = Comparer<EventKey>.Create((a, b) => EventKey.Compare(a, b));
    private EventQueue ours = new();
    private PriorityQueue<int, EventKey> theirs = new();
    private EventKey[] current = [];

    [Params(100, 10_000, 1_000_000)]
    public int Entries { get; set; }

    [GlobalSetup]
    public void Fill()
    {
        ours = new EventQueue();
        theirs = new PriorityQueue<int, EventKey>(comparer);
        current = new EventKey[Entries];
        for (int slot = 0; slot < Entries; slot++)
        {
            EventKey key = KeyAfter(SimTime.Zero, slot);
            ours.Set(slot, key);
            theirs.Enqueue(slot, key);
            current[slot] = key;
        }
    }

    [Benchmark(Baseline = true, OperationsPerInvoke = Holds)]
    public int PriorityQueueLazy()
    {
        int sum = 0;
        for (int i = 0; i < Holds; i++)
        {
            int slot;
            EventKey key;
            do
            {
                theirs.TryDequeue(out slot, out key);
            }
            while (current[slot] != key);

            Put(slot, key.Time);
            if ((i & 3) == 0)
            {
                Put((int)(random.NextDouble() * Entries), key.Time);
            }

            sum += slot;
        }

        return sum;

        void Put(int slot, SimTime now)
        {
            current[slot] = KeyAfter(now, slot);
            theirs.Enqueue(slot, current[slot]);
        }
    }

    [Benchmark(OperationsPerInvoke = Holds)]
    public int EventQueue()
    {
        int sum = 0;
        for (int i = 0; i < Holds; i++)
        {
            int slot = ours.MinSlot;
            SimTime now = ours.MinKey.Time;
            ours.Set(slot, KeyAfter(now, slot));
            if ((i & 3) == 0)
            {
                int other = (int)(random.NextDouble() * Entries);
                ours.Set(other, KeyAfter(now, other));
            }

            sum += slot;
        }

        return sum;
    }

    private EventKey KeyAfter(SimTime now, int slot)
    {
        BodyId body = BodyId.OfScene(slot);
        return new EventKey(now + SimDuration.FromTicks((long)(random.NextDouble() * SimDuration.TicksPerSecond)), 0, EventKind.Impact, body, body, 0, 0);
    }
}
