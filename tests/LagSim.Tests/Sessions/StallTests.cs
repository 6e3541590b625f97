using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>
/// A machine that stood still for nearly as long as an exchange of clocks may take: what then arrives late says little of the host's clock,
/// and is not taken for a jump of it.
/// </summary>
public sealed class StallTests
{
    [Theory]
    [InlineData(30)]
    [InlineData(58.5)]
    [InlineData(59)]
    [InlineData(59.5)]
    [InlineData(59.9)]
    [InlineData(61)]
    public void Stall_OfAClient_IsNoJumpOfItsClock(double seconds)
    {
        for (int seed = 1; seed <= 3; seed++)
        {
            VirtualClock clock = new(SimTime.FromSeconds(10));
            VirtualNetwork network = new(clock, (ulong)seed, LinkProfiles.PureDelay(5 * seed));
            VirtualSteps steps = new(network);
            IDatagramPort hostPort = network.CreatePort(0), port = network.CreatePort(1);
            HostOptions options = new() { Timeout = SimDuration.FromSeconds(300) };
            steps.Add(new HostSession(ScriptedActions.Box(), hostPort, clock, options, 1), hostPort);
            ClientSession client = new(null, port, clock, ClientOptions.From(options), PeerAddress.Virtual(0), 4);
            int number = steps.Add(client, port);
            steps.RunFor(SimDuration.FromSeconds(5 + (0.21 * seed)));
            Assert.Equal(SessionState.Running, client.State);
            List<string> interrupted = [];
            client.Interrupted += interrupted.Add;
            steps.Freeze(number);
            steps.RunFor(SimDuration.FromSeconds(seconds));
            steps.Thaw(number);
            steps.RunFor(SimDuration.FromSeconds(10));
            Assert.Empty(interrupted);
            Assert.Equal(SessionState.Running, client.State);
            Assert.InRange((client.SharedTime.Now - clock.Now).ToSeconds(), -0.001, 0.001);
        }
    }
}
