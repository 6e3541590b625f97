using System;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.Cli.DropCommandTests;

namespace LagSim.Tests.Cli;

public sealed class RunCommandTests
{
    private const string EventColumns = "time_s,kind,body,other,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s";
    private const string SampleColumns = "time_s,body,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,motion";

    [Theory]
    [InlineData("drop", 1)]
    [InlineData("pair", 2)]
    public void Json_OfARun_HasTheKeysOfTheContract(string scene, int bodies)
    {
        JsonElement document = Json("run", scene, "--json");
        string[] keys = Keys(document).ToArray();
        Assert.Equal(["tool", "version", "command", "seed", "scene", "scene_hash", "state_hash"], keys.Take(7));
        Assert.Empty(new[] { "until_s", "events", "impacts", "wall_s", "energy_j", "bodies" }.Except(keys));
        Assert.Equal(["start", "end"], Keys(document.GetProperty("energy_j")));
        Assert.Equal(10, document.GetProperty("until_s").GetDouble());
        Assert.Matches("^[0-9a-f]{16}$", Text(document, "state_hash"));
        JsonElement[] all = document.GetProperty("bodies").EnumerateArray().ToArray();
        Assert.Equal(bodies, all.Length);
        Assert.All(all, body => Assert.Equal(["name", "position_m", "velocity_m_per_s", "motion"], Keys(body)));
        Assert.All(all, body => Assert.Equal((3, 3), (body.GetProperty("position_m").GetArrayLength(), body.GetProperty("velocity_m_per_s").GetArrayLength())));
    }

    [Fact]
    public void Text_OfARun_SaysWhatTheTimeWentInto()
    {
        using TemporaryFolder folder = new();
        string once = Tool.Run("run", "drop").Done().Output, drawn = Tool.Run("run", "drop", "--repeat", "3", "--out", folder["out"]).Done().Output;
        const string Number = "[0-9.e-]+ s";
        Assert.Matches($"(?m)^{Number} to simulate, timed once after a warm-up; in all {Number}: run and files {Number}, timing {Number}\\s*$", once);
        Assert.Matches($"(?m)^{Number} to simulate, the least of 3 runs after a warm-up; in all .*, timing {Number}, picture {Number}\\s*$", drawn);
        JsonElement document = Json("run", "drop", "--repeat", "2", "--json");
        Assert.InRange(document.GetProperty("timed_runs_wall_s").GetDouble(), document.GetProperty("wall_s").GetDouble(), double.MaxValue);
        Assert.True(document.GetProperty("written_run_wall_s").GetDouble() > 0);
        Assert.Equal(0, document.GetProperty("picture_wall_s").GetDouble());
    }

    [Fact]
    public void Repeat_Zero_RunsOnceAndSaysSo()
    {
        Assert.Matches(@"(?m)^[0-9.e-]+ s for the run and its files, not timed apart\s*$", Tool.Run("run", "drop", "--repeat", "0").Done().Output);
        JsonElement document = Json("run", "drop", "--repeat", "0", "--json");
        Assert.Equal(document.GetProperty("written_run_wall_s").GetDouble(), document.GetProperty("wall_s").GetDouble());
        Assert.InRange(document.GetProperty("timed_runs_wall_s").GetDouble(), 0, 1e-3); // between two looks at the clock
    }

    /// <summary>What is kept of the past, and so how far the run goes at a time, changes no event of it.</summary>
    [Theory]
    [InlineData("crowd")]
    [InlineData("billiards")]
    public void History_OfAnyLength_TellsTheSameEvents(string scene)
    {
        string[] told = [.. new[] { "1e6", "1", "1e-3", "1e-6" }.Select(history =>
            Tool.Run("run", scene, "--until-s", "1.5", "--events", "-", "--history-s", history).Done().Output)];
        Assert.All(told, one => Assert.Equal(told[0], one));
        Assert.True(told[0].Split('\n').Length > 100);
    }

    [Fact]
    public void Energy_OfASpringAndAPull_HasTheirPotentials()
    {
        using TemporaryFolder folder = new();
        string scene = folder["pulled.json"];
        File.WriteAllText(scene, """
            {"format": "lagsim-scene-1", "name": "pulled", "gravity_m_per_s2": [0, 0, 0],
             "forces": [{"name": "spring", "kind": "spring", "anchor_m": [0, 0, 0], "stiffness_n_per_m": 100},
                        {"name": "sun", "kind": "central", "centre_m": [100, 0, 0], "strength_m_per_s2": 8, "power": -2}],
             "bodies": [{"name": "hung", "radius_m": 0.1, "mass_kg": 1, "restitution": 1, "position_m": [1, 0, 0], "forces": ["spring"]},
                        {"name": "planet", "radius_m": 0.1, "mass_kg": 3, "restitution": 1, "position_m": [102, 0, 0], "velocity_m_per_s": [0, 1.5, 0], "forces": ["sun"]}]}
            """);
        JsonElement document = Json("run", scene, "--until-s", "0.15707963267948966", "--repeat", "0", "--json"), energy = document.GetProperty("energy_j");
        Assert.Equal(50 + (3 * (1.125 - 4)), energy.GetProperty("start").GetDouble(), 1e-12);
        Assert.Equal(energy.GetProperty("start").GetDouble(), energy.GetProperty("end").GetDouble(), 1e-9);
        Assert.InRange(document.GetProperty("bodies")[0].GetProperty("position_m")[0].GetDouble(), -1e-9, 1e-9); // else nothing became of the spring's energy
        Assert.Equal(JsonValueKind.Null, document.GetProperty("energy_without_potential").ValueKind);

        // The control: what has no potential is named.
        File.WriteAllText(scene, File.ReadAllText(scene).Replace("\"stiffness_n_per_m\": 100", "\"stiffness_n_per_m\": 100, \"damping_kg_per_s\": 1", StringComparison.Ordinal));
        Assert.Equal("the damper of spring 'spring' takes energy", Text(Json("run", scene, "--repeat", "0", "--json"), "energy_without_potential"));
        Assert.Contains("of energy: the damper of spring 'spring' takes energy", Tool.Run("run", scene, "--repeat", "0").Done().Output, StringComparison.Ordinal);
    }

    [Fact]
    public void Spin_WhereSomethingCanTurn_IsInTableJsonAndSamples()
    {
        using TemporaryFolder folder = new();
        string scene = folder["roll.json"];
        File.WriteAllText(scene, """
            {"format": "lagsim-scene-1", "name": "roll", "planes": [{"name": "floor", "normal": [0, 1, 0], "offset_m": 0}],
             "bodies": [{"name": "ball", "radius_m": 0.5, "mass_kg": 1, "restitution": 0, "friction": 0.5, "position_m": [0, 0.5, 0], "velocity_m_per_s": [7, 0, 0]}]}
            """);
        JsonElement spin = Json("run", scene, "--until-s", "2", "--repeat", "0", "--json").GetProperty("bodies")[0].GetProperty("spin_rad_per_s");
        Assert.Equal(-10, spin[2].GetDouble(), 1e-6); // it rolls with five sevenths of its speed
        Assert.Contains("spin (rad/s)", Tool.Run("run", scene, "--repeat", "0").Done().Output, StringComparison.Ordinal);
        string[][] rows = Csv(
            Tool.Run("run", scene, "--until-s", "2", "--every-s", "1", "--samples", "-").Done().Output,
            SampleColumns + ",spin_x_rad_per_s,spin_y_rad_per_s,spin_z_rad_per_s");
        Assert.Equal(spin[2].GetDouble(), Number(rows[^1][11]));
        Assert.DoesNotContain("spin", Tool.Run("run", "drop", "--repeat", "0").Done().Output, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("crowd-007", "N is written without leading zeros: crowd-7")]
    [InlineData("crowd-0", "N is a whole number from 1 to 100000, such as crowd-200")]
    [InlineData("crowds", "nor a file that exists")]
    public void Scene_NameThatIsNone_SaysWhatToWrite(string name, string says) => Tool.Refuses(3, ["run", name], $"{name}: this is neither a built-in scene", says);

    [Fact]
    public void Json_OfARun_AgreesWithTheSimulationItself()
    {
        JsonElement document = Json("run", "drop", "--until-s", "7.25", "--motion", "ballistic", "--json");
        Simulation simulation = TestWorlds.Run(BuiltInScenes.Drop(law: MotionLaw.Ballistic), 7.25);
        Assert.Equal($"{simulation.StateHash(TestWorlds.At(7.25)):x16}", Text(document, "state_hash"));
        Assert.Equal($"{simulation.Scene.Hash:x16}", Text(document, "scene_hash"));
        Assert.Equal(simulation.ImpactsProcessed, document.GetProperty("impacts").GetInt64());
        Assert.Equal(TestWorlds.Energy(simulation, TestWorlds.At(7.25)), document.GetProperty("energy_j").GetProperty("end").GetDouble());
        Assert.Equal(98.1, document.GetProperty("energy_j").GetProperty("start").GetDouble(), 1e-12);
    }

    [Fact]
    public void Events_OnStdout_HaveTheColumnsOfTheContractAndNothingElse()
    {
        string[][] rows = Csv(Tool.Run("run", "drop", "--motion", "ballistic", "--until-s", "20", "--events", "-").Done().Output, EventColumns);
        Assert.Equal("rest", rows[^1][1]);
        Assert.All(rows.SkipLast(1), row => Assert.Equal(("impact", "ball", "floor"), (row[1], row[2], row[3])));
        Assert.Equal("", rows[^1][3]);
        double[] times = rows.Select(row => Number(row[0])).ToArray();
        Assert.Equal(times.Order(), times);
        TestWorlds.Near(Math.Sqrt(2 * 9.5 / 9.81), times[0], 1e-11);
        TestWorlds.Near(0.8 * Math.Sqrt(2 * 9.5 * 9.81), Number(rows[0][8]), 1e-10);
        Assert.Equal("0.5", rows[^1][5]);
    }

    [Fact]
    public void Events_OfAMeetingInFlight_HaveARowForEachOfTheTwo()
    {
        string[][] rows = Csv(Tool.Run("run", "pair", "--until-s", "1", "--events", "-").Done().Output, EventColumns);
        string[][] meeting = rows.Where(row => row[3] is "light" or "heavy").ToArray();
        Assert.Equal(["heavy", "light"], meeting.Select(row => row[2]).Order());
        Assert.Single(meeting.Select(row => row[0]).Distinct());
        Assert.All(meeting, row => Assert.NotEqual(row[2], row[3]));
    }

    [Fact]
    public void Samples_OnStdout_HaveTheColumnsOfTheContractAndNothingElse()
    {
        string[][] rows = Csv(Tool.Run("run", "pair", "--until-s", "0.5", "--every-s", "0.1", "--samples", "-").Done().Output, SampleColumns);
        Assert.Equal(12, rows.Length); // two bodies, the start included
        Assert.Equal(["light", "heavy"], rows.Take(2).Select(row => row[1]));
        Assert.All(rows, row => Assert.Equal("ballistic", row[8]));
        Simulation simulation = TestWorlds.Run(BuiltInScenes.Pair(), 0.5);
        TestWorlds.Near(TestWorlds.Read(simulation, TestWorlds.First, 0.5).Position, new Vector3D(Number(rows[10][2]), Number(rows[10][3]), Number(rows[10][4])), 1e-11);
        Assert.Equal(TestWorlds.Read(simulation, TestWorlds.First, 0).Position, new Vector3D(Number(rows[0][2]), Number(rows[0][3]), Number(rows[0][4])));
    }

    [Theory]
    [InlineData("rk4")]
    [InlineData("ballistic")]
    public void Motion_Chosen_IsThatOfAllBodies(string motion)
    {
        string[][] rows = Csv(Tool.Run("run", "pair", "--until-s", "0.1", "--motion", motion, "--samples", "-").Done().Output, SampleColumns);
        Assert.All(rows, row => Assert.Equal(motion, row[8]));
    }

    [Fact]
    public void Samples_OrEventsAskedFor_DoNotChangeTheRun()
    {
        string plain = Hash();
        Assert.Equal(plain, Hash("--every-s", "0.0371"));
        Assert.Equal(plain, Hash("--repeat", "3"));
        Assert.NotEqual(plain, Hash("--until-s", "5"));

        string Hash(params string[] more)
        {
            using TemporaryFolder folder = new();
            return Text(Json(["run", "pair", "--json", "--samples", folder["s.csv"], "--events", folder["e.csv"], .. more]), "state_hash");
        }
    }

    [Fact]
    public void Out_OfARun_HasPicturesNumbersAndAPageThatShowsThem()
    {
        using TemporaryFolder folder = new();
        Tool.Run("run", "pair", "--until-s", "3", "--out", folder["new"]).Done();
        Assert.Equal(
            ["events.csv", "heights.svg", "report.html", "samples.csv"],
            Directory.GetFiles(folder["new"]).Select(file => Path.GetFileName(file)!).Order(StringComparer.Ordinal));
        Assert.True(Csv(File.ReadAllText(folder["new/events.csv"]), EventColumns).Length > 3);
        Assert.Equal(602, Csv(File.ReadAllText(folder["new/samples.csv"]), SampleColumns).Length);
        Assert.Contains("<svg", File.ReadAllText(folder["new/report.html"]), StringComparison.Ordinal);
    }

    [Fact]
    public void Out_OfARunOfNoLength_StillHasAPage()
    {
        using TemporaryFolder folder = new();
        Tool.Run("run", "pair", "--until-s", "0", "--out", folder["new"]).Done();
        Assert.True(File.Exists(folder["new/report.html"]));
    }

    [Fact]
    public void Numbers_InAnotherCulture_AreTheSame()
    {
        string[][] calls = [["run", "pair", "--until-s", "1.5", "--events", "-"], ["run", "pair", "--until-s", "1.5", "--samples", "-"], ["scenes", "pair"], ["run", "drop", "--until-s", "-0.5"]];
        string[] expected = calls.Select(call => Tool.Run(call)).Select(tool => tool.Output + tool.Error).ToArray();
        Assert.Equal(expected, WithComma(() => calls.Select(call => Tool.Run(call)).Select(tool => tool.Output + tool.Error).ToArray()));
    }

    [Theory]
    [InlineData("drop")]
    [InlineData("pair")]
    public void Scenes_PrintedAndReadAgain_IsTheSameScene(string name)
    {
        using TemporaryFolder folder = new();
        string text = Tool.Run("scenes", name).Done().Output;
        File.WriteAllText(folder["mine.json"], text);
        Assert.Equal(text, Tool.Run("scenes", folder["mine.json"]).Done().Output);
        JsonElement built = Json("run", name, "--json"), read = Json("run", folder["mine.json"], "--json");
        Assert.Equal(Text(built, "scene_hash"), Text(read, "scene_hash"));
        Assert.Equal(Text(built, "state_hash"), Text(read, "state_hash"));

        // The control: an edited one is another.
        File.WriteAllText(folder["mine.json"], text.Replace("9.81", "9.82", StringComparison.Ordinal));
        Assert.NotEqual(Text(built, "state_hash"), Text(Json("run", folder["mine.json"], "--json"), "state_hash"));
    }

    [Fact]
    public void Scenes_IntoAFolder_AreTheSameText()
    {
        using TemporaryFolder folder = new();
        Assert.Equal("", Tool.Run("scenes", "drop", "--out", folder["new"]).Done().Output);
        Assert.Equal(Tool.Run("scenes", "drop").Output.TrimEnd(), File.ReadAllText(folder["new/drop.json"]).TrimEnd());
    }

    [Fact]
    public void Scenes_Listed_NameEveryBuiltInScene()
    {
        string table = Tool.Run("scenes").Done().Output;
        Assert.All(BuiltInScenes.Names, name => Assert.Contains(name, table, StringComparison.Ordinal));
        JsonElement list = Json("scenes", "--json");
        Assert.Equal(BuiltInScenes.Names, list.GetProperty("scenes").EnumerateArray().Select(scene => Text(scene, "name")));
        Assert.Equal(["tool", "version", "command", "seed", "scene", "scene_hash", "state_hash"], Keys(list).Take(7));
    }

    [Fact]
    public void Table_OfARun_GoesToStdoutAndProgressToStderr()
    {
        Tool tool = Tool.Run("run", "pair", "--until-s", "1").Done();
        Assert.Contains("light", tool.Output, StringComparison.Ordinal);
        Assert.Equal("run pair ...", tool.Error.Trim());
    }

    [Theory]
    [InlineData("--events")]
    [InlineData("--samples")]
    public void File_ThatCannotBeWritten_IsNamedWithTheOptionAndTheCause(string option)
    {
        using TemporaryFolder folder = new();
        string file = folder["missing/deep/a.csv"], kept = folder["kept"];
        Tool.Refuses(3, ["run", "pair", option, file], $"{option} is '{file}'; it must be a file that can be written. There is no folder '{folder["missing"]}'.");
        File.WriteAllText(kept, "");
        Tool.Refuses(3, ["run", "pair", option, kept + "/a.csv"], $"{option} is '{kept}/a.csv'; it must be a file that can be written. '{kept}' is a file, not a folder.");
        Assert.Equal([kept], Directory.GetFileSystemEntries(folder.Path));
        if (OperatingSystem.IsLinux())
        {
            Tool.Refuses(3, ["run", "pair", option, "/proc/zz"], $"{option} is '/proc/zz'; it must be a file that can be written. The file system at '/proc' lets nothing be made there.");
            Tool.Refuses(3, ["run", "pair", "--out", "/proc/zz"], "--out is '/proc/zz'; it must be a folder that can be made and written to. The file system at '/proc' lets nothing be made there.");
        }
    }

    [Fact]
    public void Run_OfABodyThatLeavesTheWorld_TellsIt()
    {
        using TemporaryFolder folder = new();
        string scene = folder["fall.json"];
        File.WriteAllText(scene, """{"format": "lagsim-scene-1", "name": "fall", "bodies": [{"name": "the stone", "radius_m": 1e-9, "mass_kg": 1, "restitution": 1, "position_m": [0, 0, 0]}]}""");
        Assert.Contains("body 'the stone' (0.0.0) cannot be followed any further", Tool.Run("run", scene, "--until-s", "60").Done().OutputOnOneLine, StringComparison.Ordinal);
        using JsonDocument json = JsonDocument.Parse(Tool.Run("run", scene, "--until-s", "60", "--json").Done().Output);
        JsonElement lost = Assert.Single(json.RootElement.GetProperty("lost").EnumerateArray());
        Assert.Equal(("the stone", "toofast"), (lost.GetProperty("name").GetString(), lost.GetProperty("reason").GetString()));
        Assert.DoesNotContain("\"lost\"", Tool.Run("run", "pair", "--json").Done().Output, StringComparison.Ordinal); // the control
    }

    private static double Number(string field) => double.Parse(field, NumberStyles.Float, CultureInfo.InvariantCulture);

    private static string[][] Csv(string text, string columns)
    {
        string[] lines = text.Split("\r\n");
        Assert.Equal(columns, lines[0]);
        Assert.Equal("", lines[^1]);
        string[][] rows = lines[1..^1].Select(line => line.Split(',')).ToArray();
        Assert.All(rows, row => Assert.Equal(columns.Split(',').Length, row.Length));
        foreach (string number in rows.SelectMany(row => row).Where(field => field.Length > 0 && (char.IsAsciiDigit(field[0]) || field[0] == '-')))
        {
            Assert.Equal(number, Number(number).ToString("R", CultureInfo.InvariantCulture));
        }

        return rows;
    }

    [Fact]
    public void Run_OneFileForTwoThings_IsRefused()
    {
        string scene = Path.Combine(Path.GetTempPath(), $"lagsim-run-{Guid.NewGuid():N}.json");
        try
        {
            Assert.Equal(0, Tool.Run("scenes", "drop", "--out", Path.GetDirectoryName(scene)!).ExitCode);
            File.Move(Path.Combine(Path.GetDirectoryName(scene)!, "drop.json"), scene, overwrite: true);
            string before = File.ReadAllText(scene);

            Tool.Refuses(2, ["run", "pair", "--events", scene, "--samples", scene], "--events", "--samples", "different files");
            Tool.Refuses(2, ["run", scene, "--samples", scene], "SCENE", "--samples", "different files");
            Tool.Refuses(2, ["run", "pair", "--out", scene], "--out", "folder");

            Assert.Equal(before, File.ReadAllText(scene));
        }
        finally
        {
            File.Delete(scene);
        }
    }
}
