using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Reports;
using LagSim.Harness.SceneFiles;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Scenes;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>The end of a run, as JSON and as a table.</summary>
internal static class RunOutput
{
    internal static void WriteJson(TextWriter output, Scene scene, RunSummary run, ulong seed) =>
        JsonDocumentWriter.Write(output, "run", seed, scene.Name, scene.Hash, run.End.StateHash(run.Until), json =>
        {
            json.WriteNumber("until_s", run.Until.ToSeconds());
            json.WriteNumber("events", run.End.EventsProcessed);
            json.WriteNumber("impacts", run.End.ImpactsProcessed);
            json.WriteString("event_hash", JsonDocumentWriter.Hash(run.End.EventHash(run.Until)));
            json.WriteNumber("wall_s", run.WallSeconds);
            json.WriteNumber("written_run_wall_s", run.WritingSeconds);
            json.WriteNumber("timed_runs_wall_s", run.TimingSeconds);
            json.WriteNumber("picture_wall_s", run.DrawingSeconds);
            json.WriteStartObject("energy_j");
            json.WriteNumber("start", run.StartEnergy);
            json.WriteNumber("end", run.EndEnergy);
            json.WriteEndObject();
            json.WriteString("energy_without_potential", SceneEnergy.WithoutPotential(scene));
            bool canTurn = CanTurn(scene);
            json.WriteStartArray("bodies");
            for (int body = 0; body < scene.Bodies.Count; body++)
            {
                run.End.TryRead(BodyId.OfScene(body), run.Until, out BodyState state);
                json.WriteStartObject();
                json.WriteString("name", scene.Bodies[body].Name);
                Vector(json, "position_m", state.Position);
                Vector(json, "velocity_m_per_s", state.Velocity);
                json.WriteString("motion", MotionNames.Of(state.Motion));
                if (canTurn)
                {
                    Vector(json, "spin_rad_per_s", state.Spin);
                }

                json.WriteEndObject();
            }

            json.WriteEndArray();
            WriteLost(json, scene, run.End);
            CommittedWorld.Write(json, scene, new CommittedWorld(run.End, run.Until));
        });

    internal static void WriteTable(ToolConsole console, Scene scene, RunSummary run, ulong seed)
    {
        console.Rich.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"lagsim {ToolVersion.Text}   run {scene.Name}   seed {seed}   scene {scene.Hash:x16}   state {run.End.StateHash(run.Until):x16}   events"
                + $" {run.End.EventHash(run.Until):x16}"));
        console.Rich.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"{run.Until.ToSeconds():0.#########} s, {NumberText.Count(run.End.EventsProcessed, "event")},"
                + $" {NumberText.Count(run.End.ImpactsProcessed, "impact")}; "
            + $"energy {NumberText.Short(run.StartEnergy)} J at the start, {NumberText.Short(run.EndEnergy)} J at the end"));
        if (SceneEnergy.WithoutPotential(scene) is string clauses)
        {
            console.Rich.WriteLine($"of energy: {clauses}");
        }

        console.Rich.WriteLine(Times(run));
        bool canTurn = CanTurn(scene);
        Table table = new Table { Border = TableBorder.Rounded }.AddColumns(
            ["body", "position (m)", "velocity (m/s)", "motion", .. canTurn ? ["spin (rad/s)"] : System.Array.Empty<string>()]);
        for (int body = 0; body < scene.Bodies.Count; body++)
        {
            run.End.TryRead(BodyId.OfScene(body), run.Until, out BodyState state);
            table.AddRow(
                [Markup.Escape(scene.Bodies[body].Name), Text(state.Position), Text(state.Velocity), MotionNames.Of(state.Motion),
                    .. canTurn ? [Text(state.Spin)] : System.Array.Empty<string>()]);
        }

        console.Write(table);
        foreach (LostBody lost in run.End.LostBodies())
        {
            console.Rich.WriteLine(lost.ToString());
        }

        if (new CommittedWorld(run.End, run.Until).RulesLine is string rules)
        {
            console.Rich.WriteLine(rules);
        }
    }

    /// <summary>The bodies that have left the world; nothing where none has.</summary>
    private static void WriteLost(Utf8JsonWriter json, Scene scene, Simulation end)
    {
        IReadOnlyList<LostBody> bodies = end.LostBodies();
        if (bodies.Count == 0)
        {
            return;
        }

        json.WriteStartArray("lost");
        foreach (LostBody lost in bodies)
        {
            json.WriteStartObject();
            json.WriteString("name", scene.Bodies[lost.Body.Index].Name);
            json.WriteNumber("time_s", lost.Time.ToSeconds());
            json.WriteString("reason", lost.Reason.ToString().ToLowerInvariant());
            json.WriteString("text", lost.ToString());
            json.WriteEndObject();
        }

        json.WriteEndArray();
    }

    /// <summary>Whether any body of the scene can turn: by its initial spin, or by friction.</summary>
    internal static bool CanTurn(Scene scene) => scene.Bodies.Any(body => body.Spin != Vector3D.Zero || body.Spec.Friction > 0);

    /// <summary>The time spent: on the simulation alone, and on the report.</summary>
    private static string Times(RunSummary run)
    {
        if (run.Timed == 0)
        {
            string drawn = run.DrawingSeconds > 0 ? $", and picture {NumberText.Short(run.DrawingSeconds)} s" : "";
            return $"{NumberText.Short(run.WallSeconds)} s for the run and its files, not timed apart{drawn}";
        }

        string least = run.Timed == 1 ? "timed once" : $"the least of {NumberText.Count(run.Timed, "run")}";
        string picture = run.DrawingSeconds > 0 ? $", picture {NumberText.Short(run.DrawingSeconds)} s" : "";
        double all = run.WritingSeconds + run.TimingSeconds + run.DrawingSeconds;
        return $"{NumberText.Short(run.WallSeconds)} s to simulate, {least} after a warm-up; in all {NumberText.Short(all)} s: run and files"
            + $" {NumberText.Short(run.WritingSeconds)} s, timing {NumberText.Short(run.TimingSeconds)} s{picture}";
    }

    private static string Text(in Vector3D v) => $"{NumberText.Short(v.X)}  {NumberText.Short(v.Y)}  {NumberText.Short(v.Z)}";

    private static void Vector(Utf8JsonWriter json, string key, in Vector3D v)
    {
        json.WriteStartArray(key);
        json.WriteNumberValue(v.X);
        json.WriteNumberValue(v.Y);
        json.WriteNumberValue(v.Z);
        json.WriteEndArray();
    }
}
