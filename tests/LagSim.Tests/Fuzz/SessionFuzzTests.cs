using System.Threading;
using LagSim.Harness.Verification.Fuzz;
using Xunit;

namespace LagSim.Tests.Fuzz;

/// <summary>Tests that run when no other does.</summary>
[CollectionDefinition("alone", DisableParallelization = true)]
public sealed class Alone;

/// <summary>Whatever strangers send, and whatever of a session is played again, it goes on; and nothing at all makes it throw.</summary>
/// <remarks>Beside other tests the memory in use would say nothing.</remarks>
[Collection("alone")]
public sealed class SessionFuzzTests
{
    [Fact]
    public void Sessions_UnderHundredsOfThousandsOfHostileDatagrams_NeverThrowAndGoOn()
    {
        FuzzReport report = SessionFuzz.Run(300_000, 1, null, CancellationToken.None);
        Assert.True(report.Failure is null, report.Failure);
        Assert.Equal((300_000, 273), (report.Packets, report.Sessions));
        Assert.InRange(report.Malformed, 60_000, 280_000);
        Assert.InRange(report.Ignored, 60_000, 280_000);
        Assert.InRange(report.SessionsBroken, 1, 136); // who has a peer's address can break its session: the attack reaches something
        Assert.InRange(report.RetainedBytes, -50_000_000, 2_000_000);
        Assert.InRange(report.SessionGrowthBytes, 1, 1_200_000); // looked at, and no more than an honest session's
        Assert.True(report.StrangerBytesReceived > 0);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Flood_OfTwentyThousandOverRealSockets_IsSurvived(bool isProtected)
    {
        FloodReport report = RealFlood.Run(30, 20_000, 1, isProtected, null, CancellationToken.None);
        Assert.True(report.Failure is null, report.Failure);
        Assert.True(report.GarbageSent + report.ReplaysSent + report.JoinsSent >= 20_000 && report.ReplaysSent > 5_000, $"{report}");
        Assert.True(report.Malformed > 100 && report.Ignored > 1_000, $"{report}");
        Assert.Equal(report.EventsDone, report.EventsAgreed);
        Assert.Equal(isProtected, report.Forged > 10);
        Assert.NotNull(report.JoinSeconds);
        Assert.NotEqual(0, report.RetainedBytes); // it was looked at
    }

    [Fact]
    public void Sessions_ThatKeepSomethingOfEachDatagram_AreSeenToFail()
    {
        FuzzReport report = SessionFuzz.Run(10_000, 1, null, port => new LeakingPort(port), CancellationToken.None);
        Assert.Matches("^Seed 1: the memory of a living session grew by [0-9]{7,} bytes over its last 1500 packets.$", report.Failure);
        Assert.True(report.SessionGrowthBytes > 1_500 * 2_048, $"{report}");
    }

    [Fact]
    public void Flood_OfPeersThatKeepSomethingOfEachDatagram_IsSeenToFail()
    {
        FloodReport report = RealFlood.Run(30, 20_000, 1, isProtected: false, null, port => new LeakingPort(port), CancellationToken.None);
        Assert.Matches("^Memory grew by [0-9]{8,} bytes during the flood.$", report.Failure);
    }

    [Fact]
    public void Run_SameSeedTwice_IsTheSame()
    {
        FuzzReport once = SessionFuzz.Run(5_000, 7, null, CancellationToken.None);
        FuzzReport twice = SessionFuzz.Run(5_000, 7, null, CancellationToken.None);
        // A session id is drawn by the system: whether a changed byte leaves it what it was, and so what the answer is, is not the seed's.
        Assert.Equal(once with { RetainedBytes = 0, SessionGrowthBytes = 0, StrangerBytesReceived = 0 }, twice with { RetainedBytes = 0, SessionGrowthBytes = 0, StrangerBytesReceived = 0 });
        Assert.NotEqual(once with { RetainedBytes = 0, SessionGrowthBytes = 0 }, SessionFuzz.Run(5_000, 8, null, CancellationToken.None) with { RetainedBytes = 0, SessionGrowthBytes = 0 });
    }
}
