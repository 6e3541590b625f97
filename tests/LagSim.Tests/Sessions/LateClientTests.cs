using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Somebody who comes in late, over a slow link, into a large world in which others play: while it fetches its copy it falls behind, and then catches up.</summary>
public sealed class LateClientTests(ITestOutputHelper output)
{
    private const double RateBitsPerSecond = 64_000;
    private const int Late = 3;

    [Theory]
    [InlineData(0.3, false)]
    [InlineData(0.6, false)]
    [InlineData(1.5, true)] // more than the link carries: then no copy is of use
    public void Join_OverALinkThatTakesHalfAMinuteForTheCopy_CatchesUp(double load, bool isTooSlow)
    {
        SessionGroup group = new SessionGroup(Large(), 3, LinkProfiles.PureDelay(20)).Connect();
        LinkLeg narrow = new(20) { Bottleneck = new Bottleneck((long)RateBitsPerSecond, 500) };
        group.Network.SetLink(0, Late, narrow);
        group.Network.SetLink(Late, 0, narrow);
        List<string> interruptions = [];
        double pause = 50 / (load * RateBitsPerSecond / 8); // an event takes some 50 bytes of an update
        ClientSession? late = null;
        double fetched = 0;
        for (double at = 0; at < (isTooSlow ? 70 : 150); at += pause)
        {
            if (late is null && at > 2)
            {
                late = group.Join(Late, 77);
                late.Interrupted += interruptions.Add;
            }

            fetched = fetched == 0 && late?.State == SessionState.Running ? at : fetched;
            group.Do(1 + ((int)(at / pause) % 2), PlayerAction.SetVelocity(BodyId.OfScene(0), V(0.1)));
            group.Run(pause);
        }

        output.WriteLine($"in after {fetched - 2:0} s; {interruptions.Count} interruptions {string.Join(" ", interruptions)}; {late!.State} {late.EndReason}");
        Assert.InRange(fetched, 15, 60);
        Assert.Equal(isTooSlow, interruptions.Exists(why => why.Contains("too slow", System.StringComparison.Ordinal)));
        if (!isTooSlow)
        {
            Assert.Empty(interruptions);
            group.Run(5);
            Assert.Equal((group.Host.LogLength, 0), (late.LogLength, (int)late.Counters.StatesDiffered));
        }
    }

    /// <summary>Four hundred balls that nobody touches, and one that is.</summary>
    private static Scene Large()
    {
        SceneBuilder builder = new SceneBuilder("large").WithGravity(V(0)).WithSmallestRadius(0.25);
        for (int n = 0; n < 400; n++)
        {
            builder.AddBody($"ball {n}", Ball(0.3), V(n % 20, n / 20));
        }

        return builder.Build();
    }
}
