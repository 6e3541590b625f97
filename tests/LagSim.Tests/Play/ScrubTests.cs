using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Play;
using Xunit;

namespace LagSim.Tests.Play;

/// <summary>The window of the panes: bodies at another instant, and their paths over all of it.</summary>
public sealed class ScrubTests
{
    private const double Frame = 1 / 60.0;

    [Fact]
    public void Scrub_ToAnInstantThatWasDrawn_IsWhatWasDrawnThen()
    {
        Playground playground = new(PlaySetup.Parse("panes=healing,healing&delay=50"));
        Run(playground, 1);
        (double X, double Y)[] then = Places(playground);
        double at = playground.Seconds;
        Run(playground, 1);
        (double X, double Y)[] now = Places(playground);
        playground.Scrub(at - playground.Seconds);
        Assert.All(then.Zip(Places(playground)), pair => Assert.True(Apart(pair.First, pair.Second) < 1e-6));
        Assert.All(playground.Panes, pane => Assert.Equal(0, pane.Error, 1e-6));
        Assert.True(then.Zip(now).Max(pair => Apart(pair.First, pair.Second)) > 0.1); // the control: they have moved since
        playground.Advance(0, 0);
        Assert.Equal(now, Places(playground));
    }

    /// <summary>What was precomputed comes true where nothing happens in between.</summary>
    [Fact]
    public void Scrub_ToTheFuture_IsWhatComes()
    {
        Playground playground = new(PlaySetup.Parse("panes=healing,healing&ahead=500"));
        Run(playground, 1);
        double ahead = playground.Window().Newest;
        Assert.InRange(ahead, 0.2, 0.5); // it is filled up in steps
        playground.Scrub(ahead);
        (double X, double Y)[] foretold = Places(playground);
        Assert.All(playground.Panes, pane => Assert.True(double.IsNaN(pane.Error))); // nobody knows the truth of what is to come
        playground.Advance(ahead, ahead);
        Assert.All(foretold.Zip(Places(playground)), pair => Assert.True(Apart(pair.First, pair.Second) < 1e-6));
    }

    [Fact]
    public void Scrub_OutsideOfTheWindow_HasNothingThere()
    {
        Playground playground = new(PlaySetup.Parse(""));
        Run(playground, 1);
        (double oldest, double newest) = playground.Window();
        foreach (double outside in new[] { oldest - 0.1, newest + 0.1 })
        {
            playground.Scrub(outside);
            Assert.All(playground.Panes[0].Places.ToArray(), place => Assert.False(place.IsThere));
        }
    }

    [Fact]
    public void Window_OfALongRun_IsTheHistoryAndTheLookAhead()
    {
        Playground playground = new(PlaySetup.Parse("ahead=300"));
        Run(playground, 5);
        (double oldest, double newest) = playground.Window();
        Assert.InRange(oldest, -3.3, -2.7);
        Assert.InRange(newest, 0.1, 0.3);
    }

    [Fact]
    public void Window_OfAWorldAtRest_EndsWithTheLookAhead()
    {
        Playground playground = new(PlaySetup.Parse("scene=break&ahead=300"));
        Run(playground, 5);
        Assert.Equal(0.3, playground.Window().Newest, 1e-9);
        Assert.All(Paths(playground, 0, 10)[3], point => Assert.InRange(point.T, -4.5, 0.3001));
    }

    /// <summary>Points of a path are where scrubbing there finds the body, and no bounce is cut off.</summary>
    [Theory]
    [InlineData("room")]
    [InlineData("orbits")]
    [InlineData("drop")]
    public void AppendPaths_OfAPane_PassesWhereTheBodiesAre(string scene)
    {
        Playground playground = new(PlaySetup.Parse($"scene={scene}"));
        Run(playground, 2.5);
        List<List<(double T, double X, double Y)>> paths = Paths(playground, 1, 40);
        for (int body = 0; body < paths.Count; body++)
        {
            Assert.True(paths[body].Count >= 40);
            foreach ((double t, double x, double y) in paths[body].Where((_, n) => n % 7 == 3))
            {
                playground.Scrub(t);
                Assert.True(Apart((x, y), playground.Panes[1].Places[body].Drawn) < 1e-6);
            }
        }

        if (scene == "drop")
        {
            Assert.Contains(paths[0], point => Math.Abs(point.Y - 0.5) < 1e-9); // the very instant at which it touches the floor
            List<(double T, double X, double Y)> evenly = Paths(playground, 1, 40, isExact: false)[0];
            Assert.Equal(40, evenly.Count);
            Assert.DoesNotContain(evenly, point => Math.Abs(point.Y - 0.5) < 1e-9); // the control
        }
    }

    [Fact]
    public void AppendPaths_OfABodyThatWasTaken_BreaksTheLineWhereItWasPutElsewhere()
    {
        Playground playground = new(PlaySetup.Parse("scene=drop&delay=0"));
        Run(playground, 0.5);
        Assert.DoesNotContain(Paths(playground, 0, 20)[0], point => double.IsNaN(point.X));
        DrawnPlace ball = playground.Panes[0].Places[0];
        Assert.True(playground.Grab(0, ball.Drawn.X, ball.Drawn.Y, 0.1));
        Run(playground, 0.2);
        Assert.Contains(Paths(playground, 0, 20)[0], point => double.IsNaN(point.X));
    }

    private static List<List<(double T, double X, double Y)>> Paths(Playground playground, int pane, int count, bool isExact = true)
    {
        List<double> flat = [];
        playground.AppendPaths(count, isExact, flat);
        List<List<(double T, double X, double Y)>> paths = [];
        for (int at = 0; at < flat.Count;)
        {
            List<(double T, double X, double Y)> path = [];
            int points = (int)flat[at++];
            for (int n = 0; n < points; n++, at += 3)
            {
                path.Add((flat[at], flat[at + 1], flat[at + 2]));
            }

            Assert.True(path.Zip(path.Skip(1)).All(pair => pair.First.T <= pair.Second.T));
            paths.Add(path);
        }

        int bodies = playground.Scene.Scene.Bodies.Count;
        Assert.Equal(bodies * playground.Panes.Count, paths.Count);
        return paths[(pane * bodies)..((pane + 1) * bodies)];
    }

    private static (double X, double Y)[] Places(Playground playground) =>
        [.. playground.Panes.SelectMany(pane => pane.Places.ToArray().Select(place => place.Drawn))];

    private static double Apart((double X, double Y) a, (double X, double Y) b) => Math.Sqrt(((a.X - b.X) * (a.X - b.X)) + ((a.Y - b.Y) * (a.Y - b.Y)));

    private static void Run(Playground playground, double seconds)
    {
        for (int n = 0; n < seconds * 60; n++)
        {
            playground.Advance(Frame, Frame);
        }
    }
}
