using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Harm;

/// <summary>A drawn session of honest players whose host gets little time: a scene, how the host is starved, and what the players do.</summary>
public sealed class StarvedCase
{
    /// <summary>How long the players act, in seconds.</summary>
    public const double Seconds = 5;

    /// <summary>The number of players besides the host's own.</summary>
    public const int Players = 4;

    internal const double From = 0.5;
    private const double ActionsASecond = 4;

    /// <summary>A tenth of a core, half of a core, or all that sixteen spinning programs leave.</summary>
    private static readonly (double Share, int Spinning)[] Kinds = [(0.1, 0), (0.5, 0), (1, 16)];

    /// <summary>Draws the session of a seed.</summary>
    public StarvedCase(ulong seed)
    {
        Seed = seed;
        (Share, Spinning) = Kinds[(int)(seed % (ulong)Kinds.Length)];
        SceneName = BuiltInScenes.Names[(int)(seed / (ulong)Kinds.Length % (ulong)BuiltInScenes.Names.Count)];
        Scene scene = BuiltInScenes.TryGet(SceneName, out Scene? built) ? built : throw new InvalidOperationException(SceneName);
        SeededRandom random = new SeededRandom(seed).Fork(0x57A2);
        Actions = [.. Enumerable.Range(0, Players).Select(n => Draw(scene, random.Fork((ulong)n)))];
    }

    /// <summary>The seed.</summary>
    public ulong Seed { get; }

    /// <summary>The name of the built-in scene.</summary>
    public string SceneName { get; }

    /// <summary>The share of a core that the host's process gets, above 0 to 1.</summary>
    public double Share { get; }

    /// <summary>How many programs spin beside it.</summary>
    public int Spinning { get; }

    /// <summary>What each player does, as the tool's <c>--do</c> has it.</summary>
    internal IReadOnlyList<string[]> Actions { get; }

    /// <summary>How the host is starved, in words.</summary>
    public string Starvation => string.Create(CultureInfo.InvariantCulture, $"{(Spinning > 0 ? $"beside {Spinning} spinning programs" : $"at {Share:0.##} of a core")}");

    /// <inheritdoc/>
    public override string ToString() => $"{SceneName}, the host {Starvation}";

    private static string[] Draw(Scene scene, SeededRandom random)
    {
        List<string> actions = [];
        for (double at = From + (random.NextDouble() / ActionsASecond); at < From + Seconds; at += random.NextDouble(0.5, 1.5) / ActionsASecond)
        {
            SceneBody body = scene.Bodies[random.NextInt(scene.Bodies.Count)];
            Vector3D velocity = new Vector3D(random.NextDouble(-1, 1), random.NextDouble(-0.3, 1), random.NextDouble(-1, 1)) * 6;
            switch (random.NextInt(5))
            {
                case 0:
                    actions.Add(Text("spawn", at, body.Name, body.Position + new Vector3D(random.NextDouble(-1, 1), 2, random.NextDouble(-1, 1)), "/skip"));
                    break;
                case 1:
                    actions.Add(Text("impulse", at, body.Name, velocity * body.Spec.Mass));
                    break;
                case 2 when at + 0.5 < From + Seconds:
                    Vector3D hand = body.Position + new Vector3D(0, 0.2, 0);
                    actions.Add(Text("grab", at, body.Name, Vector3D.Zero));
                    actions.AddRange(Enumerable.Range(1, 9).Select(n => Text("keyframe", at + (0.05 * n), body.Name, hand + (velocity * (0.01 * n)))));
                    actions.Add(Text("release", at + 0.5, body.Name, velocity * 0.5));
                    break;
                default:
                    actions.Add(Text("set-velocity", at, body.Name, velocity));
                    break;
            }
        }

        return [.. actions];
    }

    private static string Text(string kind, double at, string body, Vector3D vector, string options = "") => string.Create(
        CultureInfo.InvariantCulture, $"{kind}@{at:0.####}:{body}:{vector.X:0.######},{vector.Y:0.######},{vector.Z:0.######}{options}");
}
