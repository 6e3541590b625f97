using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Harness.Reports;
using LagSim.Harness.SceneFiles;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim run</c>: simulates one instance of a scene in virtual time.</summary>
internal static class RunCommand
{
    /// <summary>The most rows, some 1.5 GB of CSV.</summary>
    private const double MaxSampleRows = 1e7;

    /// <summary>The warm-up, in seconds, after which the JIT compiler has done its work.</summary>
    private const double LongEnoughToWarmUp = 1;

    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Argument<string> scene = new("SCENE") { Description = CommonOptions.SceneText };
        Option<double> until = CommonOptions.Number("--until-s", "How long to run", 10, 0, 1e6);
        Option<string> motion = CommonOptions.Word("--motion", "The law of motion of all bodies; by default the scene's own.", "scene", ["scene", .. MotionNames.Flight]);
        Option<string?> events = CommonOptions.File("--events", "Write every event to this CSV file; - means stdout.");
        Option<string?> samples = CommonOptions.File("--samples", "Write the state of all bodies at regular intervals to this CSV file; - means stdout.");
        Option<double> every = CommonOptions.Number("--every-s", "The time between samples", 0.01, 1e-9, 1e6);
        Option<int> repeat = CommonOptions.Whole("--repeat", "How many times to run the scene again to time it, after the run whose results are written; wall_s is the shortest."
            + " If the first run took less than a second, one more comes before these as a warm-up. With 0 nothing runs again, and wall_s is the first run's", 1, 0, 1_000_000);
        Option<double> history = CommonOptions.Number(
            "--history-s", "How much of its past the simulation keeps; less needs less memory where millions of events happen in a second", 1, 1e-6, 1e6);
        Command command = new("run", "Runs one scene in virtual time.") { scene, until, motion, events, samples, every, repeat, history };
        common.AddTo(command, isSeedDrawnFrom: false);
        command.SetAction(parsed =>
        {
            string? eventFile = parsed.GetValue(events);
            string? sampleFile = parsed.GetValue(samples);
            bool json = parsed.GetValue(common.Json);
            int streams = new[] { eventFile, sampleFile }.Count(file => file == ResultFile.StandardOutput);
            if (streams + (json ? 1 : 0) > 1)
            {
                throw new UsageException("Only one of --events -, --samples - and --json can have stdout.");
            }

            Scene loaded = SceneSource.Load(parsed.GetValue(scene)!);
            if (MotionNames.TryParseFlight(parsed.GetValue(motion)!, out MotionLaw law))
            {
                loaded = BuiltInScenes.WithMotion(loaded, law, BodySpec.DefaultStep);
            }

            string? folder = parsed.GetValue(common.Out);
            if (folder is not null)
            {
                eventFile ??= Path.Combine(folder, "events.csv");
                sampleFile ??= Path.Combine(folder, "samples.csv");
            }

            RefuseSameFile(("SCENE", parsed.GetValue(scene)), ("--events", eventFile), ("--samples", sampleFile));
            if (sampleFile is not null)
            {
                RefuseTooManyRows(parsed.GetValue(every), parsed.GetValue(until), loaded.Bodies.Count);
            }

            Request request = new(
                loaded, SimDuration.FromSeconds(parsed.GetValue(until)), eventFile, sampleFile, parsed.GetValue(every),
                streams > 0 ? 0 : parsed.GetValue(repeat), folder, parsed.GetValue(common.Seed), SimDuration.FromSeconds(parsed.GetValue(history)));
            RunSummary summary = Run(console, request, isBarShown: streams == 0 || !console.IsTerminal);
            if (json)
            {
                RunOutput.WriteJson(console.Output, loaded, summary, request.Seed);
            }
            else if (streams == 0)
            {
                RunOutput.WriteTable(console, loaded, summary, request.Seed);
            }

            return ExitCode.Done;
        });
        return command;
    }

    /// <summary>Refuses two results in one file, and a result in the scene's file.</summary>
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

    /// <summary>Refuses a row count that would fill the disk, as a mistyped exponent may ask for.</summary>
    private static void RefuseTooManyRows(double every, double until, int bodies)
    {
        double rows = (Math.Floor(until / every) + 1) * bodies;
        if (rows > MaxSampleRows)
        {
            throw new UsageException(string.Create(
                CultureInfo.InvariantCulture,
                $"--every-s is {every}; up to --until-s {until} that is {rows:N0} rows of samples, one for each instant and body, and at most"
                    + $" {MaxSampleRows:N0} are allowed."));
        }
    }

    private static RunSummary Run(ToolConsole console, Request request, bool isBarShown)
    {
        (Scene scene, SimDuration length) = (request.Scene, request.Length);
        if (request.Folder is string folder)
        {
            OutputFolder.ThrowIfNotWritable(folder);
            Directory.CreateDirectory(folder); // tables are written during the run
        }

        // The run that is written, the timed runs, with a warm-up if the first run was too short for one, and a run for the chart.
        double once = length.ToSeconds();
        double timing = request.Timed == 0 ? 0 : once * (request.Timed + 1);
        double picture = request.Folder is null ? 0 : once;
        return console.WithProgress($"run {scene.Name}", once + timing + picture, progress =>
        {
            double start = SceneEnergy.Of(new Simulation(scene, new SimulationOptions(cancellation: console.Stop)), SimTime.Zero);
            long began = Stopwatch.GetTimestamp();
            Simulation end = Write(console, request, done => progress(done.ToSeconds()));
            double written = Lap(ref began);
            double wall = request.Timed == 0 ? written : SceneRun.MinSeconds(
                scene, length, request.Timed, done => progress(once + done), isWarm: written > LongEnoughToWarmUp, request.History, console.Stop);
            double timed = Lap(ref began);
            RunSummary summary = new(end, SimTime.Zero + length, start, SceneEnergy.Of(end, SimTime.Zero + length), wall)
            {
                Timed = request.Timed,
                WritingSeconds = written,
                TimingSeconds = timed,
            };
            if (request.Folder is not null)
            {
                RunReport.Write(request.Folder, scene, summary, request.Seed, request.SampleFile, request.History, done => progress(once + timing + done.ToSeconds()));
                summary = summary with { DrawingSeconds = Lap(ref began) };
            }

            return summary;
        }, isBarShown);
    }

    private static double Lap(ref long began)
    {
        double seconds = Stopwatch.GetElapsedTime(began).TotalSeconds;
        began = Stopwatch.GetTimestamp();
        return seconds;
    }

    private static Simulation Write(ToolConsole console, Request request, Action<SimDuration> progress)
    {
        Scene scene = request.Scene;
        using ResultFile? eventOutput = ResultFile.Open(console, "--events", request.EventFile);
        using ResultFile? sampleOutput = ResultFile.Open(console, "--samples", request.SampleFile);
        CsvFile? eventCsv = eventOutput is null ? null : new CsvFile(
            eventOutput.Writer, "time_s", "kind", "body", "other", "x_m", "y_m", "z_m", "vx_m_per_s", "vy_m_per_s", "vz_m_per_s");
        bool canTurn = RunOutput.CanTurn(scene);
        CsvFile? sampleCsv = sampleOutput is null ? null : new CsvFile(
            sampleOutput.Writer,
            [
                "time_s", "body", "x_m", "y_m", "z_m", "vx_m_per_s", "vy_m_per_s", "vz_m_per_s", "motion",
                .. canTurn ? ["spin_x_rad_per_s", "spin_y_rad_per_s", "spin_z_rad_per_s"] : Array.Empty<string>(),
            ]);
        return new SceneRun(scene)
        {
            Cancellation = console.Stop,
            History = request.History,
            SampleEverySeconds = request.Every,
            OnEvent = eventCsv is null ? null : e => eventCsv.WriteRow(
                [e.Key.Time.ToSeconds(), e.Kind, scene.Bodies[e.Body.Index].Name, e.Other, .. Numbers(e.State)]),
            OnSample = sampleCsv is null ? null : (time, simulation) => Sample(sampleCsv, scene, simulation, time, canTurn),
        }.Run(request.Length, progress);
    }

    private static void Sample(CsvFile csv, Scene scene, Simulation simulation, SimTime time, bool canTurn)
    {
        for (int body = 0; body < scene.Bodies.Count; body++)
        {
            simulation.TryRead(BodyId.OfScene(body), time, out BodyState state);
            csv.WriteRow(
                [time.ToSeconds(), scene.Bodies[body].Name, .. Numbers(state), MotionNames.Of(state.Motion), .. canTurn ? Spin(state) : []]);
        }
    }

    private static IEnumerable<object?> Numbers(BodyState state) =>
        [state.Position.X, state.Position.Y, state.Position.Z, state.Velocity.X, state.Velocity.Y, state.Velocity.Z];

    private static IEnumerable<object?> Spin(BodyState state) => [state.Spin.X, state.Spin.Y, state.Spin.Z];

    /// <summary>The request: timed a number of times, 0 for a run that only streams.</summary>
    private sealed record Request(
        Scene Scene, SimDuration Length, string? EventFile, string? SampleFile, double Every, int Timed, string? Folder, ulong Seed, SimDuration History);
}
