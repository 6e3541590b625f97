using System.Collections.Generic;
using LagSim.Events;
using LagSim.Rollback;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.LooseParts;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rollback;

/// <summary>What a heal changes of impacts is reported once it is certain: not too soon, not twice, and in order.</summary>
public sealed class HeldBackImpactsTests
{
    private readonly Notes notes = new();
    private readonly HeldBackImpacts impacts;

    public HeldBackImpactsTests() => impacts = new HeldBackImpacts { Listener = notes };

    [Fact]
    public void OnContact_NothingHeldBack_IsReportedAtOnce()
    {
        Contact(1);
        Cut(1);
        Assert.Equal(["contact 1", "cut 1"], notes.All);
    }

    [Fact]
    public void OnContact_HeldBack_IsReportedOnRelease()
    {
        impacts.Hold();
        Contact(1);
        Cut(1);
        Assert.Empty(notes.All);
        impacts.Release(SimTime.MaxValue);
        Assert.Equal(["contact 1", "cut 1"], notes.All);
    }

    /// <summary>An impact at the very instant counts as done; a later one was put back as it was, so nothing of it has changed.</summary>
    [Fact]
    public void Release_UpToAnInstant_ReportsTheChangesUpToItInTheirOrder()
    {
        impacts.Hold();
        Cut(3);
        Cut(2);
        Contact(1);
        Contact(2);
        Contact(3);
        impacts.Release(At(2));
        Assert.Equal(["cut 2", "contact 1", "contact 2"], notes.All);
    }

    [Fact]
    public void Release_ASecondTime_ReportsNeitherTheSameNorWhatWasDropped()
    {
        impacts.Hold();
        Contact(1);
        Contact(3);
        impacts.Release(At(2));
        impacts.Hold();
        impacts.Release(SimTime.MaxValue);
        Assert.Equal(["contact 1"], notes.All);
    }

    [Fact]
    public void OnContact_AfterRelease_IsReportedAtOnceWhateverItsTime()
    {
        impacts.Hold();
        impacts.Release(At(2));
        Contact(3);
        Assert.Equal(["contact 3"], notes.All);
    }

    private void Contact(double seconds) =>
        impacts.OnContact(Key(seconds, EventKind.Impact), new ImpactContact(First, First, 0, V(0), 1));

    private void Cut(double seconds) => impacts.OnCut(Key(seconds, EventKind.Impact));

    private sealed class Notes : IImpactObserver
    {
        internal List<string> All { get; } = [];

        public void OnContact(in EventKey impact, in ImpactContact contact) => All.Add($"contact {impact.Time.ToSeconds()}");

        public void OnCut(in EventKey impact) => All.Add($"cut {impact.Time.ToSeconds()}");
    }
}
