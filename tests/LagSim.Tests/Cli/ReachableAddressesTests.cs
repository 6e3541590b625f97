using System.Linq;
using System.Net;
using LagSim.Cli.Commands;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>The addresses that a host prints for others to join at.</summary>
public sealed class ReachableAddressesTests
{
    private const string Both = "127.0.0.1 192.0.2.7 ::1 fe80::1 2001:db8::7 198.51.100.3";

    [Theory]
    [InlineData("::", Both, "2001:db8::7 192.0.2.7 198.51.100.3")]
    [InlineData("::", "::1 127.0.0.1 192.0.2.7", "192.0.2.7")] // a machine without IPv6 to the outside
    [InlineData("::", "::1 127.0.0.1 2001:db8::7", "2001:db8::7")]
    [InlineData("::", "::1 fe80::1 127.0.0.1", "::1 127.0.0.1")]
    [InlineData("0.0.0.0", Both, "192.0.2.7 198.51.100.3")] // the control: there is no IPv6 on it
    [InlineData("0.0.0.0", "127.0.0.1 2001:db8::7", "127.0.0.1")]
    [InlineData("192.0.2.7", Both, "192.0.2.7")]
    [InlineData("::1", Both, "::1")]
    public void Of_AnAddress_IsAllThatReachesIt(string local, string machine, string reachable) => Assert.Equal(
        reachable.Split(' '),
        ReachableAddresses.Of(IPAddress.Parse(local), () => machine.Split(' ').Select(IPAddress.Parse)).Select(address => address.ToString()));
}
