using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A session ends once, and nothing that comes later revives it.</summary>
public sealed class SessionStatusTests
{
    [Fact]
    public void End_Twice_KeepsTheFirstReasonAndIsToldOnce()
    {
        SessionStatus status = new(SessionState.Waiting);
        int told = 0;
        status.Ended += () =>
        {
            told++;
            Assert.Equal((SessionState.Ended, SessionEnd.Left, "first"), (status.State, status.EndedBy, status.EndReason));
        };
        status.End(SessionEnd.Left, "first");
        status.End(SessionEnd.Failed, "second");
        Assert.Equal((1, SessionEnd.Left, "first"), (told, status.EndedBy, status.EndReason));
    }

    [Theory]
    [InlineData(SessionState.Waiting, SessionState.Running)]
    [InlineData(SessionState.Synchronising, SessionState.Running)]
    [InlineData(SessionState.Ended, SessionState.Ended)]
    [InlineData(SessionState.Rejoining, SessionState.Rejoining)]
    public void BeginRunning_RunsUnlessEndedOrRejoining(SessionState before, SessionState after)
    {
        SessionStatus status = new(before);
        status.BeginRunning();
        Assert.Equal(after, status.State);
    }

    [Fact]
    public void Rejoin_KeepsItsReasonWhenItIsOver()
    {
        SessionStatus status = new(SessionState.Running);
        status.Rejoin("why");
        Assert.True(status.IsRejoining);
        status.State = SessionState.Waiting;
        Assert.Equal("why", status.RejoiningBecause);
    }
}
