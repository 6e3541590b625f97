using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text.RegularExpressions;
using System.Xml.Linq;
using LagSim.Cli.Output;
using LagSim.Harness.Experiments.Accuracy;
using LagSim.Harness.Reports.Charts;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>The charts of speed against error, of points that are made up.</summary>
public sealed class AccuracyChartTests
{
    private static readonly XNamespace Svg = "http://www.w3.org/2000/svg";

    [Fact]
    public void Methods_AllHaveAColourAndAShapeOfTheirOwn_TheSameWhicheverOthersAreThere()
    {
        string[] all = [.. WorkMethods.All.Select(method => method.Name)];
        Dictionary<string, (string Colour, string Mark)> together = Styles(Work("kepler", all));
        Assert.Equal(all.Order(), together.Keys.Order());
        Assert.Equal(all.Length, together.Values.Select(style => style.Colour).Distinct().Count());
        Assert.Equal(all.Length, together.Values.Select(style => style.Mark).Distinct().Count());
        foreach (string name in all)
        {
            Assert.Equal(together[name], Styles(Work("drop", name))[name]);
        }
    }

    [Fact]
    public void Methods_OfLagSim_AreDrawnThroughAndStrongAndNoOtherIs()
    {
        XElement svg = Work("kepler", [.. WorkMethods.All.Select(method => method.Name)]);
        string[] curves = [.. Paths(svg, "line ").Where(path => !Data(path).EndsWith("h24", StringComparison.Ordinal)).Select(Class)];
        Assert.Equal(5, curves.Count(curve => curve.Contains("strong", StringComparison.Ordinal)));
        Assert.All(curves, curve => Assert.NotEqual(curve.Contains("strong", StringComparison.Ordinal), curve.Contains("dashed", StringComparison.Ordinal)));
    }

    [Fact]
    public void Points_KeepFromTheFrame_AndTheLegendFromThePoints()
    {
        XElement svg = Work("kepler", "LagSim ClosedForm", "ODE", "Chipmunk");
        Match frame = Regex.Match(Data(Assert.Single(Paths(svg, "frame"))), "^M0 0V([0-9.]+)H([0-9.]+)$");
        double height = Number(frame.Groups[1].Value), width = Number(frame.Groups[2].Value);
        (double X, double Y)[] marks = [.. Paths(svg, "point ").SelectMany(path => Regex.Matches(Data(path), "M([0-9.]+) ([0-9.]+)"))
            .Select(m => (Number(m.Groups[1].Value), Number(m.Groups[2].Value)))];
        Assert.Equal((9, 3), (marks.Count(m => m.X < width), marks.Count(m => m.X > width))); // three points each; and in the legend
        Assert.All(marks.Where(m => m.X < width), m => Assert.True(m.X >= 9.9 && m.X <= width - 9.9 && m.Y >= 9.9 && m.Y <= height - 9.9, $"{m}"));
        Assert.All(
            svg.Descendants(Svg + "text").Where(t => (string?)t.Attribute("class") == "label"), t => Assert.True((double)t.Attribute("x")! > width, t.Value));
    }

    [Fact]
    public void Steps_OfErrorsThatAreRounding_AreNeitherJoinedNorGivenAnOrder()
    {
        // drop: rounding is 1e-14, and no order is read below a hundred times that.
        WorkPoint[] noise = [Step("LagSim RungeKutta4", 1, 3e-15), Step("LagSim RungeKutta4", 0.5, 5e-14), Step("LagSim RungeKutta4", 0.25, 9e-13)];
        WorkPoint[] real = [Step("ODE", 1, 0.4), Step("ODE", 0.5, 0.2), Step("ODE", 0.25, 0.1), Step("ODE", 0.125, 5e-13)];
        XElement svg = Parse(AccuracyChart.OfSteps(Report("drop", [.. noise, .. real]), Scene("drop"))!);
        string[] curves = [.. Paths(svg, "line ").Select(Data).Where(data => !data.EndsWith("h24", StringComparison.Ordinal))];
        Assert.Equal(2, Assert.Single(curves).Count(c => c == 'L')); // of ODE's four points three are joined
        string said = string.Join('|', svg.Descendants(Svg + "text").Select(t => t.Value));
        Assert.Contains("LagSim RungeKutta4|no order: rounding alone", said, StringComparison.Ordinal);
        Assert.Contains("may be rounding: below|1e-12", said, StringComparison.Ordinal);

        string without = string.Join('|', Parse(AccuracyChart.OfSteps(Report("drop", real[..3]), Scene("drop"))!).Descendants(Svg + "text").Select(t => t.Value));
        Assert.DoesNotContain("rounding", without, StringComparison.Ordinal);
    }

    [Fact]
    public void KindsOfError_OfAllScenes_AreSaidInWords()
    {
        foreach (WorkScene scene in WorkScenes.All)
        {
            string title = AccuracyTables.Title(scene);
            Assert.DoesNotContain('_', title);
            Assert.All(scene.ErrorKinds, kind => Assert.Contains(WorkErrorKinds.Of(kind).Sentence, title, StringComparison.Ordinal));
            Assert.DoesNotContain('_', Parse(AccuracyChart.OfWork(Report(scene.Name, [Step("ODE", 1, 0.1) with { Scene = scene.Name, ErrorKind = scene.ErrorKinds[0] }]), scene)!).Value
                .Replace("lagsim", "", StringComparison.Ordinal).Split("-c0")[^1]);
        }

        Assert.Contains("max_energy_relative", Assert.Throws<ArgumentException>(() => WorkErrorKinds.Of("speed")).Message, StringComparison.Ordinal);
    }

    private static XElement Work(string scene, params string[] methods) => Parse(AccuracyChart.OfWork(Report(scene,
        [.. methods.SelectMany((method, n) => Enumerable.Range(0, 3).Select(i => new WorkPoint(
            scene, method, "s", 1, Math.Pow(10, -i), Scene(scene).ErrorKinds[0], Math.Pow(10, i - n), 1, 1, 1)))]), Scene(scene))!);

    private static Dictionary<string, (string Colour, string Mark)> Styles(XElement svg)
    {
        XElement[] marks = [.. Paths(svg, "point ").Where(path => path.ElementsAfterSelf().FirstOrDefault()?.Name == Svg + "text")]; // those of the legend
        return marks.ToDictionary(
            mark => string.Join(' ', mark.ElementsAfterSelf().TakeWhile(e => e.Name == Svg + "text").Select(t => t.Value)),
            mark => (Regex.Match(Class(mark), "c[0-9]+").Value, Data(mark)[Data(mark).IndexOf('m', StringComparison.Ordinal)..]));
    }

    private static AccuracyReport Report(string scene, WorkPoint[] points) => new([Scene(scene)], new WorkReport(points, [], []), false, 1);

    private static WorkPoint Step(string method, double step, double error) =>
        new("drop", method, "s", step, error, "max_position_error_m", step, 1, 1, 1);

    private static WorkScene Scene(string name) => WorkScenes.TryGet(name, out WorkScene? found) ? found : throw new ArgumentException(name);

    private static XElement Parse(LineChart chart) => XElement.Parse(chart.ToSvg());

    private static IEnumerable<XElement> Paths(XElement svg, string begins) =>
        svg.Descendants(Svg + "path").Where(path => Class(path).StartsWith(begins, StringComparison.Ordinal));

    private static string Class(XElement path) => (string)path.Attribute("class")!;

    private static string Data(XElement path) => (string)path.Attribute("d")!;

    private static double Number(string text) => double.Parse(text, CultureInfo.InvariantCulture);
}
