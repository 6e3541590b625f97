using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Hosting;

/// <summary>
/// A world goes on as a copy of a committed state, as a client's does that joins again: what the former world had predicted is confirmed
/// with its identity where the copy has it to come, and unresolved where it may have happened before the copy. None of that is retracted.
/// </summary>
public sealed class UnresolvedNoticesTests
{
    [Theory]
    [InlineData(1.55, true)] // the copy is of before the bounces that were predicted and not confirmed
    [InlineData(1.9, true)] // of between them
    [InlineData(3.0, true)] // of after all of them
    [InlineData(1.6, false)] // the control: the copy has another course, so that nothing comes again
    public void Retire_AndGoOnAsACopy_RetractsOnlyWhatDoesNotHappen(double copied, bool isSame)
    {
        ContactNotices contacts = new();
        List<ContactNotice> told = [];
        contacts.Noticed += told.Add;
        LiveWorld former = new(Bounces(3), new SimulationOptions(history: SimDuration.FromSeconds(1)), SimDuration.FromSeconds(0.5), contacts: contacts);
        for (double t = 0.02; t <= 2; t += 0.02)
        {
            former.Step(At(t));
        }

        int before = told.Count;
        former.Retire();
        Assert.All(told.Skip(before), one => Assert.Equal(NoticeKind.InDoubt, one.Kind));
        Assert.InRange(told.Count - before, 3, 12);
        Simulation host = new(Bounces(isSame ? 3 : 0.01), KeepAll);
        host.AdvanceTo(At(copied));
        LiveWorld copy = new(host.Scene, host.Snapshot(At(copied)), new SimulationOptions(history: SimDuration.FromSeconds(1)), SimDuration.FromSeconds(0.5), contacts: contacts);
        for (double t = copied; t <= 8; t += 0.02)
        {
            copy.Step(At(t));
        }

        int unresolved = 0, again = 0;
        foreach (IGrouping<long, ContactNotice> one in told.GroupBy(notice => notice.Id))
        {
            ContactNotice last = one.Last();
            Assert.Equal(1, one.Count(notice => notice.Kind == NoticeKind.Predicted));
            Assert.Equal(NoticeKind.Predicted, one.First().Kind);
            Assert.True(isSame ? last.Kind != NoticeKind.Retracted : last.Kind != NoticeKind.Confirmed || last.Time < At(1.5), $"{last.Kind} at {last.Time}");
            Assert.True(last.Kind != NoticeKind.Unresolved || last.Time < At(copied + 0.5));
            Assert.True(last.Kind != NoticeKind.Retracted || last.Time >= At(copied + 0.5)); // what is sooner may have moved to before the copy
            unresolved += last.Kind == NoticeKind.Unresolved ? 1 : 0;
            again += last.Kind == NoticeKind.Confirmed && one.Any(notice => notice.Kind == NoticeKind.InDoubt) ? 1 : 0;
        }

        Assert.Equal(copied > 1.6 || !isSame, unresolved > 0);
        Assert.Equal(copied < 2.5 && isSame, again > 0);
        Assert.Equal(isSame, told.All(notice => notice.Kind != NoticeKind.Retracted));
    }

    private static Scene Bounces(double speed) => new SceneBuilder("bounces").WithGravity(Vector3D.Zero)
        .AddPlane("west", V(1), -0.5).AddPlane("east", V(-1), -0.5).AddBody("ball", new BodySpec(0.1, 1, 1), V(0), V(speed)).Build();
}
