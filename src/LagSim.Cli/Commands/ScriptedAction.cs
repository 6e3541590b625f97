using System;
using System.Globalization;
using System.Linq;
using System.Text;
using LagSim.Cli.Output;
using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Cli.Commands;

/// <summary>A timed action, as <c>--do</c> writes it: <c>KIND@SECONDS[..AT][:BODY][:X,Y,Z[/OPTION]]</c> or
/// <c>command@SECONDS[..AT]:NUMBER[,DATA]</c>.</summary>
internal sealed class ScriptedAction
{
    internal const string Syntax =
        "KIND@SECONDS[:BODY][:X,Y,Z], with SECONDS counted from the session's start. SECONDS..AT does it at SECONDS for the instant AT, at most half"
        + " the host's history later. KIND is teleport (to a point, in m), set-velocity (in m/s), "
        + "impulse (in N s), spawn (a body like BODY, at a point, in m), grab (BODY by the point at this distance from its centre, in m), "
        + "keyframe (also knot: the hand that holds BODY is at a point, in m, at rest; without another for a second it releases the body), "
        + "release (with a velocity, in m/s) "
        + "or remove (without X,Y,Z). "
        + "After X,Y,Z of a grab, /force=NEWTONS and /power=WATTS say how strong the hand is. "
        + "After X,Y,Z of a spawn or teleport, /skip does nothing if another body or static geometry is there at that instant, /beside puts it beside; of a"
        + " spawn, /players=0+2 or /players=me says which players it belongs to. "
        + "command@SECONDS:NUMBER[,DATA] tells the scene's rules something: NUMBER is 0 to 65535, DATA up to 128 bytes as 0x and hexadecimal digits, or a text. "
        + "BODY is the name of a body of the scene, by default the first, or PEER.SEQUENCE.0 for a spawned one. "
        + "Examples: teleport@3:0,15,0, impulse@2.5:ball:0,4,0, spawn@1..1.2:0,2,0/beside/players=me, command@2:2,0x01, remove@9:ball. May be repeated.";

    internal const double MaxSeconds = 1e6;

    private static readonly string[] Kinds = ["teleport", "set-velocity", "impulse", "spawn", "grab", "keyframe", "release", "remove", "command"];

    private readonly string kind;
    private readonly string? body;
    private readonly Vector3D vector;
    private readonly PlacingOptions placing;
    private readonly HandOptions hand;
    private readonly GameCommand? command;

    private ScriptedAction(string text, string kind, double seconds, double? at, string? body, Vector3D vector, PlacingOptions placing, GameCommand? command,
        HandOptions hand = default)
    {
        this.hand = hand;
        Text = text;
        this.kind = kind;
        Seconds = seconds;
        At = at;
        this.body = body;
        this.vector = vector;
        this.placing = placing;
        this.command = command;
    }

    /// <summary>The text as written.</summary>
    internal string Text { get; }

    /// <summary>The time, in seconds since the session's start.</summary>
    internal double Seconds { get; }

    /// <summary>The instant for which it is done ahead, in seconds since the session's start; null for when it is done.</summary>
    internal double? At { get; }

    /// <summary>Parses an action.</summary>
    /// <exception cref="UsageException">The text is no action; the message says what is wrong.</exception>
    internal static ScriptedAction Parse(string text)
    {
        int at = text.IndexOf('@', StringComparison.Ordinal);
        string kind = at < 0 ? text : text[..at];
        kind = kind == "knot" ? "keyframe" : kind; // the older word, which scripts use
        if (at < 0 || !Kinds.Contains(kind))
        {
            throw Wrong(text, at < 0 ? "it must be KIND@SECONDS:X,Y,Z" : $"'{kind}' must be one of {string.Join(", ", Kinds)}");
        }

        string[] parts = text[(at + 1)..].Split(':');
        string[] times = parts[0].Split("..", 2);
        double seconds = Time(text, times[0]);
        double? effect = times.Length > 1 ? Time(text, times[1]) : null;
        if (effect <= seconds)
        {
            throw Wrong(text, $"it is to be done at {times[0]} s for {times[1]} s, which must be later");
        }

        if (kind == "command")
        {
            return new ScriptedAction(text, kind, seconds, effect, null, default, default, Command(text, string.Join(':', parts[1..])));
        }

        bool isRemoval = kind == "remove";
        string name = string.Join(':', parts[1..(isRemoval ? parts.Length : Math.Max(1, parts.Length - 1))]);
        string? body = parts.Length > (isRemoval ? 1 : 2) ? name : null;
        if (body is { Length: 0 })
        {
            throw Wrong(text, "its body has no name");
        }

        if (!isRemoval && parts.Length == 1)
        {
            throw Wrong(text, $"{kind} needs X,Y,Z besides, {Meaning(kind)}: such as {text}:0,5,0");
        }

        string[] last = isRemoval ? [] : parts[^1].Split('/');
        Vector3D vector = isRemoval ? default : Vector(text, last[0]);
        PlacingOptions placing = kind == "grab" ? default : PlacingOptions.Parse(last.Skip(1), kind, why => Wrong(text, why));
        HandOptions hand = kind == "grab" ? HandOptions.Parse(last.Skip(1), why => Wrong(text, why)) : default;
        return new ScriptedAction(text, kind, seconds, effect, body, vector, placing, null, hand);
    }

    /// <summary>Resolves the action in a scene.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="self">The number of the peer that does it.</param>
    /// <exception cref="UsageException">The scene has no such body, or no rules to hear a command.</exception>
    internal PlayerAction ActionIn(Scene scene, byte self)
    {
        if (command is not null)
        {
            return scene.Rules is null
                ? throw Wrong(Text, $"scene '{scene.Name}' has no rules that could hear a command")
                : PlayerAction.Command(command);
        }

        BodyId id = BodyIn(scene);
        return kind switch
        {
            "teleport" => PlayerAction.Teleport(id, vector, whenOccupied: placing.WhenOccupied),
            "set-velocity" => PlayerAction.SetVelocity(id, vector),
            "impulse" => PlayerAction.Impulse(id, vector),
            "grab" => PlayerAction.Grab(id, vector, hand.MaxForce, hand.MaxPower),
            "keyframe" => PlayerAction.HoldKeyframe(id, vector, Vector3D.Zero),
            "release" => PlayerAction.Release(id, vector),
            "remove" => PlayerAction.Remove(id),
            _ when id.Sequence == 0 => PlayerAction.Spawn(
                scene.Bodies[id.Index].Spec, vector, players: placing.PlayersOf(self), whenOccupied: placing.WhenOccupied),
            _ => throw Wrong(Text, "a new body takes after one of the scene's own"),
        };
    }

    private BodyId BodyIn(Scene scene)
    {
        for (int n = 0; n < scene.Bodies.Count; n++)
        {
            if (body is null || scene.Bodies[n].Name == body)
            {
                return BodyId.OfScene(n);
            }
        }

        string[] numbers = (body ?? "").Split('.');
        if (numbers.Length == 3 && byte.TryParse(numbers[0], NumberStyles.None, CultureInfo.InvariantCulture, out byte peer)
            && uint.TryParse(numbers[1], NumberStyles.None, CultureInfo.InvariantCulture, out uint sequence) && sequence > 0 && numbers[2] == "0")
        {
            return new BodyId(peer, sequence, 0);
        }

        const int shown = 10;
        string there = scene.Bodies.Count == 0 ? "it has none"
            : $"it has {string.Join(", ", scene.Bodies.Take(shown).Select(b => b.Name))}{(scene.Bodies.Count > shown ? ", ..." : "")}";
        throw Wrong(Text, body is null ? $"scene '{scene.Name}' has no body" : $"scene '{scene.Name}' has no body '{body}'; {there}");
    }

    private static string Meaning(string kind) => kind switch
    {
        "teleport" => "where to in m",
        "set-velocity" => "how fast in m/s",
        "impulse" => "how hard in N s",
        "spawn" => "where in m",
        "grab" => "how far from the centre in m",
        "keyframe" => "where the hand is in m",
        _ => "how fast it goes on in m/s",
    };

    private static double Time(string text, string part) => TryNumber(part, out double seconds) && seconds is >= 0 and <= MaxSeconds
        ? seconds
        : throw Wrong(text, $"its time is '{part}', it must be a number of seconds between 0 and 1000000");

    private static GameCommand Command(string text, string part)
    {
        string[] both = part.Split(',', 2);
        if (!ushort.TryParse(both[0], NumberStyles.None, CultureInfo.InvariantCulture, out ushort number))
        {
            throw Wrong(text, $"its number is '{both[0]}', it must be a whole number from 0 to 65535, such as {text.Split(':')[0]}:1");
        }

        string data = both.Length > 1 ? both[1] : "";
        byte[] bytes;
        try
        {
            bytes = data.StartsWith("0x", StringComparison.Ordinal) ? Convert.FromHexString(data[2..]) : Encoding.UTF8.GetBytes(data);
        }
        catch (FormatException)
        {
            throw Wrong(text, $"its data is '{data}'; after 0x come hexadecimal digits, two for each byte");
        }

        return bytes.Length <= GameCommand.MaxBytes
            ? new GameCommand(number, bytes)
            : throw Wrong(text, $"it carries {bytes.Length} bytes; at most {GameCommand.MaxBytes} are allowed");
    }

    private static Vector3D Vector(string text, string part)
    {
        string[] numbers = part.Split(',');
        return numbers.Length == 3 && TryNumber(numbers[0], out double x) && TryNumber(numbers[1], out double y) && TryNumber(numbers[2], out double z)
            ? new Vector3D(x, y, z)
            : throw Wrong(text, $"'{part}' must be three numbers, X,Y,Z");
    }

    private static bool TryNumber(string text, out double value) =>
        double.TryParse(text, NumberStyles.Float, CultureInfo.InvariantCulture, out value) && double.IsFinite(value);

    private static UsageException Wrong(string text, string why) => new($"--do is '{text}'; {why}.");
}
