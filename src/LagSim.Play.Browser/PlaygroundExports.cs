using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Runtime.InteropServices;
using System.Runtime.InteropServices.JavaScript;
using System.Runtime.Versioning;
using System.Text.Json;
using LagSim.Scenes;

namespace LagSim.Play.Browser;

/// <summary>What the page calls: one playground, which is made again where a set-up cannot be changed while it runs.</summary>
/// <remarks>Everything is on the page's one thread. Errors of a set-up come back as sentences; none is thrown across.</remarks>
[SupportedOSPlatform("browser")]
internal static partial class PlaygroundExports
{
    private static readonly FrameWriter Frame = new();

    private static Playground? playground;
    private static readonly List<double> paths = [];

    /// <summary>The panes that are shown.</summary>
    internal static IReadOnlyList<Pane> Panes => playground!.Panes;

    /// <summary>Begins a playground of a set-up.</summary>
    /// <returns>A sentence on what cannot be; empty if it began.</returns>
    [JSExport]
    internal static string Begin(string query)
    {
        try
        {
            playground = new Playground(PlaySetup.Parse(query));
            return "";
        }
        catch (Exception refused) when (refused is FormatException or InvalidOperationException)
        {
            return refused.Message;
        }
    }

    /// <summary>Begins a playground of all that can be of a link that came from elsewhere.</summary>
    /// <returns>A sentence for each part that cannot be, with what is shown instead.</returns>
    [JSExport]
    internal static string[] Arrive(string query)
    {
        (PlaySetup setup, IReadOnlyList<WrongPart> wrong) = SetupReader.Read(query);
        List<string> sentences = [.. wrong.Select(part => $"{part.Sentence} {part.Instead}")];
        try
        {
            playground = new Playground(setup);
            if (sentences.Count > 0)
            {
                sentences.Add("All else is as the address has it.");
            }
        }
        catch (InvalidOperationException refused)
        {
            sentences.Add($"{refused.Message} The usual set-up is shown instead.");
            playground = new Playground(new PlaySetup());
        }

        return [.. sentences];
    }

    /// <summary>What the worlds are set up with otherwise than a step says.</summary>
    [JSExport]
    internal static string[] Changes(string step) => [.. GuidedSteps.Named(step).ChangesIn(playground!.Setup)];

    /// <summary>From now on the links are those of a set-up.</summary>
    /// <returns>A sentence on what cannot be; empty if they are.</returns>
    [JSExport]
    internal static string SetLink(string query)
    {
        try
        {
            playground!.SetLink(PlaySetup.Parse(query).Link);
            return "";
        }
        catch (FormatException refused)
        {
            return refused.Message;
        }
    }

    /// <summary>What does not change while a playground runs, as JSON.</summary>
    [JSExport]
    internal static string Describe()
    {
        PlayScene view = playground!.Scene;
        using System.IO.MemoryStream stream = new();
        using (Utf8JsonWriter json = new(stream))
        {
            json.WriteStartObject();
            json.WriteString("query", playground.Setup.ToQuery());
            json.WriteString("scene", playground.Setup.Scene);
            json.WriteStartArray("bodies");
            foreach (SceneBody body in view.Scene.Bodies)
            {
                json.WriteStartObject();
                json.WriteString("name", body.Name);
                json.WriteNumber("radius", body.Spec.Radius);
                json.WriteEndObject();
            }

            json.WriteEndArray();
            SceneJson.WriteView(json, view);
            WriteStrings(json, "panes", [.. playground.Panes.Select(p => PlaySetup.NameOf(p.Strategy))]);
            WriteStrings(json, "scenes", [.. PlayScene.Names]);
            WriteStrings(json, "strategies", [.. PlaySetup.StrategyNames.Reverse()]);
            WriteStrings(json, "links", [.. LinkSettings.Names]);
            SetupJson.WriteNumbers(json);
            SetupJson.WriteProfiles(json);
            json.WriteEndObject();
        }

        return System.Text.Encoding.UTF8.GetString(stream.ToArray());
    }

    /// <summary>Lets time pass, and gives the page the numbers of the frame.</summary>
    [JSExport]
    internal static void Advance(double virtualSeconds, double realSeconds)
    {
        playground!.Advance(virtualSeconds, realSeconds);
        Show(0);
    }

    /// <summary>Gives the page the numbers of a frame of another instant of the window, in seconds from now.</summary>
    [JSExport]
    internal static void Scrub(double seconds)
    {
        playground!.Scrub(seconds);
        Show(seconds);
    }

    /// <summary>The instants that every world has: the oldest that is kept and the furthest precomputed, in seconds from now.</summary>
    [JSExport]
    internal static double[] Window()
    {
        (double oldest, double newest) = playground!.Window();
        return [oldest, newest];
    }

    /// <summary>Gives the page all paths over the window, pane by pane, body by body; see <see cref="PathSampler"/>.</summary>
    [JSExport]
    internal static void SamplePaths(int count, bool withBounces)
    {
        paths.Clear();
        playground!.AppendPaths(count, withBounces, paths);

        TakePaths(CollectionsMarshal.AsSpan(paths));
    }

    /// <summary>The things to try, as JSON.</summary>
    [JSExport]
    internal static string Steps() => GuidedSteps.ToJson();

    /// <summary>Does what a button of a step does.</summary>
    /// <param name="step">The name of the step.</param>
    /// <param name="deed">The number of the button.</param>
    /// <returns>Whether all of it could be done.</returns>
    [JSExport]
    internal static bool Act(string step, int deed) =>
        GuidedSteps.Named(step).Deeds[deed].Strokes.All(stroke => playground!.Strike(stroke));

    /// <summary>A person takes a body.</summary>
    [JSExport]
    internal static bool Grab(int pane, double x, double y, double reach) => playground!.Grab(pane, x, y, reach);

    /// <summary>The hand moves.</summary>
    [JSExport]
    internal static void MoveHand(int pane, double x, double y, double velocityX, double velocityY) =>
        playground!.MoveHand(pane, x, y, velocityX, velocityY);

    /// <summary>The hand lets go.</summary>
    [JSExport]
    internal static void Release(int pane, double velocityX, double velocityY) => playground!.Release(pane, velocityX, velocityY);

    /// <summary>The instant of the newest hashes, the hash of each pane, and that of the world without delay; empty where there is
    /// none.</summary>
    [JSExport]
    internal static string[] Hashes()
    {
        ulong?[] hashes = new ulong?[playground!.Panes.Count + 1];
        double at = playground.ReadHashes(hashes);
        IEnumerable<string> texts = hashes.Select(hash => hash?.ToString("x16", CultureInfo.InvariantCulture) ?? "");
        return [at.ToString("F2", CultureInfo.InvariantCulture), .. texts];
    }

    private static void Show(double seconds)
    {
        Frame.Begin(playground!.Panes.Count, playground.Scene.Scene.Bodies.Count, playground.Seconds + seconds);
        foreach (Pane pane in playground.Panes)
        {
            Frame.WritePane(
                pane.Error, pane.Heals, pane.EventsRerun, pane.BodiesRewound, playground.BytesSent(pane.Number), playground.BytesReceived(pane.Number), pane.IsHolding);
            foreach (DrawnPlace place in pane.Places)
            {
                Frame.WriteBody(place);
            }
        }

        Frame.Show();
    }

    [JSImport("takePaths", "page")]
    private static partial void TakePaths([JSMarshalAs<JSType.MemoryView>] Span<double> paths);

    private static void WriteStrings(Utf8JsonWriter json, string name, string[] values)
    {
        json.WriteStartArray(name);
        foreach (string value in values)
        {
            json.WriteStringValue(value);
        }

        json.WriteEndArray();
    }
}
