using LagSim.Events;
using LagSim.Rollback;
using Xunit;
using static LagSim.Tests.LooseParts;

namespace LagSim.Tests.Rollback;

/// <summary>The bodies that have to be rewound: each request is taken out once, the newest first.</summary>
public sealed class RewindRequestsTests
{
    private readonly RewindRequests requests = new();

    [Fact]
    public void TryTake_NothingAsked_GivesNothing()
    {
        Assert.True(requests.AreNone);
        Assert.False(requests.TryTake(out _, out _));
    }

    [Fact]
    public void TryTake_TwoAsked_GivesEachOnceTheNewestFirst()
    {
        requests.Add(5, Key(1, EventKind.Impact));
        requests.Add(3, Key(2, EventKind.StepEnd));
        Assert.False(requests.AreNone);
        Assert.True(requests.TryTake(out int slot, out EventKey key));
        Assert.Equal((3, Key(2, EventKind.StepEnd)), (slot, key));
        Assert.False(requests.AreNone);
        Assert.True(requests.TryTake(out slot, out key));
        Assert.Equal((5, Key(1, EventKind.Impact)), (slot, key));
        Assert.True(requests.AreNone);
        Assert.False(requests.TryTake(out _, out _));
    }

    /// <summary>A body may have to be rewound to two keys; neither request takes the place of the other.</summary>
    [Fact]
    public void Add_OneBodyTwice_KeepsBothRequests()
    {
        requests.Add(5, Key(1, EventKind.Impact));
        requests.Add(5, Key(2, EventKind.Impact));
        Assert.True(requests.TryTake(out _, out EventKey newest));
        Assert.True(requests.TryTake(out _, out EventKey oldest));
        Assert.True(oldest < newest);
    }

    [Fact]
    public void Clear_SomeAsked_LeavesNone()
    {
        requests.Add(5, Key(1, EventKind.Impact));
        requests.Clear();
        Assert.True(requests.AreNone);
        Assert.False(requests.TryTake(out _, out _));
    }
}
