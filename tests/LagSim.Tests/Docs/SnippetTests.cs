using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Net;
using System.Text.RegularExpressions;
using LagSim.Cli;
using LagSim.Cli.Output;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Docs;

/// <summary>The code of the front pages compiles, line by line as it stands there, and what needs no second machine runs; the tool understands the calls of it that pages show.</summary>
[Trait("Time", "real")]
public sealed partial class SnippetTests
{
    private static readonly string Compiled = Read("tests/LagSim.Tests/Docs/Snippets.cs") + Read("tests/LagSim.Tests/Docs/ForceSnippets.cs") + Read("tests/LagSim.Tests/Docs/RuleSnippets.cs")
        + Read("tests/LagSim.Tests/Docs/LiteNetLibSnippets.cs") + Read("tests/LagSim.Tests/Docs/WebSocketSnippets.cs") + Read("tests/LagSim.Tests/Docs/SecuritySnippets.cs")
        + Read("tests/LagSim.Tests/Docs/SensorSnippets.cs") + Read("tests/LagSim.Tests/Docs/Examples.cs")
        + Read("samples/FirstGame/Program.cs");

    [Theory]
    [InlineData("README.md", 1)]
    [InlineData("docs/TUTORIAL.md", 4)]
    [InlineData("docs/GAMELOOP.md", 10)]
    [InlineData("docs/ENGINES.md", 1)]
    [InlineData("docs/TUNING.md", 3)]
    [InlineData("src/LagSim/README.md", 1)]
    [InlineData("src/LagSim.Net/README.md", 1)]
    [InlineData("src/LagSim.Net.LiteNetLib/README.md", 1)]
    [InlineData("src/LagSim.Net.WebSockets/README.md", 2)]
    [InlineData("src/LagSim.Net.Secure/README.md", 1)]
    [InlineData("docs/SECURITY.md", 3)]
    [InlineData("docs/FORCES.md", 7)]
    [InlineData("docs/SENSORS.md", 3)]
    [InlineData("docs/RULES.md", 6)]
    public void Page_EachOfItsSnippets_IsCompiledAsItStands(string page, int count)
    {
        string[] snippets = [.. Fence().Matches(Read(page)).Select(match => match.Groups[1].Value)];
        Assert.Equal(count, snippets.Length);
        Assert.All(snippets, snippet => Assert.True(IsCompiled(snippet), $"{page} has code that Snippets.cs has not:\n{snippet}"));
        Assert.All(snippets, snippet => Assert.False(IsCompiled(snippet.Replace(".", "..", StringComparison.Ordinal)))); // the control
    }

    /// <summary>What follows an await may run on another thread than the one that draws, which alone may read the world: so no page awaits what a player does.</summary>
    [Theory]
    [InlineData("README.md", 1)]
    [InlineData("docs/GAMELOOP.md", 5)]
    [InlineData("docs/TUTORIAL.md", 1)]
    [InlineData("src/LagSim.Net/README.md", 1)]
    public void Page_ItsFrames_AwaitNoAction(string page, int actions)
    {
        string code = string.Concat(Fence().Matches(Read(page)).Select(match => match.Groups[1].Value));
        Assert.True(AsyncAction().Count(code) == 0, page);
        Assert.Equal(actions, PeerAction().Count(code)); // else nothing was seen
        Assert.Equal(actions, AsyncAction().Count(code.Replace("_ = ", "await ", StringComparison.Ordinal).Replace("> shot = ", "> shot = await ", StringComparison.Ordinal))); // the control
    }

    [Theory]
    [InlineData("src/LagSim/Scenes/Scene.cs")]
    [InlineData("src/LagSim/Scenes/BodySpec.cs")]
    [InlineData("src/LagSim/Events/PlayerAction.cs")]
    [InlineData("src/LagSim/Simulation.cs")]
    [InlineData("src/LagSim/Hosting/SimulationHost.cs")]
    [InlineData("src/LagSim/Hosting/ContactNotices.cs")]
    [InlineData("src/LagSim/Hosting/CrossingNotices.cs")]
    [InlineData("src/LagSim/Hosting/LossNotices.cs")]
    [InlineData("src/LagSim/Hosting/RuleNotices.cs")]
    [InlineData("src/LagSim/Rules/GameRules.cs")]
    [InlineData("src/LagSim.Net/Display/DisplayOffsets.cs")]
    [InlineData("src/LagSim.Net/Sessions/PeerThread.cs")]
    [InlineData("src/LagSim.Net/Sessions/HostOptions.cs")]
    [InlineData("src/LagSim.Net/Sessions/ClientOptions.cs")]
    public void Example_OfEachTypeThatIsMetFirst_IsCompiledAsItStands(string file)
    {
        IEnumerable<string> comments = Lines(Read(file)).Where(line => line.StartsWith("///", StringComparison.Ordinal));
        string comment = string.Join('\n', comments.Select(line => line[3..]));
        string code = WebUtility.HtmlDecode(Assert.Single(Example().Matches(comment)).Groups[1].Value);
        Assert.True(IsCompiled(code), $"{file} has an example that Examples.cs has not:\n{code}");
        Assert.False(IsCompiled(code.Replace(".", "..", StringComparison.Ordinal))); // the control
    }

    [Fact]
    public void Bounce_AndContacts_Run()
    {
        List<Vector3D> shown = [];
        Snippets snippets = new(Drop(3.5, 0.7), shown.Add);
        snippets.Bounce();
        snippets.Contacts();
        Assert.All(shown, place => Assert.True(place.Y is > 3 and <= 4, $"{place}")); // nothing has fallen far yet
    }

    [Fact]
    public void HearLate_Runs_AndIsWhatTheWorldOnTimeIs()
    {
        Scene scene = Drop(3.5, 0.7);
        BodyId ball = BodyId.OfScene(0);
        Simulation late = new Snippets(scene, _ => { }).HearLate(ball), onTime = new(scene, KeepAll), without = Run(scene, 3);
        Assert.Equal(SubmitResult.Queued, onTime.Submit(PlayerAction.Impulse(ball, V(0, 6)).Stamp(At(2.2), peer: 1, sequence: 1)));
        onTime.AdvanceTo(At(3));
        Assert.Equal(onTime.StateHash(At(3)), late.StateHash(At(3)));
        Assert.NotEqual(without.StateHash(At(3)), late.StateHash(At(3))); // the control
    }

    [Fact]
    public void Sensors_SnippetsOfThePage_RunAndTheBallIsIn()
    {
        Scene scene = SensorSnippets.Penalty();
        Assert.True(SensorSnippets.Read(scene));
        SensorSnippets.Hear(scene, scene.SensorNamed("goal"));
        Simulation world = Run(scene, 1);
        Assert.Equal([(1, true), (0, true), (1, false)], world.Crossings(At(0), At(1)).Select(crossing => (crossing.Sensor, crossing.Entered)));
    }

    [Theory]
    [InlineData(4, 1)]
    [InlineData(400, 0)] // the control: too far away
    public void Rules_TestOfThePage_RunsAndCountsTheGoal(double mouth, int goals)
    {
        Scene pitch = new SceneBuilder("pitch").AddPlane("floor", Vector3D.Up, V(0), 0.5).AddBody("ball", Ball(0.25), V(0, 0.5))
            .AddSensorPlane("left", V(1), V(-mouth)).AddSensorPlane("right", V(-1), V(mouth)).WithRules(new Football()).Build();
        Score score = RuleSnippets.AfterAKick(pitch);
        Assert.Equal((goals, 0), (score.Left, score.Right));
        Assert.Contains(
            "The state of the world is asked for as System.Int64; the rules 'football 1' declare LagSim.Tests.Docs.Score.",
            Assert.Throws<InvalidOperationException>(() => new SessionTest(pitch).Run(seconds: 1, TestContext.Current.CancellationToken).StateOfRules<long>()).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Forces_SnippetsAndFiguresOfThePage_AreWhatComesOut()
    {
        string page = Read("docs/FORCES.md");
        Scene scene = ForceSnippets.Forces();
        Assert.Contains($"```text\n{scene.Explain()}\n```", page, StringComparison.Ordinal);
        Assert.Equal([MotionLaw.DormandPrince54, MotionLaw.ClosedForm, MotionLaw.Ballistic], scene.Explain().Bodies.Select(body => body.Motion));

        BodyState ball = ForceSnippets.Roll();
        Assert.Contains(
            string.Create(CultureInfo.InvariantCulture, $"`{ball.Motion} at {ball.Velocity.X:F3} m/s, turning by {ball.Spin.Z:F2} rad/s`"), page, StringComparison.Ordinal);

        SceneBuilder laws = new SceneBuilder("laws").AddForce(Force.QuadraticDrag("air", 0.0107), out ForceSet air);
        MotionLaw[] chosen = [.. ForceSnippets.Laws(air).Select((spec, n) => laws.AddBody($"b{n}", spec, V(n))).Last().Build().Explain().Bodies.Select(body => body.Motion)];
        Assert.Equal([MotionLaw.DormandPrince54, MotionLaw.DormandPrince54, MotionLaw.RungeKutta4], chosen);

        string steel = Assert.Throws<SceneException>(() => new SceneBuilder("steel")
            .AddForce(Force.Spring("coil", V(0), 1e14), out ForceSet coil).AddBody("ball", new BodySpec(0.5, 1, 1, forces: coil), V(0)).Build()).Message;
        Assert.Contains("    " + steel + "\n", page, StringComparison.Ordinal);
    }

    /// <summary>A peer without the program's own force ends with the sentence of the page; one of another version too; one that has it plays.</summary>
    [Theory]
    [InlineData(0, ", which is not here.")]
    [InlineData(2, "; here it is of version 2.")]
    [InlineData(1, null)]
    public void OwnForce_OfAClientThatHasNone_IsRefusedAsThePageSays(int version, string? refusal)
    {
        VirtualClock clock = new(SimTime.FromSeconds(10));
        VirtualNetwork network = new(clock, 1, LinkProfiles.Lan);
        VirtualSteps steps = new(network);
        IDatagramPort hostPort = network.CreatePort(0), port = network.CreatePort(1);
        ClientOptions options = new() { Accelerations = version == 0 ? null : [new OtherWhirl(version)] };
        ClientSession client = new(null, port, clock, options, PeerAddress.Virtual(0), 4);
        steps.Add(new HostSession(ForceSnippets.Whirl(), hostPort, clock, new HostOptions(), 1), hostPort);
        steps.Add(client, port);
        steps.RunFor(SimDuration.FromSeconds(5));
        Assert.Equal(refusal is null ? SessionState.Running : SessionState.Ended, client.State);
        string sentence = $"The scene needs the acceleration 'whirl' of version 1{refusal}";
        Assert.Equal(refusal is null ? null : $"The copy of the world that the host sent cannot be used: {sentence}", client.EndReason);
        Assert.True(version > 0 || Read("docs/FORCES.md").Contains($"`{sentence}`", StringComparison.Ordinal));
    }

    [Theory]
    [InlineData("README.md", 4)]
    [InlineData("docs/CLI.md", 12)]
    [InlineData("docs/STRATEGIES.md", 3)]
    [InlineData("docs/EXACT.md", 1)]
    [InlineData("docs/ACCURACY.md", 8)]
    [InlineData("docs/SCENES.md", 3)]
    [InlineData("CONTRIBUTING.md", 1)]
    [InlineData("src/LagSim.Cli/README.md", 2)]
    public void Page_EachOfItsCallsOfTheTool_IsOneThatTheToolUnderstands(string page, int atLeast)
    {
        string[] calls = [.. Call().Matches(Read(page)).Select(match => match.Groups[1].Value.Trim())];
        Assert.True(calls.Length >= atLeast, $"{calls.Length} calls");
        Assert.All(calls, call => Assert.True(Mistakes(call).Length == 0, $"{page}: '{call}': {string.Join(' ', Mistakes(call))}"));
        Assert.All(calls.Where(call => call != "--help"), call => Assert.NotEmpty(Mistakes(call + " --no such option"))); // the control
    }

    private static string[] Mistakes(string call)
    {
        ToolConsole console = new(TextWriter.Null, TextWriter.Null, TestContext.Current.CancellationToken);
        return [.. Program.Root(console).Parse(call.Split(' ', StringSplitOptions.RemoveEmptyEntries)).Errors.Select(error => error.Message)];
    }

    /// <summary>Whether its lines, apart from indentation and empty ones, stand there one after the other, and all that it uses is used.</summary>
    private static bool IsCompiled(string snippet)
    {
        string[] lines = Lines(snippet), uses = [.. lines.Where(line => Use().IsMatch(line))];
        string[] there = Lines(Compiled), code = [.. lines.Where(line => !Use().IsMatch(line))];
        return Enumerable.Range(0, Math.Max(0, there.Length - code.Length + 1)).Any(at => there.AsSpan(at, code.Length).SequenceEqual(code))
            && uses.All(use => there.Contains(use) || use == "using LagSim;"); // in which the test's own namespace lies
    }

    private static string[] Lines(string text) => text.Split('\n', StringSplitOptions.TrimEntries | StringSplitOptions.RemoveEmptyEntries);

    internal static string Read(string file)
    {
        DirectoryInfo? folder = new(AppContext.BaseDirectory);
        while (folder is not null && !File.Exists(Path.Combine(folder.FullName, "LagSim.sln")))
        {
            folder = folder.Parent;
        }

        return File.ReadAllText(Path.Combine(folder!.FullName, file)).ReplaceLineEndings("\n");
    }

    private sealed class OtherWhirl(int version) : IAcceleration
    {
        private readonly Whirl whirl = new();

        public string Name => whirl.Name;

        public int Version => version;

        public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => whirl.At(seconds, position, velocity);
    }

    [GeneratedRegex(@"\b(?:peer|client|me)\.Do\(")]
    private static partial Regex PeerAction();

    [GeneratedRegex(@"await (?:peer|client|me)\.Do\(")]
    private static partial Regex AsyncAction();

    [GeneratedRegex("```csharp\n(.*?)```", RegexOptions.Singleline)]
    private static partial Regex Fence();

    /// <summary>An indented line that calls the tool, without what the shell makes of its end.</summary>
    [GeneratedRegex("^    (?:lagsim|dotnet run .*?--project src/LagSim.Cli.*? --) ([^#>|\n]+)", RegexOptions.Multiline)]
    private static partial Regex Call();

    [GeneratedRegex(@"<example>.*?<code>\n(.*?)</code>", RegexOptions.Singleline)]
    private static partial Regex Example();

    [GeneratedRegex("^using [A-Za-z.]+;$")]
    private static partial Regex Use();
}
