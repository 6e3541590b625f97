using System;
using System.Collections.Generic;
using System.CommandLine;
using System.IO;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Harness.Reports;
using LagSim.Harness.Runs;
using LagSim.Harness.Scenes;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim run</c>: one instance of a scene in virtual time.</summary>
internal static class RunCommand
{
    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Argument<string> scene = new("SCENE") { Description = "A built-in scene's name, or a JSON file." };
        Option<double> until = CommonOptions.Number("--until-s", "How long to run", 10, 0, 1e6);
        Option<string> motion = CommonOptions.Word("--motion", "The law of all bodies; by default the scene's own.", "scene", "scene", "rk4", "ballistic");
        Option<string?> events = CommonOptions.Path("--events", "Write every event to this CSV file; - is stdout.", "FILE");
        Option<string?> samples = CommonOptions.Path("--samples", "Write the state of all bodies, every so often, to this CSV file; - is stdout.", "FILE");
        Option<double> every = CommonOptions.Number("--every-s", "The time between samples", 0.01, 1e-9, 1e6);
        Option<int> repeat = CommonOptions.Whole("--repeat", "Run so many times after a warm-up; wall_s is then the least", 1, 1, 1_000_000);
        Command command = new("run", "Runs one scene in virtual time.") { scene, until, motion, events, samples, every, repeat };
        common.AddTo(command);
        command.SetAction(parsed =>
        {
            string? eventFile = parsed.GetValue(events);
            string? sampleFile = parsed.GetValue(samples);
            int toOutput = new[] { eventFile == ResultFile.StandardOutput, sampleFile == ResultFile.StandardOutput, parsed.GetValue(common.Json) }.Count(b => b);
            if (toOutput > 1)
            {
                throw new UsageException("Only one of --events -, --samples - and --json can have stdout.");
            }

            Scene loaded = SceneSource.Load(parsed.GetValue(scene)!);
            loaded = parsed.GetValue(motion) switch
            {
                "rk4" => BuiltInScenes.WithMotion(loaded, MotionLaw.RungeKutta4, BodySpec.DefaultStep),
                "ballistic" => BuiltInScenes.WithMotion(loaded, MotionLaw.Ballistic, BodySpec.DefaultStep),
                _ => loaded,
            };
            string? folder = parsed.GetValue(common.Out);
            if (folder is not null)
            {
                Directory.CreateDirectory(folder);
                eventFile ??= Path.Combine(folder, "events.csv");
                sampleFile ??= Path.Combine(folder, "samples.csv");
            }

            RefuseSameFile(("SCENE", parsed.GetValue(scene)), ("--events", eventFile), ("--samples", sampleFile));
            RunSummary summary = Run(
                console, loaded, SimDuration.FromSeconds(parsed.GetValue(until)), eventFile, sampleFile,
                parsed.GetValue(every), parsed.GetValue(repeat),
                isSummaryShown: toOutput == 0 || parsed.GetValue(common.Json));
            if (folder is not null)
            {
                RunReport.Write(folder, loaded, summary, parsed.GetValue(common.Seed), sampleFile);
            }

            if (parsed.GetValue(common.Json))
            {
                RunOutput.WriteJson(console.Output, loaded, summary, parsed.GetValue(common.Seed));
            }
            else if (toOutput == 0)
            {
                RunOutput.WriteTable(console, loaded, summary, parsed.GetValue(common.Seed));
            }

            return ExitCode.Done;
        });
        return command;
    }

    /// <summary>Two results in one file would garble each other, and one in the scene's file would be the scene's end.</summary>
    private static void RefuseSameFile(params (string Name, string? Path)[] files)
    {
        (string Name, string? Path)[] named = files.Where(f => f.Path is not (null or ResultFile.StandardOutput)).ToArray();
        for (int i = 0; i < named.Length; i++)
        {
            for (int j = i + 1; j < named.Length; j++)
            {
                if (Path.GetFullPath(named[i].Path!) == Path.GetFullPath(named[j].Path!))
                {
                    throw new UsageException($"{named[i].Name} and {named[j].Name} are both '{named[j].Path}'; they must be different files.");
                }
            }
        }
    }

    private static RunSummary Run(
        ToolConsole console, Scene scene, SimDuration length, string? eventFile, string? sampleFile, double every, int repeat, bool isSummaryShown)
    {
        using ResultFile? eventOutput = ResultFile.Open(console, eventFile);
        using ResultFile? sampleOutput = ResultFile.Open(console, sampleFile);
        CsvFile? eventCsv = eventOutput is null ? null : new CsvFile(
            eventOutput.Writer, "time_s", "kind", "body", "other", "x_m", "y_m", "z_m", "vx_m_per_s", "vy_m_per_s", "vz_m_per_s");
        CsvFile? sampleCsv = sampleOutput is null ? null : new CsvFile(
            sampleOutput.Writer, "time_s", "body", "x_m", "y_m", "z_m", "vx_m_per_s", "vy_m_per_s", "vz_m_per_s", "motion");
        SceneRun run = new(scene)
        {
            SampleEverySeconds = every,
            OnEvent = eventCsv is null ? null : e => eventCsv.WriteRow(
                [e.Key.Time.ToSeconds(), e.Kind, scene.Bodies[e.Body.Index].Name, e.Other, .. Numbers(e.State)]),
            OnSample = sampleCsv is null ? null : (time, simulation) => Sample(sampleCsv, scene, simulation, time),
        };
        double start = SceneRun.Energy(new Simulation(scene), SimTime.Zero);
        Simulation end = console.WithProgress($"run {scene.Name}", length, progress => run.Run(length, progress));
        double wall = isSummaryShown ? SceneRun.LeastSeconds(scene, length, repeat) : double.NaN;
        return new RunSummary(end, SimTime.Zero + length, start, SceneRun.Energy(end, SimTime.Zero + length), wall);
    }

    private static void Sample(CsvFile csv, Scene scene, Simulation simulation, SimTime time)
    {
        for (int body = 0; body < scene.Bodies.Count; body++)
        {
            simulation.TryRead(BodyId.OfScene(body), time, out BodyState state);
            csv.WriteRow([time.ToSeconds(), scene.Bodies[body].Name, .. Numbers(state), MotionNames.Of(state.Motion)]);
        }
    }

    private static IEnumerable<object?> Numbers(BodyState state) =>
        [state.Position.X, state.Position.Y, state.Position.Z, state.Velocity.X, state.Velocity.Y, state.Velocity.Z];
}
