using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Reports;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>The explanation of a scene, as tables and as JSON.</summary>
internal static class ExplainOutput
{
    private const int MaxNames = 3;

    /// <summary>The most characters of names in a row, so that there is room for the sentence.</summary>
    private const int LongestNames = 40;

    internal static void WriteTables(ToolConsole console, Scene scene, SceneExplanation explanation)
    {
        console.Output.WriteLine($"lagsim {ToolVersion.Text}   explain   scene {scene.Name} {JsonDocumentWriter.Hash(scene.Hash)}");
        Table bodies = NewTable("how each body moves", ["bodies", "motion", "pieces/s", "force calls/s", "why"]);
        foreach (IGrouping<(MotionLaw Motion, string Why, string Pieces, string Calls), BodyExplanation> alike in explanation.Bodies.GroupBy(
            body => (body.Motion, body.Why, Rate(body.SegmentsPerSecond), Rate(body.EvaluationsPerSecond))))
        {
            bodies.AddRow(
                Markup.Escape(Names(alike.ToArray())), MotionNames.Of(alike.Key.Motion), alike.Key.Pieces, alike.Key.Calls, Markup.Escape(alike.Key.Why));
        }

        if (explanation.Bodies.Count > 0)
        {
            console.Write(bodies);
        }

        Table features = NewTable("what is modelled", ["what", "modelled", "why"]);
        foreach (FeatureExplanation feature in explanation.Features)
        {
            features.AddRow(feature.Name, feature.IsModelled ? "yes" : "no", Markup.Escape(feature.Why));
        }

        console.Write(features);
        console.Output.WriteLine("pieces/s: pieces of path in a simulated second where the body starts, besides those that impacts open; 0: one from impact"
            + " to impact.");
        if (explanation.CannotBegin is string why)
        {
            console.Output.WriteLine($"No world of this scene can begin. {Sentence.Printable(why)}");
        }
    }

    internal static void WriteJson(TextWriter output, Scene scene, SceneExplanation explanation, ulong seed) =>
        JsonDocumentWriter.Write(output, "explain", seed, scene.Name, scene.Hash, null, json =>
        {
            json.WriteStartArray("bodies");
            foreach (BodyExplanation body in explanation.Bodies)
            {
                json.WriteStartObject();
                json.WriteString("name", body.Body);
                json.WriteString("motion", MotionNames.Of(body.Motion));
                json.WriteString("why", body.Why);
                WriteRate(json, "segments_per_s", body.SegmentsPerSecond);
                WriteRate(json, "force_evaluations_per_s", body.EvaluationsPerSecond);
                json.WriteEndObject();
            }

            json.WriteEndArray();
            json.WriteStartArray("features");
            foreach (FeatureExplanation feature in explanation.Features)
            {
                json.WriteStartObject();
                json.WriteString("name", feature.Name);
                json.WriteBoolean("modelled", feature.IsModelled);
                json.WriteString("why", feature.Why);
                json.WriteEndObject();
            }

            json.WriteEndArray();
            json.WriteString("cannot_begin", explanation.CannotBegin);
        });

    private static string Rate(double perSecond) => double.IsNaN(perSecond) ? "-" : NumberText.Short(perSecond);

    private static void WriteRate(Utf8JsonWriter json, string name, double perSecond)
    {
        if (double.IsNaN(perSecond))
        {
            json.WriteNull(name);
        }
        else
        {
            json.WriteNumber(name, perSecond);
        }
    }

    /// <summary>Returns a table of which only the last column, a sentence, is wrapped.</summary>
    private static Table NewTable(string title, string[] columns)
    {
        Table table = DropTables.NewTable(title, columns);
        foreach (TableColumn column in table.Columns)
        {
            column.NoWrap = true;
        }

        TableColumn last = table.Columns[^1];
        last.NoWrap = false;
        last.Alignment = Justify.Left;
        return table;
    }

    private static string Names(IReadOnlyList<BodyExplanation> bodies)
    {
        int named = 1;
        string names = bodies[0].Body;
        while (named < Math.Min(MaxNames, bodies.Count) && names.Length + bodies[named].Body.Length < LongestNames)
        {
            names += $", {bodies[named++].Body}";
        }

        return names + (bodies.Count > named ? $" and {bodies.Count - named} more" : "");
    }
}
