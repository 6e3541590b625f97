using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text;
using System.Text.Json;

namespace LagSim.Play;

/// <summary>The five things to try, in their order: the thesis's Fig 3 and Fig 5, then what its figures could not show.</summary>
/// <remarks>What they say is so, is tested. Immutable.</remarks>
internal static class GuidedSteps
{
    /// <summary>The name of the drop test as a step asks for it.</summary>
    internal const string Drop = "drop";

    /// <summary>The name of the test of a hand as a step asks for it.</summary>
    internal const string Hold = "hold";

    /// <summary>The steps.</summary>
    internal static IReadOnlyList<GuidedStep> All { get; } =
    [
        new GuidedStep(
            "lift", "Lift a ball", "Fig 3 of the thesis: 25 ms",
            "scene=drop&panes=healing,none&delay=25",
            [
                "A ball rests, and one player lifts it to 15 m; the other hears of it 25 ms later. The table has every strategy: with 'none'"
                    + " the worlds stay apart until the ball rests, with 'healing' no bit differs once the event is there.",
                "Below, lift the ball yourself: player 2 does nothing about late events.",
            ],
            Drop, [], []),
        new GuidedStep(
            "hand", "Hold a ball", "Fig 5 of the thesis: a hand",
            "scene=room&panes=healing,healing",
            [
                "A hand shakes a ball at random and throws it, and the other player sees that late. The table says how far off the ball is"
                    + " drawn while it is held, for seven delays, and that both worlds are equal to the bit at the end, whatever the delay.",
                "A second table predicts the same hand without a session, from every sample of it: what any player could know at that delay.",
                "Below, take a ball yourself, and watch it in the other world.",
            ],
            Hold, [], []),
        new GuidedStep(
            "break", "Break at pool", "200 ms, a strategy each",
            "scene=break&panes=full-rollback,healing,latency-forward,none&delay=200",
            [
                "One player breaks, and the others see it 200 ms late or more. Look at the dashed circles: with 'healing' and 'full-rollback'"
                    + " they are filled within a moment and the hashes agree. With 'latency-forward' and 'none' a small error at the rack"
                    + " becomes another game altogether.",
                "Compare 'events re-run': healing rewinds only what the stroke has touched.",
            ],
            null,
            [
                new GuidedDeed("Player 1 breaks", [new Stroke(0, 0, 9, 0.2)]),
                new GuidedDeed("Player 2 breaks", [new Stroke(1, 0, 9, 0.2)]),
            ],
            [("With interpolation in place of latency-forward", "scene=break&panes=full-rollback,healing,interpolation,none&delay=200")]),
        new GuidedStep(
            "loss", "Lose datagrams", "four in ten, ten in a row",
            "scene=room&panes=healing,healing,none&delay=60&jitter=20&loss=40&burst=10",
            [
                "Four of ten datagrams are lost, on average ten in a row, so that a throw may come half a second late and more. Player 2"
                    + " rewinds further then, and agrees all the same; player 3, who does nothing about it, does not.",
            ],
            null,
            [new GuidedDeed("Player 1 throws three balls", [new Stroke(0, 0, 3, 5), new Stroke(0, 5, -3, 6), new Stroke(0, 10, 4, 4)])],
            [("The same without loss", "scene=room&panes=healing,healing,none&delay=60&jitter=20")]),
        new GuidedStep(
            "later", "Act a little later", "local lag and look-ahead",
            "scene=room&panes=healing,healing&delay=60&ahead=400&lag=100",
            [
                "What a player does happens 100 ms later, in its own world too. The event is with the others before that: nothing that anybody"
                    + " has seen is rewritten. No ring lights up, and 'off by' stays at zero.",
                "What the heals rewrite is the future. Worlds are computed up to 400 ms ahead: pause, and pull the slider right of now"
                    + " to see it.",
            ],
            null,
            [new GuidedDeed("Player 1 throws three balls", [new Stroke(0, 0, 3, 5), new Stroke(0, 5, -3, 6), new Stroke(0, 10, 4, 4)])],
            [("The same without local lag", "scene=room&panes=healing,healing&delay=60&ahead=400")]),
    ];

    /// <summary>Returns the step of that name.</summary>
    /// <exception cref="ArgumentException">There is none; the message lists those that there are.</exception>
    internal static GuidedStep Named(string name) => All.FirstOrDefault(step => step.Name == name)
        ?? throw new ArgumentException($"There is no step '{name}'; there are {string.Join(", ", All.Select(step => step.Name))}.");

    /// <summary>The steps as the page reads them.</summary>
    internal static string ToJson()
    {
        using MemoryStream stream = new();
        using (Utf8JsonWriter json = new(stream))
        {
            json.WriteStartArray();
            foreach (GuidedStep step in All)
            {
                json.WriteStartObject();
                json.WriteString("name", step.Name);
                json.WriteString("title", step.Title);
                json.WriteString("subtitle", step.Subtitle);
                json.WriteString("query", step.Query);
                json.WriteString("test", step.Test);
                WriteStrings(json, "sentences", step.Sentences);
                WriteStrings(json, "deeds", step.Deeds.Select(deed => deed.Text));
                json.WriteStartArray("variants");
                foreach ((string text, string query) in step.Variants)
                {
                    json.WriteStartObject();
                    json.WriteString("text", text);
                    json.WriteString("query", query);
                    json.WriteEndObject();
                }

                json.WriteEndArray();
                json.WriteEndObject();
            }

            json.WriteEndArray();
        }

        return Encoding.UTF8.GetString(stream.ToArray());
    }

    private static void WriteStrings(Utf8JsonWriter json, string name, IEnumerable<string> values)
    {
        json.WriteStartArray(name);
        foreach (string value in values)
        {
            json.WriteStringValue(value);
        }

        json.WriteEndArray();
    }
}
