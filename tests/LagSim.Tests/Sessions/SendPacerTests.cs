using LagSim.Net.Sessions.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Updates that are hurried keep their distance in the mean, but for three after a pause.</summary>
public sealed class SendPacerTests
{
    private static readonly SimTime Start = SimTime.FromSeconds(1);

    [Fact]
    public void Flush_AgainAndAgain_KeepsTheDistanceInTheMean()
    {
        SendPacer pacer = new(Start);
        SimDuration apart = SimDuration.FromMilliseconds(10);
        for (int n = 0; n < 100; n++)
        {
            SimTime now = SimTime.Max(Start, pacer.Due);
            pacer.NoteSent(now, apart);
            pacer.Rest(now, SimDuration.FromSeconds(1));
            pacer.Flush(now);
        }

        Assert.Equal(Start + (apart * 98), pacer.Due); // two are ahead
    }

    [Fact]
    public void Rest_IsAtLeastTheLeastDistance()
    {
        SendPacer pacer = new(Start);
        pacer.NoteSent(Start, SendPacer.MinDistance);
        pacer.Rest(Start, SimDuration.Zero);
        Assert.Equal(Start + SendPacer.MinDistance, pacer.Due);
    }

    [Fact]
    public void GoOn_WhereThereIsRoom_LetsAFewGoAtOnce()
    {
        SendPacer pacer = new(Start);
        for (int n = 1; n <= SendWindow.MaxDatagramsAtOnce; n++)
        {
            pacer.NoteSent(Start, SendPacer.MinDistance);
            pacer.GoOn(Start);
            Assert.Equal(n < SendWindow.MaxDatagramsAtOnce ? Start : Start + SendPacer.MinDistance, pacer.Due);
        }
    }
}
