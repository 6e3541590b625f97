using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Strategies;
using LagSim.Play;
using LagSim.Testing.Links;
using Xunit;

namespace LagSim.Tests.Play;

/// <summary>A link to the page carries a set-up, and says what in it cannot be.</summary>
public sealed class PlaySetupTests
{
    [Theory]
    [InlineData("")]
    [InlineData("scene=billiards&panes=none,healing,latency-forward&delay=200&jitter=12.5&loss=3&burst=4&asymmetry=-30&clock=-1500&seed=77&ahead=300&lag=40&smooth=0&speed=0.25")]
    [InlineData("scene=cradle&panes=interpolation,full-rollback,healing,none&link=awful")]
    public void Parse_OfWhatToQueryWrites_IsTheSameSetup(string query)
    {
        PlaySetup setup = PlaySetup.Parse(query), again = PlaySetup.Parse(setup.ToQuery());
        Assert.Equal(setup.ToQuery(), again.ToQuery());
        Assert.Equal(setup.Strategies, again.Strategies);
        Assert.Equal(setup.Link, again.Link);
        Assert.Equal(setup with { Strategies = [] }, again with { Strategies = [] });
        foreach (string part in query.Split('&', StringSplitOptions.RemoveEmptyEntries))
        {
            Assert.Contains(part, setup.ToQuery(), StringComparison.Ordinal); // nothing is dropped
        }
    }

    [Theory]
    [InlineData("scene=moon", "'scene' is 'moon'; it must be one of room, drop, billiards, break, cradle, orbits, air-hockey.")]
    [InlineData("panes=healing", "'panes' names 1 strategies; there are 2 to 4 panes.")]
    [InlineData("panes=healing,magic", "'panes' is 'magic'; it must be one of none, latency-forward, interpolation, full-rollback, healing.")]
    [InlineData("ahead=1001", "'ahead' is '1001'; it must be a number from 20 to 1000.")]
    [InlineData("ahead=20&lag=21", "'lag' is 21 ms; with a look-ahead of 20 ms ('ahead') it can be that at most.")]
    [InlineData("delay=2001", "'delay' is '2001'; it must be a number from 0 to 2000.")]
    [InlineData("delay=NaN", "'delay' is 'NaN'")]
    [InlineData("delay", "'delay' is ''")]
    [InlineData("loss=50&burst=1&delay=abc", "'delay' is 'abc'")]
    [InlineData("asymmetry=201", "'asymmetry' is 201 ms; with a delay of 100 ms it can be 200 ms at most, either way.")]
    [InlineData("seed=-1", "'seed' is '-1'")]
    [InlineData("seed=1.5", "'seed' is '1.5'; it must be a whole number from 0 to 9007199254740992.")]
    [InlineData("link=carrier-pigeon", "'link' is 'carrier-pigeon'; it must be one of custom, loopback, lan,")]
    [InlineData("smooth=0.5", "'smooth' is '0.5'; it must be a whole number from 0 to 1.")]
    [InlineData("clock=10001", "'clock' is '10001'; it must be a number from -10000 to 10000.")]
    [InlineData("delay=30&loss=2&delay=60", "'delay' is there 2 times, as '30', '60'; once is allowed.")]
    [InlineData("delay=30&delay=30", "'delay' is there 2 times, as '30', '30'; once is allowed.")]
    [InlineData("link=awful&delay=30", "'link=awful' and 'delay=30' disagree: a profile has its own delay, jitter, loss, burst, asymmetry, clock.")]
    [InlineData("loss=3&burst=2&link=4g", "'link=4g' and 'loss=3', 'burst=2' disagree: a profile has its own")]
    [InlineData("colour=red", "'colour' is no part of a set-up; there are scene, link, panes, seed, delay,")]
    public void Parse_OfWhatCannotBe_NamesItAndWhatIsAllowed(string query, string sentence) =>
        Assert.StartsWith(sentence, Assert.Throws<FormatException>(() => PlaySetup.Parse(query)).Message, StringComparison.Ordinal);

    /// <summary>One wrong value costs that value alone, and what is shown in its place is said.</summary>
    [Theory]
    [InlineData("players=9&scene=drop&delay=30", "scene=drop&panes=healing,healing&delay=30", "It is left out.")]
    [InlineData("scene=drop&delay=abc&loss=3", "scene=drop&panes=healing,healing&loss=3", "'delay=100' is shown instead.")]
    [InlineData("scene=moon&delay=30", "scene=room&panes=healing,healing&delay=30", "'scene=room' is shown instead.")]
    [InlineData("panes=healing&delay=30", "scene=room&panes=healing,healing&delay=30", "'panes=healing,healing' is shown instead.")]
    [InlineData("delay=30&loss=3&delay=60", "scene=room&panes=healing,healing&loss=3", "'delay=100' is shown instead.")]
    [InlineData("link=awful&delay=30&ahead=300", "scene=room&panes=healing,healing&link=awful&ahead=300", "The profile 'awful' is shown, as it is.")]
    [InlineData("delay=20&asymmetry=50", "scene=room&panes=healing,healing&delay=20", "'asymmetry=0' is shown instead.")]
    [InlineData("lag=300&delay=20", "scene=room&panes=healing,healing&delay=20", "'lag=0' is shown instead.")]
    public void Read_OfWhatCannotBeInPart_IsAllElse(string query, string rest, string instead)
    {
        (PlaySetup setup, IReadOnlyList<WrongPart> wrong) = SetupReader.Read(query);
        Assert.Equal(rest, setup.ToQuery());
        Assert.Equal(instead, Assert.Single(wrong).Instead);
    }

    [Fact]
    public void Read_OfSeveralWrongParts_NamesEach()
    {
        (PlaySetup setup, IReadOnlyList<WrongPart> wrong) = SetupReader.Read("delay=abc&asymmetry=300&link=custom&players=9&seed=3");
        Assert.Equal(["'delay' is", "'players' is", "'asymmetry' is"], wrong.Select(part => string.Join(' ', part.Sentence.Split(' ')[..2])));
        Assert.Equal("scene=room&panes=healing,healing&seed=3", setup.ToQuery());
    }

    [Fact]
    public void Read_OfWhatABrowserHasEscaped_IsTheSame()
    {
        Assert.Equal(PlaySetup.Parse("panes=none,healing").ToQuery(), PlaySetup.Parse("panes=none%2Chealing").ToQuery());
        Assert.Equal("'scene' is 'a&delay=5'", SetupReader.Read("scene=a%26delay%3D5").Wrong[0].Sentence.Split(';')[0]);
        Assert.Equal("scene=room&panes=healing,healing&seed=9007199254740992", PlaySetup.Parse("seed=9007199254740992").ToQuery()); // no plus sign, which a browser reads as a space
    }

    /// <summary>Every profile is within the sliders, so that they show it as it is.</summary>
    [Fact]
    public void Figures_OfEachProfile_AreInRange()
    {
        foreach (LinkProfile profile in LinkProfiles.All)
        {
            PlaySetup shown = new() { Link = ProfileFigures.Of(profile).Shown };
            Assert.Equal(shown.ToQuery(), PlaySetup.Parse(shown.ToQuery()).ToQuery());
            bool isAllOfIt = ProfileFigures.Of(profile).Besides.Count == 0;
            LinkProfile again = shown.Link.ToProfile();
            Assert.Equal(isAllOfIt, (Text(again.ToHost), Text(again.FromHost)) == (Text(profile.ToHost), Text(profile.FromHost)));
            Assert.Equal(again.ReceiverClockOffset, profile.ReceiverClockOffset);
        }

        static string Text(LinkLeg leg) => string.Join(
            ' ', leg.DelayMilliseconds.ToString("F6", null), leg.JitterMilliseconds, leg.LossPercent, leg.MeanBurstLength, leg.ReorderPercent, leg.DuplicatePercent,
            leg.Tail, leg.Step, leg.Outage, leg.Bottleneck);
    }

    [Theory]
    [InlineData("awful", "delay=200&jitter=60&loss=10&burst=5", "5 % reordered; 2 % twice")]
    [InlineData("4g", "delay=45&jitter=10&loss=0.2&burst=1.5", "jitter 15 ms to the host and 5 ms back")]
    [InlineData("skewed-clock", "delay=0.3&jitter=0.05&clock=1240", "")]
    [InlineData("5g", "delay=12.5&jitter=3&loss=0.1&burst=1.5&asymmetry=11", "jitter 4 ms to the host and 2 ms back")]
    [InlineData("wifi-busy", "delay=10&loss=1&burst=3", "10 % take more than 50 ms")]
    [InlineData("dsl-256k", "delay=25&jitter=2", "256 kbit/s with a queue of 500 ms to the host; 2000 kbit/s with a queue of 500 ms back")]
    [InlineData("dip", "delay=40&jitter=2", "512 kbit/s with a queue of 1000 ms, and 100 kbit/s for 5 s each 30 s")]
    [InlineData("bufferbloat", "delay=20&jitter=2", "1000 kbit/s with a queue of 2000 ms; a download in the same queue")]
    [InlineData("blackout", "delay=40&jitter=2", "100 % lost for 1.5 s each 20 s")]
    [InlineData("starlink", "delay=25&jitter=7&loss=0.3&burst=1.0030090270812437", "the delay steps by 10 ms each 15 s; 50 % lost for 0.2 s each 15 s, in 50 % of these")]
    public void Figures_OfAProfile_AreItsOwnAndTheRestIsInWords(string profile, string query, string besides)
    {
        ProfileFigures figures = ProfileFigures.Of(LinkProfiles.Get(profile));
        Assert.Equal($"scene=room&panes=healing,healing&{query}", new PlaySetup { Link = figures.Shown }.ToQuery());
        Assert.Equal(besides, string.Join("; ", figures.Besides));
    }

    [Fact]
    public void Parse_OfNothing_IsTwoHealingPanesAHundredMillisecondsApart()
    {
        PlaySetup setup = PlaySetup.Parse("");
        Assert.Equal([LateEventStrategy.Healing, LateEventStrategy.Healing], setup.Strategies);
        Assert.Equal((100, "room"), (setup.Link.DelayMilliseconds, setup.Scene));
    }
}
