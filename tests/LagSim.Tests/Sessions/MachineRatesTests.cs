using System.Net;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Hosts;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>The pace at which pieces of copies are given is a machine's, whatever port or address of its network it asks from.</summary>
public sealed class MachineRatesTests
{
    [Theory]
    [InlineData("10.0.0.1", "10.0.0.1", true)]
    [InlineData("10.0.0.1", "10.0.0.2", false)]
    [InlineData("2001:db8:1:2::1", "2001:db8:1:2:ffff::9", true)] // one network of IPv6 is one machine's
    [InlineData("2001:db8:1:2::1", "2001:db8:1:3::1", false)]
    [InlineData("::ffff:10.0.0.1", "10.0.0.1", true)]
    public void TrySpend_IsSharedByWhatIsOneMachine(string one, string other, bool isShared)
    {
        MachineRates paces = new(perSecond: 100, burst: 10);
        PeerAddress first = Address(one, 1000), second = Address(other, 2000);
        Assert.Equal((isShared, isShared), (first.IsSameMachine(second), first.Machine == second.Machine));
        SimTime now = SimTime.FromSeconds(1);
        for (int n = 0; n < 10; n++)
        {
            Assert.True(paces.TrySpend(first, now));
        }

        Assert.False(paces.TrySpend(first, now));
        Assert.Equal(!isShared, paces.TrySpend(second, now));
        Assert.True(paces.TrySpend(first, now + SimDuration.FromMilliseconds(10.1)));
    }

    [Fact]
    public void Machines_ThatHaveTheirWholePaceAgain_AreForgotten()
    {
        MachineRates paces = new(perSecond: 2000, burst: 256);
        SimTime now = SimTime.FromSeconds(1);
        for (int n = 0; n < 10_000; n++)
        {
            now += SimDuration.FromMilliseconds(1);
            Assert.True(paces.TrySpend(NatPort.Address(n, 1000), now));
            Assert.InRange(paces.Count, 1, 65);
        }
    }

    /// <summary>A flood of machines that nobody hears of again is forgotten by the next one that asks after a while.</summary>
    [Fact]
    public void Machines_OfAFloodThatIsOver_AreForgotten()
    {
        MachineRates rates = new(perSecond: 1, burst: 8);
        SimTime now = SimTime.FromSeconds(1);
        for (int n = 0; n < 1000; n++)
        {
            Assert.True(rates.TrySpend(NatPort.Address(n, 1000), now));
        }

        Assert.Equal(1000, rates.Count);
        Assert.True(rates.TrySpend(NatPort.Address(1000, 1000), now + SimDuration.FromSeconds(20)));
        Assert.Equal(1, rates.Count);
    }

    private static PeerAddress Address(string address, int port) => PeerAddress.From(new IPEndPoint(IPAddress.Parse(address), port));
}
