using System;
using LagSim.Net.Strategies;
using LagSim.Play;
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
    [InlineData("colour=red", "'colour' is no part of a set-up; there are scene, link, panes, seed, delay,")]
    public void Parse_OfWhatCannotBe_NamesItAndWhatIsAllowed(string query, string sentence) =>
        Assert.StartsWith(sentence, Assert.Throws<FormatException>(() => PlaySetup.Parse(query)).Message, StringComparison.Ordinal);

    [Fact]
    public void Parse_OfNothing_IsTwoHealingPanesAHundredMillisecondsApart()
    {
        PlaySetup setup = PlaySetup.Parse("");
        Assert.Equal([LateEventStrategy.Healing, LateEventStrategy.Healing], setup.Strategies);
        Assert.Equal((100, "room"), (setup.Link.DelayMilliseconds, setup.Scene));
    }
}
