using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Timelines;

/// <summary>A rollback counts each body that it touches once, and the next rollback starts from zero.</summary>
public sealed class RollbackStateTests
{
    private readonly RollbackState rollback = new();

    public RollbackStateTests()
    {
        rollback.AddSlot(0);
        rollback.AddSlot(1);
    }

    [Fact]
    public void IsActive_OnlyBetweenBeginAndEnd()
    {
        Assert.False(rollback.IsActive);
        Begin(rollback, At(1));
        Assert.True(rollback.IsActive);
        rollback.End();
        Assert.False(rollback.IsActive);
    }

    [Fact]
    public void Touch_OneBodyTwice_CountsItOnce()
    {
        Begin(rollback, At(1));
        Assert.True(rollback.Touch(1));
        Assert.False(rollback.Touch(1));
        Assert.Equal(1, rollback.BodyCount);
        Assert.True(rollback.Touch(0));
        Assert.Equal(2, rollback.BodyCount);
    }

    [Fact]
    public void HasTouched_BodyThatWasNot_IsFalse()
    {
        Begin(rollback, At(1));
        rollback.Touch(1);
        Assert.True(rollback.HasTouched(1));
        Assert.False(rollback.HasTouched(0));
    }

    /// <summary>Once a rollback is done, what it touched can still be asked for, until the next begins.</summary>
    [Fact]
    public void HasTouched_AfterTheEnd_LastsUntilTheNextRollback()
    {
        Begin(rollback, At(1));
        rollback.Touch(1);
        rollback.End();
        Assert.True(rollback.HasTouched(1));
        Begin(rollback, At(2));
        Assert.False(rollback.HasTouched(1));
        Assert.Equal(0, rollback.BodyCount);
        Assert.True(rollback.Touch(1));
    }

    /// <summary>A slot that is given to another body carries nothing over from the one that had it, and other slots keep theirs.</summary>
    [Fact]
    public void AddSlot_OfABodyThatIsForgotten_IsUntouched()
    {
        Begin(rollback, At(1));
        rollback.Touch(0);
        rollback.Touch(1);
        rollback.AddSlot(1);
        Assert.False(rollback.HasTouched(1));
        Assert.True(rollback.HasTouched(0));
    }

    /// <summary>Room for many bodies is made without losing what was noted of the first ones.</summary>
    [Fact]
    public void AddSlot_ManyMore_KeepsWhatWasTouched()
    {
        Begin(rollback, At(1));
        rollback.Touch(1);
        for (int slot = 2; slot < 100; slot++)
        {
            rollback.AddSlot(slot);
            Assert.False(rollback.HasTouched(slot));
        }

        Assert.True(rollback.HasTouched(1));
        Assert.Equal(1, rollback.BodyCount);
    }

    private static void Begin(RollbackState rollback, SimTime horizon) => rollback.Begin(RollbackKind.CausalCone, horizon);
}
