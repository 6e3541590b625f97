using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>The flat, linked timelines against plain lists.</summary>
public sealed class TimelineStoreTests
{
    private const int Slots = 5;

    private delegate EventKey Cut(in EventKey key);

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void Store_AnySequenceOfOperations_AgreesWithTheModel(int seed)
    {
        Assert.Null(FirstDisagreement(seed, (in EventKey key) => key));
    }

    [Fact]
    public void Check_CutByTimeInsteadOfByKey_IsSeenToFail()
    {
        Assert.NotNull(FirstDisagreement(1, (in EventKey key) => EventKey.Before(key.Time)));
    }

    /// <summary>In a gas that goes on evenly room for a history is guessed early, and not far off: else everything is copied some hundred times. The control foretells nothing.</summary>
    [Fact]
    public void Room_OfAnEvenGas_GrowsInFewSteps()
    {
        (int steps, double room) = Growth(growsByLittle: false);
        Assert.InRange(steps, 1, 60);
        Assert.InRange(room, 1, 1.1);
        Assert.True(Growth(growsByLittle: true).Steps > 80);
    }

    /// <summary>
    /// Where more and more is opened after a whole history has gone by, as by balls that fall on a heap, room grows by as much as the last part of what is kept
    /// tells: else everything is copied some hundred times. The control foretells nothing.
    /// </summary>
    [Fact]
    public void Room_OfBallsThatBecomeAHeap_IsCopiedFewTimes()
    {
        (double copied, double room) = Copied(growsByLittle: false);
        Assert.InRange(copied, 1, 16);
        Assert.InRange(room, 1, 1.3);
        Assert.InRange(Copied(growsByLittle: true).Times, 31, double.PositiveInfinity);

        static (double Times, double RoomForEach) Copied(bool growsByLittle)
        {
            SimulationOptions options = new(default, SimDuration.FromSeconds(0.25));
            Simulation world = new(Heap(), options.WithParts(new FaultyEngineParts { GrowsByLittle = growsByLittle }));
            long copied = 0;
            int most = 0;
            for (int n = 1; n <= 1000; n++)
            {
                int before = world.Engine.Timelines.Room;
                world.AdvanceTo(SimTime.FromSeconds(n * 2e-3));
                copied += world.Engine.Timelines.Room > before ? before : 0;
                most = Math.Max(most, world.Engine.Timelines.Alive);
            }

            return (copied / (double)world.Engine.Timelines.Room, world.Engine.Timelines.Room / (double)most);
        }

        static Scene Heap()
        {
            SceneBuilder builder = new SceneBuilder("heap").WithContactTolerance(1e-6).AddPlane("floor", V(0, 1), 0.0)
                .AddPlane("west", V(1), -1.1).AddPlane("east", V(-1), -1.1).AddPlane("north", V(0, 0, 1), -1.1).AddPlane("south", V(0, 0, -1), -1.1);
            for (int i = 0; i < 12; i++)
            {
                Vector3D place = V(((i % 2) - 0.5) * 1.05, 2.6 + (i / 4 * 1.1), ((i / 2 % 2) - 0.5) * 1.05);
                builder.AddBody($"ball {i}", new BodySpec(0.5, 1, 0.3, friction: 0.4), place + V(0.001 * i), spin: V(0, i));
            }

            return builder.Build();
        }
    }

    private static (int Steps, double RoomForEach) Growth(bool growsByLittle)
    {
        SimulationOptions options = new(default, SimDuration.FromSeconds(1));
        Simulation world = new(BuiltInScenes.Gas(1000, 0.2), options.WithParts(new FaultyEngineParts { GrowsByLittle = growsByLittle }));
        int steps = 0;
        for (int ms = 1; ms < 1000; ms++)
        {
            int before = world.Engine.Timelines.Room;
            world.AdvanceTo(SimTime.FromSeconds(ms * 1e-3));
            steps += world.Engine.Timelines.Room > before ? 1 : 0;
        }

        return (steps, world.Engine.Timelines.Room / (double)world.Engine.Timelines.Alive);
    }

    [Fact]
    public void EventHash_AppendedAndCutAgain_IsWhatItWas()
    {
        TimelineStore store = new(default);
        store.AddSlot(0);
        Append(store, 0, Key(1, 0), 1);
        ulong before = store.EventHash;
        Append(store, 0, Key(2, 0), 2);
        Append(store, 0, Key(2, 1), 3);
        Assert.NotEqual(before, store.EventHash);
        Assert.Equal(2, store.CutFrom(0, BodyId.OfScene(0), Key(2, 0)));
        Assert.Equal(before, store.EventHash);
    }

    [Fact]
    public void EventHash_AppendedInAnotherOrderOfBodies_IsTheSame()
    {
        TimelineStore a = new(default), b = new(default);
        foreach (TimelineStore store in new[] { a, b })
        {
            store.AddSlot(0);
            store.AddSlot(1);
        }

        Append(a, 0, Key(1, 0), 1);
        Append(a, 1, Key(1, 0), 2);
        Append(b, 1, Key(1, 0), 2);
        Append(b, 0, Key(1, 0), 1);
        Assert.Equal(a.EventHash, b.EventHash);
    }

    [Theory]
    [InlineData("time")]
    [InlineData("round")]
    [InlineData("place")]
    [InlineData("body")]
    public void EventHash_OneThingDiffers_Differs(string what)
    {
        TimelineStore a = new(default), b = new(default);
        a.AddSlot(0);
        b.AddSlot(0);
        Append(a, 0, Key(5, 0), 1);
        EventKey key = what switch { "time" => Key(6, 0), "round" => Key(5, 1), _ => Key(5, 0) };
        MotionSegment segment = Segment(key, what == "place" ? Math.BitIncrement(1.0) : 1);
        b.Append(0, BodyId.OfScene(what == "body" ? 1 : 0), key, segment, default);
        Assert.NotEqual(a.EventHash, b.EventHash);
    }

    [Fact]
    public void Append_ManyBodiesInAWindow_TakesLittleMoreThanTheWindowNeedsAndLosesNothingInIt()
    {
        const int bodies = 2_000, window = 8_000, appends = 60_000;
        TimelineStore store = new(default);
        Random random = new(1);
        for (int slot = 0; slot < bodies; slot++)
        {
            store.AddSlot(slot);
            Append(store, slot, Key(0, 0), 1);
        }

        List<int>[] opened = Enumerable.Range(0, bodies).Select(_ => new List<int> { 0 }).ToArray();
        for (int tick = 1; tick <= appends; tick++)
        {
            int slot = random.Next(bodies);
            store.ForgetBefore(SimTime.FromTicks(tick - window));
            Append(store, slot, Key(tick, 0), (2 * tick) + 1);
            opened[slot].Add(tick);
        }

        // One segment for each append in the window, and of each body the one before.
        Assert.InRange(store.Room, window + bodies, 1.25 * (window + bodies));
        Assert.InRange(store.Alive, window + bodies, store.Room);
        for (int slot = 0; slot < bodies; slot++)
        {
            for (int time = appends - window; time <= appends; time += 500)
            {
                int at = store.At(slot, SimTime.FromTicks(time));
                Assert.Equal(opened[slot].Last(tick => tick <= time), store.Key(at).Time.Ticks);
                Assert.Equal(slot, store.Owner(at));
            }
        }
    }

    private static string? FirstDisagreement(int seed, Cut cut)
    {
        Random random = new(seed);
        TimelineStore store = new(default);
        List<(EventKey Key, double Mark, ulong Hash)>[] model = [.. Enumerable.Range(0, Slots).Select(_ => new List<(EventKey, double, ulong)>())];
        ulong dropped = 0;
        long time = 0;
        HashSet<long> serials = [];
        for (int slot = 0; slot < Slots; slot++)
        {
            store.AddSlot(slot);
        }

        for (int i = 0; i < 4000; i++)
        {
            int slot = random.Next(Slots);
            BodyId body = BodyId.OfScene(slot);
            switch (random.Next(8))
            {
                case 0:
                    EventKey from = Key(time - random.Next(6), (uint)random.Next(3));
                    for (int s = 0; s < Slots; s++)
                    {
                        EventKey at = cut(from);
                        int expected = model[s].Skip(1).Count(entry => entry.Key >= from); // the first stays
                        model[s].RemoveRange(model[s].Count - expected, expected);
                        if (store.CutFrom(s, BodyId.OfScene(s), at) != expected)
                        {
                            return $"cut after {i}";
                        }
                    }

                    break;
                case 1:
                    SimTime edge = SimTime.FromTicks(time - random.Next(4, 12));
                    store.DropBefore(slot, edge);
                    while (model[slot].Count > 1 && model[slot][1].Key.Time < edge)
                    {
                        dropped += model[slot][0].Hash;
                        model[slot].RemoveAt(0);
                    }

                    break;
                default:
                    time += random.Next(2);
                    EventKey key = Key(time, 0);
                    if (model[slot].Count > 0 && model[slot][^1].Key >= key)
                    {
                        key = Key(model[slot][^1].Key.Time.Ticks, model[slot][^1].Key.Round + 1);
                    }

                    store.Append(slot, body, key, Segment(key, i), Dense(i));
                    if (!serials.Add(store.Serial(store.Last(slot))))
                    {
                        return $"serial used twice after {i}";
                    }

                    model[slot].Add((key, i, store.HashOf(store.Last(slot), body)));
                    break;
            }

            if (Compare(store, slot, model[slot], SimTime.FromTicks(time - random.Next(10))) is string difference)
            {
                return $"{difference} after {i}";
            }

            ulong sum = model.SelectMany(list => list).Aggregate(dropped, (total, entry) => total + entry.Hash);
            if (store.EventHash != sum || store.Alive != model.Sum(list => list.Count))
            {
                return $"hash or count after {i}";
            }
        }

        return null;
    }

    private static string? Compare(TimelineStore store, int slot, List<(EventKey Key, double Mark, ulong Hash)> model, SimTime time)
    {
        int at = store.First(slot);
        int previous = TimelineStore.None;
        foreach ((EventKey key, double mark, _) in model)
        {
            if (at == TimelineStore.None || store.Key(at) != key || store.Segment(at).Position.X != mark || store.Previous(at) != previous)
            {
                return "walk";
            }

            if (mark % 2 == 0 && store.Dense(at).Quintic.Z != mark)
            {
                return "dense output";
            }

            previous = at;
            at = store.Next(at);
        }

        int found = store.At(slot, time);
        int index = model.FindLastIndex(entry => entry.Key.Time <= time);
        double expected = index < 0 ? double.NaN : model[index].Mark;
        double actual = found == TimelineStore.None ? double.NaN : store.Segment(found).Position.X;
        return at == TimelineStore.None && store.Last(slot) == previous && expected.Equals(actual) ? null : "lookup";
    }

    private static void Append(TimelineStore store, int slot, in EventKey key, double mark) =>
        store.Append(slot, BodyId.OfScene(slot), key, Segment(key, mark), Dense(mark));

    private static EventKey Key(long ticks, uint round) =>
        new(SimTime.FromTicks(ticks), round, EventKind.Impact, BodyId.OfScene(0), BodyId.OfScene(0), 0, 0);

    private static MotionSegment Segment(in EventKey key, double mark) => new(
        mark % 2 == 0 ? MotionLaw.RungeKutta4 : MotionLaw.Ballistic, key.Time, SimTime.MaxValue, new Vector3D(mark, 0, 0), default, default);

    private static DenseOutput Dense(double mark) => new(default, default, new Vector3D(0, 0, mark));
}
