using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>What a world shows besides its hashes at an instant: the state of its rules, and the bodies that were spawned.</summary>
internal sealed class CommittedWorld
{
    private readonly Scene scene;
    private readonly IReadOnlyList<KeyValuePair<string, double>> rules;
    private readonly IReadOnlyList<(BodyId Body, Vector3D Position)> spawned;

    /// <summary>Reads it. For the thread that owns the world.</summary>
    internal CommittedWorld(Simulation world, SimTime time)
    {
        scene = world.Scene;
        rules = (scene.Rules as ShownRules)?.Show(world, time) ?? [];
        spawned = [.. Enumerable.Range(0, world.BodyCount).Select(world.BodyAt).Where(body => body.Sequence > 0)
            .Select(body => (body, world.TryRead(body, time, out BodyState state) ? state.Position : (Vector3D?)null))
            .Where(one => one.Item2 is not null).Select(one => (one.body, one.Item2!.Value)).OrderBy(one => one.body)];
    }

    /// <summary>The state of the rules in a line; null if there are none to show.</summary>
    internal string? RulesLine => rules.Count == 0 ? null
        : $"rules {scene.Rules}: {string.Join(", ", rules.Select(one => string.Create(CultureInfo.InvariantCulture, $"{one.Key} {one.Value:R}")))}";

    /// <summary>Writes <c>rules</c>, null without any, and <c>spawned</c>.</summary>
    internal static void Write(Utf8JsonWriter json, Scene scene, CommittedWorld? world)
    {
        if (scene.Rules is SceneRules rules)
        {
            json.WriteStartObject("rules");
            json.WriteString("name", rules.Name);
            json.WriteNumber("version", rules.Version);
            json.WriteStartObject("state");
            foreach ((string key, double value) in world?.rules ?? [])
            {
                json.WriteNumber(key, value);
            }

            json.WriteEndObject();
            json.WriteEndObject();
        }
        else
        {
            json.WriteNull("rules");
        }

        json.WriteStartArray("spawned");
        foreach ((BodyId body, Vector3D position) in world?.spawned ?? [])
        {
            json.WriteStartObject();
            json.WriteString("body", body.ToString());
            json.WriteStartArray("position_m");
            json.WriteNumberValue(position.X);
            json.WriteNumberValue(position.Y);
            json.WriteNumberValue(position.Z);
            json.WriteEndArray();
            json.WriteEndObject();
        }

        json.WriteEndArray();
    }
}
