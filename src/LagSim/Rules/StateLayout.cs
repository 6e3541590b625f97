using System;
using System.Buffers.Binary;
using LagSim.Scenes;

namespace LagSim.Rules;

/// <summary>How the state of rules is encoded: how many bodies they have spawned, timers by time, the world's state, and the bodies' by
/// identity.</summary>
/// <remarks>One state has one encoding, so states are compared and hashed as bytes. Little-endian, as are all processors that are
/// supported; the layout is in <c>docs/RECORDINGS.md</c>.</remarks>
internal static class StateLayout
{
    /// <summary>The most timers that may be set at a time.</summary>
    internal const int MaxTimers = 256;

    /// <summary>The most bodies that may have a state at a time.</summary>
    internal const int MaxBodies = 4096;

    internal const int HeadBytes = 16;
    internal const int TimerBytes = 16;
    internal const int IdBytes = 8;

    /// <summary>The most bytes that a state of rules may take in all.</summary>
    internal const int MaxBytes =
        HeadBytes + (MaxTimers * TimerBytes) + SceneRules.MaxWorldBytes + (MaxBodies * (IdBytes + SceneRules.MaxBodyBytes));

    internal static ulong Spawned(ReadOnlySpan<byte> state) => BinaryPrimitives.ReadUInt64LittleEndian(state);

    internal static int Timers(ReadOnlySpan<byte> state) => BinaryPrimitives.ReadInt32LittleEndian(state.Slice(8));

    internal static int Bodies(ReadOnlySpan<byte> state) => BinaryPrimitives.ReadInt32LittleEndian(state.Slice(12));

    internal static RuleTimer Timer(ReadOnlySpan<byte> state, int n)
    {
        ReadOnlySpan<byte> at = state.Slice(HeadBytes + (n * TimerBytes), TimerBytes);
        return new RuleTimer(
            BinaryPrimitives.ReadInt64LittleEndian(at), BinaryPrimitives.ReadUInt32LittleEndian(at.Slice(8)), BinaryPrimitives.ReadInt32LittleEndian(at.Slice(12)));
    }

    /// <summary>The world's state.</summary>
    internal static ReadOnlySpan<byte> World(ReadOnlySpan<byte> state, SceneRules rules) =>
        state.Slice(HeadBytes + (Timers(state) * TimerBytes), rules.WorldBytes);

    /// <summary>The identity of the n-th body that has a state.</summary>
    internal static BodyId Body(ReadOnlySpan<byte> state, int n, SceneRules rules) =>
        BodyId.FromPacked(BinaryPrimitives.ReadUInt64LittleEndian(state.Slice(BodyAt(state, n, rules))));

    /// <summary>The state of the n-th body that has one.</summary>
    internal static ReadOnlySpan<byte> OfBody(ReadOnlySpan<byte> state, int n, SceneRules rules) =>
        state.Slice(BodyAt(state, n, rules) + IdBytes, rules.BodyBytes);

    /// <summary>Which body that has a state it is, or -1.</summary>
    internal static int Find(ReadOnlySpan<byte> state, BodyId body, SceneRules rules)
    {
        int low = 0;
        int high = Bodies(state) - 1;
        while (low <= high)
        {
            int middle = (low + high) >> 1;
            int compared = Body(state, middle, rules).CompareTo(body);
            if (compared == 0)
            {
                return middle;
            }

            (low, high) = compared < 0 ? (middle + 1, high) : (low, middle - 1);
        }

        return -1;
    }

    /// <summary>Throws if bytes from anywhere are no state of these rules at that many ticks after the start.</summary>
    /// <exception cref="SceneException">The sentence says what is wrong.</exception>
    internal static void Check(ReadOnlySpan<byte> state, SceneRules? rules, long ticks)
    {
        if (rules is null)
        {
            Require(state.IsEmpty, $"takes {state.Length} bytes, and the scene has no rules");
            return;
        }

        Require(state.Length >= HeadBytes, $"takes {state.Length} bytes; at least {HeadBytes} are needed");
        int timers = Timers(state);
        int bodies = Bodies(state);
        Require(
            Spawned(state) <= uint.MaxValue,
            $"has rules that have spawned {Spawned(state)} bodies; at most {uint.MaxValue} are allowed");
        Require(timers is >= 0 and <= MaxTimers, $"has {timers} timers; at most {MaxTimers} are allowed");
        Require(bodies is >= 0 and <= MaxBodies && (bodies == 0 || rules.BodyBytes > 0), $"has states of {bodies} bodies; at most {MaxBodies} are allowed,"
            + " and none where rules declare none");
        long length = HeadBytes + (timers * TimerBytes) + rules.WorldBytes + (bodies * (long)(IdBytes + rules.BodyBytes));
        Require(state.Length == length, $"takes {state.Length} bytes; with {timers} timers and states of {bodies} bodies it takes {length}");
        for (int n = 0; n < timers; n++)
        {
            RuleTimer timer = Timer(state, n);
            Require(timer.Number >= 0, $"has timer {timer.Number}; numbers are at least 0");
            Require(
                timer.At >= ticks && timer.At - ticks <= RuleWorld.MaxDelay.Ticks && timer.Round == 0,
                $"has timer {timer.Number} due {timer.At - ticks} ticks and {timer.Round} rounds after it; 0 to {RuleWorld.MaxDelay.Ticks}"
                    + " ticks and no round are allowed");
            Require(n == 0 || timer.CompareTo(Timer(state, n - 1)) > 0, $"has timer {timer.Number} at place {n} out of order");
            for (int before = 0; before < n; before++)
            {
                Require(Timer(state, before).Number != timer.Number, $"has timer {timer.Number} twice");
            }
        }

        for (int n = 1; n < bodies; n++)
        {
            Require(Body(state, n, rules) > Body(state, n - 1, rules), $"has body {Body(state, n, rules)} at place {n} out of order");
        }
    }

    /// <summary>Adds an encoded state to a hash.</summary>
    internal static void AddTo(ref StableHash hash, ReadOnlySpan<byte> state)
    {
        hash.Add((ulong)state.Length);
        Span<byte> rest = stackalloc byte[sizeof(ulong)];
        for (; state.Length >= sizeof(ulong); state = state.Slice(sizeof(ulong)))
        {
            hash.Add(BinaryPrimitives.ReadUInt64LittleEndian(state));
        }

        if (state.Length > 0)
        {
            rest.Clear();
            state.CopyTo(rest);
            hash.Add(BinaryPrimitives.ReadUInt64LittleEndian(rest));
        }
    }

    private static int BodyAt(ReadOnlySpan<byte> state, int n, SceneRules rules) =>
        HeadBytes + (Timers(state) * TimerBytes) + rules.WorldBytes + (n * (IdBytes + rules.BodyBytes));

    private static void Require(bool holds, string what)
    {
        if (!holds)
        {
            throw new SceneException($"The state of rules in the snapshot {what}.");
        }
    }
}
