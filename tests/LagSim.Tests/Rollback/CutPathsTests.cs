using System.Collections.Generic;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.LooseParts;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rollback;

/// <summary>Copies of segments that were cut: put back to the bit, and compared to the bit with what was made in their place.</summary>
public sealed class CutPathsTests
{
    private readonly CutPaths cut = new();
    private readonly BodyTable bodies = new(2);
    private readonly TimelineStore timelines = new(default);

    [Fact]
    public void PutBack_AllThatWasCut_RestoresTheTimelinesToTheBit()
    {
        AddTwoStruck(bodies, timelines);
        ulong before = timelines.EventHash;
        CutBothToTheStart();
        Assert.NotEqual(before, timelines.EventHash);
        cut.PutBack(timelines, At(0.5), bodies);
        Assert.Equal(before, timelines.EventHash);
        Assert.Equal([0, 1], Openings(timelines, 0));
        Assert.Equal([0, 1, 2], Openings(timelines, 1));
    }

    /// <summary>
    /// Only segments opened after the instant are put back. Earlier ones, and those of the instant itself, have been simulated again.
    /// </summary>
    [Fact]
    public void PutBack_FromTheInstantOfTheImpact_LeavesTheImpactOut()
    {
        AddTwoStruck(bodies, timelines);
        CutBothToTheStart();
        cut.PutBack(timelines, At(1), bodies);
        Assert.Equal([0], Openings(timelines, 0));
        Assert.Equal([0, 2], Openings(timelines, 1));
    }

    /// <summary>The segments of one impact are cut together the next time too; those of two impacts at one instant are not.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void PutBack_SegmentsOfOneInstant_AreJoinedIfOneImpactOpenedThem(bool byOneImpact)
    {
        AddTwoStruck(bodies, timelines, byOneImpact);
        CutBothToTheStart();
        cut.PutBack(timelines, At(0.5), bodies);
        int first = timelines.Last(0);
        int second = timelines.Previous(timelines.Last(1));
        Assert.Equal(byOneImpact ? second : first, timelines.Together(first));
        Assert.Equal(byOneImpact ? first : second, timelines.Together(second));
    }

    /// <summary>What a heal has made itself, and cuts again, is no part of the past; what stood before it is.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void PutBack_SegmentOpenedByTheHeal_IsLeftOut(bool isOfTheHeal)
    {
        AddTwoStruck(bodies, timelines);
        long lastSerial = timelines.LastSerial;
        timelines.Append(0, First, Key(1.5, EventKind.SetVelocity), Flight(1.5, V(0.5), V(0, 1)), default);
        cut.Begin(isOfTheHeal ? lastSerial : timelines.LastSerial);
        cut.Touch(0);
        CutLast(0, 2);
        cut.PutBack(timelines, At(0.5), bodies);
        Assert.Equal(isOfTheHeal ? [0, 1] : [0, 1, 1.5], Openings(timelines, 0));
    }

    [Fact]
    public void HaveReconverged_BodyNotYetMadeAnew_HoldsUntilItsFirstCutSegmentBegan()
    {
        AddTwoStruck(bodies, timelines);
        cut.Begin(timelines.LastSerial);
        cut.Touch(0);
        CutLast(0, 1);
        Assert.True(cut.HaveReconverged(timelines, At(0.99)));
        Assert.False(cut.HaveReconverged(timelines, At(1)));
    }

    [Theory]
    [InlineData(-1.0, true)]
    [InlineData(-1.0000000000000002, false)] // the next double
    public void HaveReconverged_SegmentMadeAnew_HoldsIfItIsTheSameToTheBit(double velocity, bool areMet)
    {
        AddTwoStruck(bodies, timelines);
        EventKey impact = timelines.Key(timelines.Last(0));
        cut.Begin(timelines.LastSerial);
        cut.Touch(0);
        CutLast(0, 1);
        timelines.Append(0, First, impact, Flight(1, V(1), V(velocity)), default);
        Assert.Equal(areMet, cut.HaveReconverged(timelines, At(1)));
    }

    /// <summary>A member of an island is only back on its path if it carries the same impulses into its next step.</summary>
    [Theory]
    [InlineData(3.0, true)]
    [InlineData(3.0000000000000004, false)] // the next double
    public void HaveReconverged_MemberMadeAnew_HoldsIfItCarriesTheSame(double push, bool areMet)
    {
        AddTwoStruck(bodies, timelines);
        AppendMember(timelines, 3);
        ulong before = timelines.EventHash;
        cut.Begin(timelines.LastSerial);
        cut.Touch(0);
        CutLast(0, 1);
        AppendMember(timelines, push);
        Assert.Equal(areMet, cut.HaveReconverged(timelines, At(2)));
        Assert.Equal(areMet, before == timelines.EventHash);
    }

    [Fact]
    public void PutBack_MemberOfAnIsland_CarriesWhatItDid()
    {
        AddTwoStruck(bodies, timelines);
        AppendMember(timelines, 3);
        ulong before = timelines.EventHash;
        cut.Begin(timelines.LastSerial);
        cut.Touch(0);
        CutLast(0, 1);
        Assert.NotEqual(before, timelines.EventHash);
        cut.PutBack(timelines, At(1), bodies);
        Assert.Equal(before, timelines.EventHash);
        PersistentContact carried = Assert.Single(timelines.Carried.CopyOf(timelines.Last(0)));
        Assert.Equal(V(0, 3), carried.Push);
    }

    [Theory]
    [InlineData(CutPaths.Most, true)]
    [InlineData(CutPaths.Most + 1, false)]
    public void IsWhole_AfterManyCuts_HoldsUpToTheMost(int cuts, bool isWhole)
    {
        AddBody(bodies, timelines, Ball(), Key(0, EventKind.Start), Flight(0, V(0), V(1)));
        for (int n = 1; n <= cuts; n++)
        {
            timelines.Append(0, First, Key(n, EventKind.SetVelocity), Flight(n, V(n), V(1)), default);
        }

        cut.Begin(timelines.LastSerial);
        cut.Touch(0);
        CutLast(0, cuts);
        Assert.Equal(isWhole, cut.IsWhole);
    }

    [Theory]
    [InlineData(CutPaths.Most, true)]
    [InlineData(CutPaths.Most + 1, false)]
    public void IsWhole_AfterManyBodies_HoldsUpToTheMost(int touched, bool isWhole)
    {
        cut.Begin(0);
        for (int slot = 0; slot < touched; slot++)
        {
            cut.Touch(slot);
        }

        Assert.Equal(isWhole, cut.IsWhole);
    }

    private static List<double> Openings(TimelineStore timelines, int slot)
    {
        List<double> openings = [];
        for (int at = timelines.First(slot); at != TimelineStore.None; at = timelines.Next(at))
        {
            openings.Add(timelines.Key(at).Time.ToSeconds());
        }

        return openings;
    }

    private static void AppendMember(TimelineStore timelines, double push)
    {
        MotionSegment step = new(MotionLaw.Constrained, At(2), At(2.125), V(0), V(0), default);
        timelines.Append(0, First, Key(2, EventKind.StepEnd), step, default);
        timelines.BeginMember(timelines.Last(0), At(2.0625), At(2));
        timelines.Carried.Add(timelines.Last(0), new PersistentContact(First, 0, true, V(0, push)));
        timelines.EndMember(timelines.Last(0), First);
    }

    private void CutBothToTheStart()
    {
        cut.Begin(timelines.LastSerial);
        cut.Touch(1);
        cut.Touch(0);
        CutLast(1, 2);
        CutLast(0, 1);
    }

    private void CutLast(int slot, int count)
    {
        for (int n = 0; n < count; n++)
        {
            cut.Keep(timelines, slot, timelines.Last(slot));
            timelines.CutLast(slot, BodyId.OfScene(slot));
        }
    }
}
