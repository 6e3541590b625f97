using System;
using System.Runtime.InteropServices;
using LagSim.Scenes;

namespace LagSim.Rules;

/// <summary>Reads values out of an encoded state of rules.</summary>
internal static class RuleStateReader
{
    /// <summary>Throws if a scene has rules and they declare another type as the state of the world.</summary>
    /// <exception cref="InvalidOperationException">They declare another type, or none.</exception>
    internal static void CheckWorld<T>(Scene? scene)
        where T : unmanaged => Check(scene, ((GameRules?)scene?.Rules)?.WorldType, typeof(T), "the world");

    /// <summary>Throws if a scene has rules and they declare another type as the state of a body.</summary>
    /// <exception cref="InvalidOperationException">They declare another type, or none.</exception>
    internal static void CheckBody<T>(Scene? scene)
        where T : unmanaged => Check(scene, ((GameRules?)scene?.Rules)?.BodyType, typeof(T), "a body");

    /// <summary>The world's state; the type has been checked.</summary>
    internal static T Read<T>(Scene scene, ReadOnlySpan<byte> state)
        where T : unmanaged => MemoryMarshal.Read<T>(StateLayout.World(state, scene.Rules!));

    /// <summary>A body's state; false if it has none. The type has been checked.</summary>
    internal static bool TryRead<T>(Scene scene, ReadOnlySpan<byte> state, BodyId body, out T value)
        where T : unmanaged
    {
        int n = StateLayout.Find(state, body, scene.Rules!);
        value = n >= 0 ? MemoryMarshal.Read<T>(StateLayout.OfBody(state, n, scene.Rules!)) : default;
        return n >= 0;
    }

    private static void Check(Scene? scene, Type? declared, Type asked, string whose)
    {
        if (scene?.Rules is SceneRules rules && declared != asked)
        {
            throw new InvalidOperationException(
                $"The state of {whose} is asked for as {asked}; the rules '{rules}' declare {declared?.ToString() ?? "none"}.");
        }
    }
}
