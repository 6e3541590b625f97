using System;
using System.Linq;
using LagSim.Net.Strategies;
using LagSim.Play;
using Xunit;

namespace LagSim.Tests.Play;

/// <summary>What the guided steps of the page say is so.</summary>
public sealed class GuidedStepTests
{
    private const double Frame = 1 / 60.0;

    public static TheoryData<string> Names => [.. GuidedSteps.All.Select(step => step.Name)];

    /// <summary>Every deed of every step and of its variants: who promises agreement agrees, and who does not, does not.</summary>
    [Theory]
    [MemberData(nameof(Names))]
    public void Deeds_OfAStep_LeaveThoseEqualThatPromiseIt(string name)
    {
        GuidedStep step = GuidedSteps.Named(name);
        foreach (string query in step.Variants.Select(variant => variant.Query).Prepend(step.Query))
        {
            Assert.Equal(query, PlaySetup.Parse(query).ToQuery());
            foreach (GuidedDeed deed in step.Deeds)
            {
                Playground playground = Played(query, deed, 6);
                ulong?[] hashes = Hashes(playground);
                foreach (Pane pane in playground.Panes)
                {
                    bool promises = LateEventStrategies.Create(PlaySetup.NameOf(pane.Strategy)).PromisesAgreement;
                    bool isMine = deed.Strokes.All(stroke => stroke.Pane == pane.Number);
                    Assert.True(isMine || promises == (hashes[pane.Number] == hashes[^1]), $"{name}: {deed.Text}, player {pane.Number + 1}");
                }
            }
        }
    }

    /// <summary>A step knows its own set-up and those it offers, with any seed and at any speed; any other it tells apart, by what differs.</summary>
    [Theory]
    [MemberData(nameof(Names))]
    public void ChangesIn_OfASetUp_AreWhatItHasOtherwise(string name)
    {
        GuidedStep step = GuidedSteps.Named(name);
        foreach (string query in step.Variants.Select(variant => variant.Query).Prepend(step.Query))
        {
            Assert.Empty(step.ChangesIn(PlaySetup.Parse($"{query}&seed=7&speed=0.25")));
            PlaySetup setup = PlaySetup.Parse(query);
            Assert.Contains("smooth is 0, not 1", step.ChangesIn(setup with { IsSmooth = false }));
            Assert.Contains("link is awful, not custom", step.ChangesIn(setup with { Link = new LinkSettings { Profile = "awful" } }));
        }

        PlaySetup own = PlaySetup.Parse(step.Query);
        Assert.Equal([$"scene is cradle, not {own.Scene}"], step.ChangesIn(own with { Scene = "cradle" }));
        Assert.Equal(
            [$"delay is 35, not {own.Link.DelayMilliseconds}"], step.ChangesIn(own with { Link = own.Link with { DelayMilliseconds = 35 } }));
    }

    [Fact]
    public void Break_Seen200MillisecondsLate_IsAnotherGameWithoutHealing()
    {
        Playground playground = Played(GuidedSteps.Named("break").Query, GuidedSteps.Named("break").Deeds[0], 3);
        Assert.Equal(0, playground.Panes[1].Error, 1e-3);
        Assert.All(playground.Panes.Skip(2), pane => Assert.True(pane.Error > 0.1, $"player {pane.Number + 1} is off by {pane.Error} m"));
    }

    /// <summary>With local lag nothing that was seen is rewritten; the control is the same without it.</summary>
    [Fact]
    public void Later_WithLocalLag_RewritesOnlyTheFuture()
    {
        GuidedStep step = GuidedSteps.Named("later");
        (double error, bool isLit) = Seen(step.Query);
        Assert.Equal(0, error, 1e-6);
        Assert.False(isLit);
        (error, isLit) = Seen(step.Variants[0].Query);
        Assert.True(error > 0.1, $"{error} m");
        Assert.True(isLit);

        (double Error, bool IsLit) Seen(string query)
        {
            Playground playground = new(PlaySetup.Parse(query));
            Run(playground, 0.5);
            Assert.All(step.Deeds[0].Strokes, stroke => Assert.True(playground.Strike(stroke)));
            double most = 0;
            bool isLit = false;
            for (int n = 0; n < 120; n++)
            {
                playground.Advance(Frame, Frame);
                most = Math.Max(most, playground.Panes[1].Error);
                isLit |= playground.Panes[1].Places.ToArray().Any(place => place.Glow > 0);
            }

            Assert.True(playground.Panes[1].Heals > 0);
            return (most, isLit);
        }
    }

    /// <summary>With loss in a row a throw may come half a second late; without, it comes when the link says.</summary>
    [Fact]
    public void Loss_OfManyInARow_MakesAThrowHalfASecondLate()
    {
        GuidedStep step = GuidedSteps.Named("loss");
        Assert.InRange(Latest(step.Query), 0.5, 2);
        Assert.InRange(Latest(step.Variants[0].Query), 0.05, 0.2);

        double Latest(string query) => Enumerable.Range(1, 20).Max(seed =>
        {
            Playground playground = Played($"{query}&seed={seed}", step.Deeds[0], 0);
            double began = playground.Seconds;
            while (playground.Panes[1].Heals < step.Deeds[0].Strokes.Count && playground.Seconds < began + 5)
            {
                playground.Advance(Frame, Frame);
            }

            return playground.Seconds - began;
        });
    }

    [Fact]
    public void Named_OfNoStep_SaysWhichThereAre() => Assert.StartsWith(
        "There is no step 'moon'; there are lift, hand, break, loss, later.",
        Assert.Throws<ArgumentException>(() => GuidedSteps.Named("moon")).Message,
        StringComparison.Ordinal);

    private static Playground Played(string query, GuidedDeed deed, double seconds)
    {
        Playground playground = new(PlaySetup.Parse(query));
        Run(playground, 0.5);
        Assert.All(deed.Strokes, stroke => Assert.True(playground.Strike(stroke)));
        Run(playground, seconds);
        return playground;
    }

    private static ulong?[] Hashes(Playground playground)
    {
        ulong?[] hashes = new ulong?[playground.Panes.Count + 1];
        playground.ReadHashes(hashes);
        Assert.NotNull(hashes[^1]);
        return hashes;
    }

    private static void Run(Playground playground, double seconds)
    {
        for (int n = 0; n < seconds * 60; n++)
        {
            playground.Advance(Frame, Frame);
        }
    }
}
