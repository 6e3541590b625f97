using System;
using System.Collections.Generic;
using LagSim.Rules;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>The states of a scene's rules over the span of a render snapshot, copied out of the simulation.</summary>
internal sealed class RenderRules
{
    private readonly List<Entry> entries = new(); // by time; those after the count are kept for their memory
    private int count;

    /// <summary>Takes over what has changed since this last followed the rules.</summary>
    internal void Follow(RuleLog log, SimTime from)
    {
        count = 0;
        Add(SimTime.MinValue, log.StateAt(from));
        for (int n = log.FirstAfter(from); n < log.Position; n++)
        {
            Add(log[n].Key.Time, log[n].StateAfter!);
        }
    }

    /// <summary>The state after everything of an instant.</summary>
    internal ReadOnlySpan<byte> At(SimTime time)
    {
        int n = count - 1;
        while (n > 0 && entries[n].From > time)
        {
            n--;
        }

        return entries[n].State.Bytes;
    }

    private void Add(SimTime from, StateVersion state)
    {
        if (count > 0 && entries[count - 1].State.Serial == state.Serial)
        {
            return; // a call that changed nothing
        }

        Entry entry = Take(state.Serial);
        entry.From = from;
        if (entry.State.Serial != state.Serial)
        {
            entry.State.Set(state.Bytes, state.Serial);
        }
    }

    /// <summary>The next entry: the one that has this state already, if any has, since the states move on as the window does.</summary>
    private Entry Take(long serial)
    {
        if (count == entries.Count)
        {
            entries.Add(new Entry());
        }

        int at = count;
        while (at < entries.Count && entries[at].State.Serial != serial)
        {
            at++;
        }

        if (at < entries.Count)
        {
            (entries[at], entries[count]) = (entries[count], entries[at]);
        }

        return entries[count++];
    }

    private sealed class Entry
    {
        internal RenderState State { get; } = new();

        internal SimTime From { get; set; }
    }
}
