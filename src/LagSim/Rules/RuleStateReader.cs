using System;
using System.Runtime.InteropServices;
using LagSim.Scenes;

namespace LagSim.Rules;

/// <summary>Reads values out of an encoded state of rules.</summary>
internal static class RuleStateReader
{
    /// <summary>The world's state; false if the rules declare another type.</summary>
    internal static bool TryRead<T>(Scene scene, ReadOnlySpan<byte> state, out T value)
        where T : unmanaged
    {
        value = default;
        bool isDeclared = ((GameRules?)scene.Rules)?.WorldType == typeof(T);
        if (isDeclared)
        {
            value = MemoryMarshal.Read<T>(StateLayout.World(state, scene.Rules!));
        }

        return isDeclared;
    }

    /// <summary>A body's state; false if it has none, or the rules declare another type.</summary>
    internal static bool TryRead<T>(Scene scene, ReadOnlySpan<byte> state, BodyId body, out T value)
        where T : unmanaged
    {
        value = default;
        bool isDeclared = ((GameRules?)scene.Rules)?.BodyType == typeof(T);
        int n = isDeclared ? StateLayout.Find(state, body, scene.Rules!) : -1;
        if (n >= 0)
        {
            value = MemoryMarshal.Read<T>(StateLayout.OfBody(state, n, scene.Rules!));
        }

        return n >= 0;
    }
}
