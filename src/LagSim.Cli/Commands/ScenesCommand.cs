using System.CommandLine;
using System.IO;
using LagSim.Cli.Output;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using Spectre.Console;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim scenes</c>: the built-in scenes, and any of them as JSON.</summary>
internal static class ScenesCommand
{
    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Argument<string?> name = new("NAME") { Description = "Print this scene as JSON, ready to edit.", Arity = ArgumentArity.ZeroOrOne };
        Command command = new("scenes", "Lists the built-in scenes, or prints one as JSON.") { name };
        common.AddTo(command, isSeedDrawnFrom: false);
        command.SetAction(parsed =>
        {
            string? chosen = parsed.GetValue(name);
            string? folder = parsed.GetValue(common.Out);
            if (chosen is null && folder is not null)
            {
                throw new UsageException($"--out is '{folder}', but there is nothing to write: it needs the NAME of a scene.");
            }

            if (chosen is not null)
            {
                Print(console, SceneSource.Load(chosen), folder);
            }
            else if (parsed.GetValue(common.Json))
            {
                ListAsJson(console, parsed.GetValue(common.Seed));
            }
            else
            {
                Table table = new Table { Border = TableBorder.Rounded }.AddColumns("scene", "what it is");
                foreach (string known in BuiltInScenes.Names)
                {
                    table.AddRow(known, Markup.Escape(BuiltInScenes.Describe(known)));
                }

                console.Rich.Write(table);
            }

            return ExitCode.Done;
        });
        return command;
    }

    private static void Print(ToolConsole console, Scene scene, string? folder)
    {
        string text = SceneFile.ToJson(scene);
        if (folder is null)
        {
            console.Output.WriteLine(text.TrimEnd());
            return;
        }

        // A scene may have any name, which must not lead out of the folder.
        if (scene.Name.IndexOfAny(Path.GetInvalidFileNameChars()) >= 0)
        {
            throw new UsageException($"The scene is called '{scene.Name}', which cannot be a file's name; give it another, or leave out --out.");
        }

        OutputFolder.ThrowIfNotWritable(folder);
        Directory.CreateDirectory(folder);
        File.WriteAllText(Path.Combine(folder, $"{scene.Name}.json"), text);
    }

    private static void ListAsJson(ToolConsole console, ulong seed) =>
        JsonDocumentWriter.Write(console.Output, "scenes", seed, null, null, null, json =>
        {
            json.WriteStartArray("scenes");
            foreach (string known in BuiltInScenes.Names)
            {
                json.WriteStartObject();
                json.WriteString("name", known);
                json.WriteString("description", BuiltInScenes.Describe(known));
                json.WriteString("hash", JsonDocumentWriter.Hash(SceneSource.Load(known).Hash));
                json.WriteEndObject();
            }

            json.WriteEndArray();
        });
}
