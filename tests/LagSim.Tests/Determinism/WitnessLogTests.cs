using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>Who was looked at for which impacts: in the order of the keys, whatever the order in which it was noted, and never more than may be.</summary>
public sealed class WitnessLogTests
{
    [Fact]
    public void Entries_AddedCutAndForgottenInAnyOrder_AreThoseOfAPlainSortedList()
    {
        Random random = new(1);
        WitnessLog log = new(1000);
        SortedDictionary<EventKey, int>[] should = [new(), new(), new()];
        for (int slot = 0; slot < should.Length; slot++)
        {
            log.AddSlot(slot);
        }

        for (int n = 0; n < 5000; n++)
        {
            int slot = random.Next(should.Length);
            EventKey key = Key(random.Next(40), (uint)random.Next(3));
            if (random.Next(5) == 0)
            {
                EventKey[] gone = [.. should[slot].Keys.Where(k => k >= key)];
                Array.ForEach(gone, k => should[slot].Remove(k));
                Assert.Equal(gone.Length > 0, log.CutFrom(slot, key));
            }
            else
            {
                SimTime edge = At(random.Next(4) == 0 ? random.Next(20) : 0);
                Array.ForEach([.. should[slot].Keys.Where(k => k.Time < edge)], k => should[slot].Remove(k));
                should[slot][key] = n;
                log.Add(slot, key, n, n + 1L, edge);
            }

            Assert.Equal(should[slot].Reverse().Select(e => (e.Key, e.Value)), Entries(log, slot));
        }
    }

    [Fact]
    public void Add_BeyondWhatMayBe_ThrowsUntilSomethingIsCutOrItsBodyIsForgotten()
    {
        WitnessLog log = new(2);
        log.AddSlot(0);
        log.AddSlot(1);
        log.Add(0, Key(1, 0), 0, 1, default);
        log.Add(1, Key(2, 0), 0, 1, default);
        log.Add(1, Key(2, 0), 3, 4, default); // the same again is no other
        Assert.Contains("2 looks", Assert.Throws<TimelinesFullException>(() => log.Add(0, Key(3, 0), 0, 1, default)).Message, StringComparison.Ordinal);
        log.CutFrom(0, Key(1, 0));
        log.Add(0, Key(3, 0), 0, 1, default);
        log.AddSlot(1); // another body
        Assert.Empty(Entries(log, 1));
        log.Add(1, Key(4, 0), 0, 1, default);
    }

    private static EventKey Key(double seconds, uint round) => new(At(seconds), round, EventKind.Impact, First, Second, 0, 0);

    private static List<(EventKey Key, int Segment)> Entries(WitnessLog log, int slot)
    {
        List<(EventKey, int)> entries = [];
        for (int at = log.Newest(slot); at != WitnessLog.None; at = log.Older(at))
        {
            entries.Add((log.Key(at), log.Segment(at)));
            Assert.Equal(log.Segment(at) + 1L, log.Serial(at));
        }

        return entries;
    }
}
