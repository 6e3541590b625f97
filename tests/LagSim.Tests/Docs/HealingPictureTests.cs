using System;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;
using LagSim.Events;
using LagSim.Harness.Reports.Charts;
using LagSim.Scenes;
using LagSim.Tests.Api;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Docs;

/// <summary>
/// The picture of healing in the README is drawn from two simulations, one of which receives a kick late. With <c>LAGSIM_UPDATE_PICTURES=1</c> this
/// test writes the files anew.
/// </summary>
public sealed partial class HealingPictureTests
{
    private const double Kicked = 1.0, Received = 1.5, End = 4.0;
    private const int SamplesPerSecond = 120;

    [Theory]
    [InlineData("light")]
    [InlineData("dark")]
    public void Picture_OfHealing_IsWhatTheWorldsDo(string theme)
    {
        string file = Path.Combine(RepositoryRoot.Path, "docs", "images", $"healing-{theme}.svg"), drawn = InOneTheme(Draw(), theme);
        if (Environment.GetEnvironmentVariable("LAGSIM_UPDATE_PICTURES") == "1")
        {
            File.WriteAllText(file, drawn);
        }

        Assert.Equal(File.ReadAllText(file).ReplaceLineEndings("\n"), drawn);
    }

    private static string Draw()
    {
        Scene scene = new SceneBuilder("picture").AddPlane("floor", Vector3D.Up, V(0), 1)
            .AddBody("kicked", Ball(0.5, 1, 0.75), V(0, 4)).AddBody("far away", Ball(0.5, 1, 0.75), V(20, 2.5)).Build();
        ExternalEvent kick = PlayerAction.Impulse(First, V(0, 7)).Stamp(At(Kicked), peer: 1, sequence: 1);
        Simulation here = new(scene, KeepAll), there = new(scene, KeepAll);
        here.Submit(kick);
        here.AdvanceTo(At(End));
        double[] x = [.. Enumerable.Range(0, (int)(End * SamplesPerSecond) + 1).Select(n => (double)n / SamplesPerSecond)], shown = new double[x.Length];
        for (int n = 0; n < x.Length; n++)
        {
            there.AdvanceTo(At(x[n]));
            if (x[n] == Received)
            {
                there.Submit(kick);
                there.AdvanceTo(At(Received));
            }

            shown[n] = Read(there, First, x[n]).Position.Y;
        }

        Assert.Equal(here.StateHash(At(End)), there.StateHash(At(End)));
        double[] right = [.. x.Select(t => Read(here, First, t).Position.Y)];
        Assert.All(Enumerable.Range(0, x.Length), n => Assert.Equal(x[n] < Kicked + 1e-9 || x[n] >= Received, right[n] == shown[n]));
        ChartPanel panel = new("two balls", "height (m)",
        [
            new ChartSeries("far away, on both screens", x, [.. x.Select(t => Read(there, Second, t).Position.Y)], colour: 6),
            new ChartSeries("kicked, on the kicker's screen", x, right, colour: 0),
            new ChartSeries("kicked, on the other screen", x, shown, SeriesStyle.Dashed, colour: 1),
        ])
        {
            PlotHeight = 260,
            Markers = [new ChartMarker(Kicked, "the kick"), new ChartMarker(Received, "it arrives, and the world heals")],
        };
        return new LineChart(
            "A kick that arrives half a second late",
            "Height against time on two screens. They differ from the kick at 1.0 s until it arrives at 1.5 s. From then on they are equal, bit for bit.",
            [panel]).ToSvg().ReplaceLineEndings("\n") + "\n";
    }

    /// <summary>The drawing with one theme's colours in place of its variables.</summary>
    private static string InOneTheme(string svg, string theme)
    {
        Match dark = DarkRules().Match(svg);
        string values = theme == "dark" ? dark.Groups[1].Value : svg[..dark.Index];
        svg = svg.Remove(dark.Index, dark.Length);
        svg = Fallback().Replace(svg, match => $"{match.Groups[1].Value}:{Value(values, match.Groups[2].Value)}");
        return Variable().Replace(svg, "").Replace("color-scheme:light dark", $"color-scheme:{theme}", StringComparison.Ordinal);
    }

    private static string Value(string rules, string name) => Regex.Match(rules, $"{name}:(#[0-9a-f]+);").Groups[1].Value;

    [GeneratedRegex(@"@media \(prefers-color-scheme: dark\)\{(.*?)\}\}\n")]
    private static partial Regex DarkRules();

    [GeneratedRegex(@"(fill|stroke):#[0-9a-f]+;(?:fill|stroke):var\((--lagsim-[a-z0-9]+)\)")]
    private static partial Regex Fallback();

    [GeneratedRegex("--lagsim-[a-z0-9]+:#[0-9a-f]+;")]
    private static partial Regex Variable();
}
