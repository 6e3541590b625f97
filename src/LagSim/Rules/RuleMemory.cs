using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using LagSim.Scenes;

namespace LagSim.Rules;

/// <summary>The state of rules as a call works on it. Its memory never moves, since a call holds references into it.</summary>
internal sealed class RuleMemory(SceneRules rules)
{
    private const int BodiesAChunk = 64;

    private readonly byte[] world = new byte[rules.WorldBytes];
    private readonly List<byte[]> chunks = new(); // states of bodies by place
    private readonly List<(BodyId Body, int Place)> bodies = new(); // by identity
    private readonly Stack<int> free = new();
    private readonly List<RuleTimer> timers = new(); // in order
    private byte[] encoded = new byte[StateLayout.HeadBytes + rules.WorldBytes];

    /// <summary>How many bodies the rules have spawned.</summary>
    internal ulong Spawned { get; set; }

    /// <summary>How many timers are set.</summary>
    internal int TimerCount => timers.Count;

    /// <summary>How many bodies have a state.</summary>
    internal int BodyCount => bodies.Count;

    /// <summary>The state that a world begins with: all zero.</summary>
    internal ReadOnlySpan<byte> Begin()
    {
        Spawned = 0;
        timers.Clear();
        ClearBodies();
        world.AsSpan().Clear();
        return Encode();
    }

    /// <summary>Takes on an encoded state.</summary>
    internal void Load(ReadOnlySpan<byte> state)
    {
        Spawned = StateLayout.Spawned(state);
        timers.Clear();
        for (int n = 0; n < StateLayout.Timers(state); n++)
        {
            timers.Add(StateLayout.Timer(state, n));
        }

        StateLayout.World(state, rules).CopyTo(world);
        ClearBodies();
        for (int n = 0; n < StateLayout.Bodies(state); n++)
        {
            int place = TakePlace();
            bodies.Add((StateLayout.Body(state, n, rules), place));
            StateLayout.OfBody(state, n, rules).CopyTo(At(place));
        }
    }

    /// <summary>The state, encoded; valid until the next call of this.</summary>
    internal ReadOnlySpan<byte> Encode()
    {
        int length = StateLayout.HeadBytes + (timers.Count * StateLayout.TimerBytes) + world.Length
            + (bodies.Count * (StateLayout.IdBytes + rules.BodyBytes));
        if (encoded.Length < length)
        {
            encoded = new byte[Math.Max(length, 2 * encoded.Length)];
        }

        Span<byte> to = encoded;
        BinaryPrimitives.WriteUInt64LittleEndian(to, Spawned);
        BinaryPrimitives.WriteInt32LittleEndian(to.Slice(8), timers.Count);
        BinaryPrimitives.WriteInt32LittleEndian(to.Slice(12), bodies.Count);
        to = to.Slice(StateLayout.HeadBytes);
        foreach (RuleTimer timer in timers)
        {
            BinaryPrimitives.WriteInt64LittleEndian(to, timer.At);
            BinaryPrimitives.WriteUInt32LittleEndian(to.Slice(8), timer.Round);
            BinaryPrimitives.WriteInt32LittleEndian(to.Slice(12), timer.Number);
            to = to.Slice(StateLayout.TimerBytes);
        }

        world.CopyTo(to);
        to = to.Slice(world.Length);
        foreach ((BodyId body, int place) in bodies)
        {
            BinaryPrimitives.WriteUInt64LittleEndian(to, body.Packed);
            At(place).CopyTo(to.Slice(StateLayout.IdBytes));
            to = to.Slice(StateLayout.IdBytes + rules.BodyBytes);
        }

        return encoded.AsSpan(0, length);
    }

    /// <summary>The world's state.</summary>
    internal ref T World<T>()
        where T : unmanaged => ref MemoryMarshal.GetReference(MemoryMarshal.Cast<byte, T>(world.AsSpan()));

    /// <summary>A body's state; at first all zero.</summary>
    internal ref T Of<T>(BodyId body)
        where T : unmanaged
    {
        int n = Find(body);
        if (n < 0)
        {
            n = ~n;
            bodies.Insert(n, (body, TakePlace()));
            At(bodies[n].Place).Clear();
        }

        return ref MemoryMarshal.GetReference(MemoryMarshal.Cast<byte, T>(At(bodies[n].Place)));
    }

    /// <summary>Whether a body has a state.</summary>
    internal bool Has(BodyId body) => Find(body) >= 0;

    /// <summary>Forgets a body's state.</summary>
    internal void Forget(BodyId body)
    {
        int n = Find(body);
        if (n >= 0)
        {
            free.Push(bodies[n].Place);
            bodies.RemoveAt(n);
        }
    }

    /// <summary>Sets a timer, in place of any of that number.</summary>
    internal void Set(RuleTimer timer)
    {
        Cancel(timer.Number);
        int at = timers.BinarySearch(timer);
        timers.Insert(~at, timer);
    }

    /// <summary>Cancels a timer; false if none of that number is set.</summary>
    internal bool Cancel(int number)
    {
        for (int n = 0; n < timers.Count; n++)
        {
            if (timers[n].Number == number)
            {
                timers.RemoveAt(n);
                return true;
            }
        }

        return false;
    }

    private void ClearBodies()
    {
        foreach ((_, int place) in bodies)
        {
            free.Push(place);
        }

        bodies.Clear();
    }

    private int TakePlace()
    {
        if (free.Count == 0)
        {
            chunks.Add(new byte[BodiesAChunk * rules.BodyBytes]);
            for (int place = (chunks.Count * BodiesAChunk) - 1; place >= (chunks.Count - 1) * BodiesAChunk; place--)
            {
                free.Push(place);
            }
        }

        return free.Pop();
    }

    private Span<byte> At(int place) => chunks[place / BodiesAChunk].AsSpan(place % BodiesAChunk * rules.BodyBytes, rules.BodyBytes);

    private int Find(BodyId body)
    {
        int low = 0;
        int high = bodies.Count - 1;
        while (low <= high)
        {
            int middle = (low + high) >> 1;
            int compared = bodies[middle].Body.CompareTo(body);
            if (compared == 0)
            {
                return middle;
            }

            (low, high) = compared < 0 ? (middle + 1, high) : (low, middle - 1);
        }

        return ~low;
    }
}
