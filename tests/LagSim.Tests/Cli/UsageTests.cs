using System;
using System.IO;
using System.Linq;
using LagSim.Testing.Links;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>What the tool refuses, and with what sentence.</summary>
public sealed class UsageTests
{
    private const int Usage = 2;
    private const int Input = 3;

    [Theory]
    [InlineData("--rate-hz", "NaN", "between 1 and 10000")]
    [InlineData("--rate-hz", "0.5", "between 1 and 10000")]
    [InlineData("--rate-hz", "Infinity", "between 1 and 10000")]
    [InlineData("--rate-hz", "fast", "between 1 and 10000")]
    [InlineData("--delay-ms", "-1", "between 0 and 2000")]
    [InlineData("--delay-ms", "NaN", "between 0 and 2000")]
    [InlineData("--delay-ms", "2000.1", "between 0 and 2000")]
    [InlineData("--delay-ms", "2,5", "between 0 and 2000")]
    [InlineData("--peers", "1", "between 2 and 9")]
    [InlineData("--peers", "10", "between 2 and 9")]
    [InlineData("--peers", "2.5", "between 2 and 9")]
    [InlineData("--peers", "99999999999", "between 2 and 9")]
    [InlineData("--height-m", "0.49", "between 0.5 and 1000000")]
    [InlineData("--height-m", "-Infinity", "between 0.5 and 1000000")]
    [InlineData("--second-height-m", "nan", "between 0.5 and 1000000")]
    [InlineData("--second-height-m", "1e7", "between 0.5 and 1000000")]
    [InlineData("--restitution", "1.0001", "between 0 and 1")]
    [InlineData("--restitution", "-0.1", "between 0 and 1")]
    [InlineData("--restitution", "", "between 0 and 1")]
    [InlineData("--display-delay-ms", "5000.1", "between 0 and 5000")]
    [InlineData("--seed", "-1", "between 0 and 18446744073709551615")]
    [InlineData("--seed", "1.5", "between 0 and 18446744073709551615")]
    [InlineData("--seed", "18446744073709551616", "between 0 and 18446744073709551615")]
    public void Drop_NumberOutOfRange_IsRefusedWithOptionValueAndRange(string option, string value, string range) =>
        Tool.Refuses(Usage, ["drop", "--time", "virtual", option, value], option, $"'{value}'", range);

    [Theory]
    [InlineData("--case", "both", "same-start")]
    [InlineData("--strategy", "healin", "healing")]
    [InlineData("--motion", "euler", "ballistic")]
    [InlineData("--time", "now", "virtual")]
    [InlineData("--transport", "tcp", "udp")]
    public void Drop_UnknownWord_IsRefusedWithTheWordsThereAre(string option, string value, string known) =>
        Tool.Refuses(Usage, ["drop", option, value], $"{option} is '{value}'; it must be one of ", known, "Try 'lagsim drop --help'.");

    [Theory]
    [InlineData("--events")]
    [InlineData("--samples")]
    public void Run_FolderForAFile_IsRefused(string option)
    {
        using TemporaryFolder folder = new();
        Tool.Refuses(Usage, ["run", "drop", option, folder.Path], $"{option} is '{folder.Path}'", "it must be a file");
    }

    [Fact]
    public void Drop_Help_NamesEveryLinkProfileAndAnyDelay()
    {
        string help = Tool.Run("drop", "--help").Done().OutputOnOneLine;
        Assert.All(LinkProfiles.All, profile => Assert.Contains($" {profile.Name},", help, StringComparison.Ordinal));
        Assert.Contains("or delay-Nms for any N from 0 to 2000.", help, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("run", true)]
    [InlineData("replay", true)]
    [InlineData("accuracy", true)]
    [InlineData("drop", false)]
    [InlineData("check", false)]
    [InlineData("hard", false)]
    public void Seed_WhereNothingIsDrawn_SaysSoInTheHelp(string command, bool isIdle) =>
        Assert.Equal(
            isIdle, Tool.Run(command, "--help").Done().OutputOnOneLine.Contains("nothing here is random", StringComparison.Ordinal));

    [Fact]
    public void Help_OfAnOptionThatHasNoEffectOnSome_SaysSo()
    {
        string help = Tool.Run("drop", "--help").OutputOnOneLine;
        Assert.Contains("Steps per second of rk4; ballistic motion has none", help, StringComparison.Ordinal);
        Assert.Contains("an existing file is replaced", Tool.Run("host", "--help").OutputOnOneLine, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("drop", "--restitution", "2", "--restitution is '2'")]
    [InlineData("run", "--until-s", "x", "--until-s is 'x'")]
    [InlineData("compare", "--profile", "moon", "There is no link profile 'moon'")]
    public void Json_OfACallThatIsRefused_IsADocumentWithTheError(string command, string option, string value, string says) =>
        Tool.Refuses(Usage, command == "run" ? [command, "drop", option, value, "--json"] : [command, option, value, "--json"], says);

    [Fact]
    public void WordThatIsNoCommand_IsSaidToBeNoneAndNothingElse()
    {
        Tool tool = Tool.Run("foo");
        Assert.Equal(Usage, tool.ExitCode);
        Assert.Equal(["Unrecognized command or argument 'foo'.", "Try 'lagsim --help'."], tool.Error.Split(Environment.NewLine, StringSplitOptions.RemoveEmptyEntries));
    }

    [Theory]
    [InlineData("run pair --for-s 3", "run has no option '--for-s'; here it is --until-s.")]
    [InlineData("host --scene pair --until-s 3", "host has no option '--until-s'; here it is --for-s.")]
    public void LengthByTheOtherName_IsToldTheRightOne(string line, string says) => Tool.Refuses(Usage, line.Split(' '), says);

    [Fact]
    public void RecordingThatIsNotThere_IsToldInTheToolsOwnWords()
    {
        Tool.Refuses(3, ["diff", "no-such-a", "no-such-b"], "'no-such-a' cannot be read as a recording: there is no such file.");
        Tool.Refuses(3, ["replay", "no-such-a", "--json"], "'no-such-a' cannot be read as a recording: there is no such file.");
    }

    [Fact]
    public void Json_OfAnInputThatIsNone_HasTheSeedThatWasGiven()
    {
        Tool tool = Tool.Run("run", "no-such-scene", "--json", "--seed", "7");
        using System.Text.Json.JsonDocument document = System.Text.Json.JsonDocument.Parse(tool.Output);
        Assert.Equal((3, 7UL), (tool.ExitCode, document.RootElement.GetProperty("seed").GetUInt64()));
        Assert.Contains(document.RootElement.GetProperty("error").GetString()!, tool.Error, StringComparison.Ordinal);
    }

    [Fact]
    public void Scenes_OutWithoutAScene_IsRefused() => Tool.Refuses(Usage, ["scenes", "--out", "never-made"], "'never-made'", "NAME");

    [Theory]
    [InlineData("../evil")]
    [InlineData("a/b")]
    public void Scenes_NameThatIsNoFiles_IsRefused(string name)
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["mine.json"], $"{{\"format\": \"lagsim-scene-1\", \"name\": \"{name}\"}}");
        Tool.Refuses(Usage, ["scenes", folder["mine.json"], "--out", folder["new/one"]], $"'{name}'", "cannot be a file's name");
        Assert.Equal([folder["mine.json"]], Directory.GetFileSystemEntries(folder.Path));
    }

    [Fact]
    public void Drop_UnknownProfile_IsRefusedWithTheProfilesThereAre() =>
        Tool.Refuses(Usage, ["drop", "--time", "virtual", "--profile", "5g-moon"], "'5g-moon'", "loopback, lan, skewed-clock", "delay-Nms");

    [Fact]
    public void Drop_DelayAndProfile_AreRefusedTogether() =>
        Tool.Refuses(Usage, ["drop", "--time", "virtual", "--delay-ms", "25", "--profile", "lan"], "--delay-ms and --profile exclude each other");

    [Theory]
    [InlineData("--until-s", "NaN", "between 0 and 1000000")]
    [InlineData("--until-s", "-1", "between 0 and 1000000")]
    [InlineData("--until-s", "1e300", "between 0 and 1000000")]
    [InlineData("--every-s", "0", "and 1000000")]
    [InlineData("--every-s", "-0.01", "and 1000000")]
    [InlineData("--every-s", "1e-10", "and 1000000")]
    [InlineData("--repeat", "-1", "between 0 and 1000000")]
    [InlineData("--repeat", "x", "between 0 and 1000000")]
    [InlineData("--seed", "one", "between 0 and")]
    public void Run_NumberOutOfRange_IsRefusedWithOptionValueAndRange(string option, string value, string range) =>
        Tool.Refuses(Usage, ["run", "drop", option, value], option, $"'{value}'", range);

    [Theory]
    [InlineData("run drop --every-s 1e-9 --samples -", "--every-s is 1E-09", "10,000,000,001 rows")]
    [InlineData("run pair --every-s 1e-6 --samples never-made.csv", "--every-s is 1E-06", "20,000,002 rows")]
    [InlineData("run drop --until-s 1e6 --out never-made", "--until-s 1000000", "100,000,001 rows")]
    public void Run_TooManySamples_IsRefusedWithTheirNumberAndWhatIsAllowed(string line, string value, string rows)
    {
        Tool.Refuses(Usage, line.Split(' '), value, rows, "at most 10,000,000 are allowed");
        Assert.False(Path.Exists("never-made") || Path.Exists("never-made.csv"));
    }

    [Fact]
    public void Run_UnknownMotion_IsRefusedWithTheWordsThereAre() => Tool.Refuses(Usage, ["run", "drop", "--motion", "verlet"], "'verlet'", "rk4", "ballistic");

    [Theory]
    [InlineData("--events", "-", "--samples", "-")]
    [InlineData("--events", "-", "--json", null)]
    [InlineData("--samples", "-", "--json", null)]
    public void Run_TwoThingsOnStdout_AreRefused(string first, string second, string third, string? fourth) =>
        Tool.Refuses(Usage, new[] { "run", "drop", first, second, third, fourth }.OfType<string>().ToArray(), "Only one of --events -, --samples - and --json");

    [Theory]
    [InlineData("--events")]
    [InlineData("--samples")]
    [InlineData("--out")]
    public void Run_EmptyName_IsRefused(string option) => Tool.Refuses(Usage, ["run", "drop", option, ""], $"{option} is ''");

    [Theory]
    [InlineData("jump", "'jump'")]
    [InlineData("drop --speed 3", "'--speed'")]
    [InlineData("drop 5", "'5'")]
    [InlineData("run", "SCENE is missing: lagsim run SCENE.")]
    [InlineData("run drop pair", "'pair'")]
    [InlineData("drop --peers", "'--peers'")]
    [InlineData("drop --peers 2 --peers 3", "--peers")]
    public void Call_ThatIsNone_IsRefusedAndPointsToTheHelp(string line, string names) => Tool.Refuses(Usage, line.Split(' '), names, "--help'.");

    [Theory]
    [InlineData("run")]
    [InlineData("scenes")]
    public void Scene_Unknown_IsRefusedWithTheScenesThereAre(string command) =>
        Tool.Refuses(Input, [command, "no-such-scene"], "no-such-scene", "drop, pair");

    [Theory]
    [InlineData("{", "line 1")]
    [InlineData("{\"format\": \"lagsim-scene-1\", \"name\": \"x\", \"colour\": 3}", "colour")]
    [InlineData("[]", "bad.json")]
    [InlineData("", "bad.json")]
    public void Scene_BadFile_IsRefusedWithItsPlace(string text, string says)
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["bad.json"], text);
        Tool.Refuses(Input, ["run", folder["bad.json"]], "bad.json", says);
        Tool.Refuses(Input, ["run", folder.Path], "folder");
    }

    [Theory]
    [InlineData("drop --time virtual --case same-start --motion ballistic --out")]
    [InlineData("compare --profile lan --strategy none --out")]
    [InlineData("run drop --until-s 1 --out")]
    [InlineData("run drop --until-s 1 --events")]
    [InlineData("run drop --until-s 1 --samples")]
    [InlineData("scenes drop --out")]
    public void Out_ThatCannotBeWritten_IsRefused(string line)
    {
        // Not even root can make something below a file.
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["file"], "");
        Tool tool = Tool.Run([.. line.Split(' '), Path.Combine(folder["file"], "below")]);
        Assert.True(tool.ExitCode == Input, $"exit code {tool.ExitCode}: {tool.Error}");
        Assert.Contains($"{line.Split(' ')[^1]} is '{Path.Combine(folder["file"], "below")}'; it must be ", tool.Error, StringComparison.Ordinal);
        Assert.Contains("is a file, not a folder.", tool.Error, StringComparison.Ordinal);
        Assert.Equal("", tool.Output);
    }

    [Theory]
    [InlineData("accuracy --quik", "--quik")]
    [InlineData("hard drop --control", "--control")]
    [InlineData("explain -json", "-json")]
    public void Option_ThatThereIsNone_IsNotTakenForAnArgument(string line, string option) => Tool.Refuses(2, line.Split(' '), $"'{option}'", "--help'.");

    [Fact]
    public void Argument_BehindTwoDashes_MayLookLikeAnOption() => Tool.Refuses(3, ["explain", "--", "--no.json"], "--no.json: this is neither a built-in scene");

    [Fact]
    public void Out_ThatCannotBeWritten_IsToldBeforeTheRun()
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["file"], "");
        Tool tool = Tool.Run("drop", "--out", Path.Combine(folder["file"], "below")); // in real time it would take half a minute
        Assert.Equal(Input, tool.ExitCode);
        Assert.DoesNotContain("...", tool.Error, StringComparison.Ordinal);
    }
}
