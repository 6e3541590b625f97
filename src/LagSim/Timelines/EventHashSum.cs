using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>
/// The sum of the hashes of events, of which four are made at a time: each is a chain of multiplications, and a processor that waits for
/// one can do three others.
/// </summary>
/// <param name="origin">From when events count time.</param>
/// <remarks>Cost: a copy of an event's words, and every fourth time the hashes; of what waits when the sum is read, one by one.</remarks>
internal sealed class EventHashSum(SimTime origin)
{
    private const int Words = 14;
    private const int Lanes = 4;

    private readonly ulong[] waiting = new ulong[Words * Lanes]; // word by word, of all that wait side by side
    private int count;
    private ulong sum;

    /// <summary>From when events count time.</summary>
    internal SimTime Origin { get; } = origin;

    /// <summary>The sum of all that was added, modulo 2^64.</summary>
    internal ulong Value
    {
        get
        {
            for (; count > 0; count--)
            {
                sum += Chain(waiting.AsSpan(count - 1), Lanes).Value;
            }

            return sum;
        }

        set
        {
            sum = value;
            count = 0;
        }
    }

    /// <summary>Adds the hash of an event that opens a segment.</summary>
    internal void Add(in EventKey key, in MotionSegment motion, BodyId body)
    {
        Write(key, motion, body, waiting.AsSpan(count), Lanes);
        if (++count == Lanes)
        {
            AddAll();
        }
    }

    /// <summary>The hash of an event that opens a segment, to which more may be added.</summary>
    internal StableHash Of(in EventKey key, in MotionSegment motion, BodyId body)
    {
        Span<ulong> words = stackalloc ulong[Words];
        Write(key, motion, body, words, 1);
        return Chain(words, 1);
    }

    private static StableHash Chain(Span<ulong> words, int every)
    {
        StableHash hash = default;
        for (int i = 0; i < Words; i++)
        {
            hash.Add(words[i * every]);
        }

        return hash;
    }

    private void Write(in EventKey key, in MotionSegment motion, BodyId body, Span<ulong> into, int every)
    {
        into[0] = body.Packed;
        into[every] = (ulong)(key.Time - Origin).Ticks;
        into[2 * every] = ((ulong)key.Round << 8) | (byte)key.Kind;
        into[3 * every] = key.Body.Packed;
        into[4 * every] = key.Other.Packed;
        into[5 * every] = key.Origin;
        into[6 * every] = (ulong)motion.Law;
        into[7 * every] = (ulong)(motion.Epoch - Origin).Ticks;
        into[8 * every] = StableHash.Word(motion.Position.X);
        into[9 * every] = StableHash.Word(motion.Position.Y);
        into[10 * every] = StableHash.Word(motion.Position.Z);
        into[11 * every] = StableHash.Word(motion.Velocity.X);
        into[12 * every] = StableHash.Word(motion.Velocity.Y);
        into[13 * every] = StableHash.Word(motion.Velocity.Z);
    }

    private void AddAll()
    {
        StableHash a = default;
        StableHash b = default;
        StableHash c = default;
        StableHash d = default;
        Span<ulong> words = waiting;
        for (int i = 0; i + Lanes <= words.Length; i += Lanes)
        {
            a.Add(words[i]);
            b.Add(words[i + 1]);
            c.Add(words[i + 2]);
            d.Add(words[i + 3]);
        }

        sum += a.Value + b.Value + c.Value + d.Value;
        count = 0;
    }
}
