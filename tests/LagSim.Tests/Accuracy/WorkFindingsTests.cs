using System;
using System.Linq;
using LagSim.Harness.Experiments.Accuracy;
using Xunit;

namespace LagSim.Tests.Accuracy;

/// <summary>The sentences that say who is in front, and the slopes, from points that are made up.</summary>
public sealed class WorkFindingsTests
{
    [Fact]
    public void Sentences_OfAPeerThatIsSlowerEverywhere_SayByHowMuchAtLeast()
    {
        string sentence = Assert.Single(WorkFindings.Sentences([Own(1e-6, 1), Own(1e-9, 10), Peer(1e-2, 3), Peer(1e-6, 4)]));
        Assert.Equal("scene: in front of peer at every error, by 3 times at least.", sentence);
    }

    [Fact]
    public void Sentences_OfAPeerThatIsFasterSomewhere_NameWhereAndByWhatFactor()
    {
        string sentence = Assert.Single(WorkFindings.Sentences([Own(1e-6, 1), Peer(1e-2, 0.25), Peer(1e-6, 4)]));
        Assert.Equal("scene: NOT in front of peer at 1/10 s (error 0.01): LagSim law takes 4 times as long for that error or less.", sentence);
    }

    [Fact]
    public void Sentences_OfTwoPeers_BeginWithTheSceneAsAWhole()
    {
        WorkPoint second = Peer(1e-2, 9) with { Method = "second" };
        Assert.Equal(
            ["scene: in front of every peer at every error, by 3 times at least (peer at 1/10 s).", "scene: in front of peer at every error, by 3 "
                + "times at least.",
                "scene: in front of second at every error, by 9 times at least."],
            WorkFindings.Sentences([Own(1e-6, 1), Peer(1e-2, 3), second]));
        Assert.Equal(
            "scene: NOT in front at 1 of 2 points of 2 peers, named below; in front at all others by 9 times at least (second at 1/10 s).",
            WorkFindings.Sentences([Own(1e-6, 1), Peer(1e-2, 0.5), second])[0]);
    }

    [Fact]
    public void Sentences_OfAPeerThatIsMoreExactThanAnySetting_SaySo()
    {
        string sentence = Assert.Single(WorkFindings.Sentences([Own(1e-6, 1), Peer(1e-7, 1000)]));
        Assert.Equal("scene: NOT in front of peer at 1/10 s: no setting of LagSim is as exact as 1e-7 m.", sentence);
    }

    [Fact]
    public void Sentences_OfOtherKindsOfErrorAndOfWhatIsNotFinite_AreNotMade()
    {
        WorkPoint other = Peer(0, 0) with { ErrorKind = "other" };
        Assert.Empty(WorkFindings.Sentences([Own(1e-6, 1), Peer(double.NaN, 0.1), other]));
    }

    [Fact]
    public void Sentences_OfDenseContact_HaveOneForEachOtherKindOfErrorToo()
    {
        WorkPoint[] points =
        [
            Own(1e-6, 1), Own(0, 1) with { ErrorKind = "energy_gained_relative" }, Own(1e-5, 1) with { ErrorKind = "drift_at_rest_m" },
            Peer(1e-2, 3), Peer(0, 3) with { ErrorKind = "energy_gained_relative" }, Peer(1e-9, 3) with { ErrorKind = "drift_at_rest_m" },
        ];
        Assert.Equal(
            [
                "scene: in front of peer at every error, by 3 times at least.",
                "scene, energy gained: in front of every peer at every error, by 3 times at least (peer at 1/10 s).", // both are nothing
                "scene, drift at rest: NOT in front at 1 of 1 point of 1 peer.",
            ],
            WorkFindings.Sentences(points));
    }

    [Fact]
    public void Sentences_OfHeapsThatWereDrawn_AreOneOverAll()
    {
        WorkPoint[] points = [.. new[] { "heaps-1", "heaps-2" }.SelectMany(
            (heap, n) => new[] { Own(1e-6, 1) with { Scene = heap }, Peer(1e-2, 0.5 + n) with { Scene = heap } })];
        Assert.Equal(
            "2 heaps drawn at random: NOT in front at 1 of 2 points of 1 peer; in front at all others by 1.5 times at least (peer at"
                + " 1/10 s).",
            Assert.Single(WorkFindings.Sentences(points)));
    }

    [Fact]
    public void Sentences_WhereNoSettingOfLagSimWasDone_SaySo() => Assert.Equal(
        "scene: NOT in front of anybody: no setting of LagSim was done.", Assert.Single(WorkFindings.Sentences([Peer(1e-2, 3)])));

    [Fact]
    public void Cost_BetweenTwoSettings_LiesOnTheLineThatJoinsThem()
    {
        WorkPoint[] curve = [Own(1e-2, 1), Own(1e-6, 100)];
        Assert.Equal(10, WorkFindings.Cost(curve, 1e-4), 12);
        Assert.Equal(1, WorkFindings.Cost(curve, 1), 12);
        Assert.Equal(100, WorkFindings.Cost(curve, 1e-6), 12);
        Assert.True(double.IsPositiveInfinity(WorkFindings.Cost(curve, 9e-7)));
    }

    [Fact]
    public void Order_OfErrorsThatFallWithTheThirdPower_IsThreeAndOfTooFewPointsNone()
    {
        Assert.True(WorkScenes.TryGet("spring", out WorkScene? spring)); // rounding 1e-14, size 1
        WorkPoint[] points = [.. Enumerable.Range(0, 12).Select(n => Own(0, 1) with { StepSeconds = Math.Pow(2, -n), Error = Math.Pow(8, -n) })];
        WorkOrder order = WorkOrder.Of(spring, points)!;
        Assert.Equal(3, order.Slope, 12);
        Assert.Equal(4, order.Points);

        // Neither rounding nor what is no result counts: the three between 1e-12 and 0.1 do.
        WorkPoint[] few = [.. points.Take(5)];
        Assert.Equal(3, WorkOrder.Of(spring, [.. few, Own(1e-13, 1) with { StepSeconds = 1e-9 }, Own(7, 1) with { StepSeconds = 9 }])!.Points);
        Assert.Null(WorkOrder.Of(spring, few.Take(4)));
    }

    private static WorkPoint Own(double error, double cpu) => new("scene", "LagSim law", "1/1 s", 1, error, "max_position_error_m", cpu, 3, 1, 1);

    private static WorkPoint Peer(double error, double cpu) => new("scene", "peer", "1/10 s", 0.1, error, "max_position_error_m", cpu, 3, 1, 1);
}
