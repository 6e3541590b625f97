using System.Collections.Generic;
using LagSim.Net.Sessions.Clients;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A client's tries to come in: each has a nonce of its own, and the time for an answer runs while its machine is awake.</summary>
public sealed class JoinAttemptsTests
{
    [Fact]
    public void Restart_EachTry_HasAnotherNonce()
    {
        JoinAttempts attempts = new(7, SimTime.Zero);
        HashSet<ulong> nonces = [attempts.Current!.Nonce];
        for (int n = 0; n < 1000; n++)
        {
            attempts.Restart(SimTime.Zero);
            Assert.True(nonces.Add(attempts.Current!.Nonce));
        }
    }

    [Fact]
    public void Since_IsTheNewestOfFirstStepTryAndWaking()
    {
        JoinAttempts attempts = new(7, SimTime.FromSeconds(1));
        attempts.Begin(SimTime.FromSeconds(2));
        Assert.Equal(SimTime.FromSeconds(2), attempts.Since);
        attempts.Begin(SimTime.FromSeconds(3)); // not the first step any more
        Assert.Equal(SimTime.FromSeconds(2), attempts.Since);
        attempts.Restart(SimTime.FromSeconds(5));
        Assert.Equal(SimTime.FromSeconds(5), attempts.Since);
        attempts.NoteSuspend(SimDuration.FromSeconds(20), SimTime.FromSeconds(30));
        Assert.Equal((SimTime.FromSeconds(22), SimTime.FromSeconds(30)), (attempts.Began, attempts.Since));
    }

    [Fact]
    public void Finish_EndsTheAsking()
    {
        JoinAttempts attempts = new(7, SimTime.Zero);
        Assert.True(attempts.IsAsking);
        attempts.Finish();
        Assert.Equal((false, null), (attempts.IsAsking, attempts.Current));
    }
}
