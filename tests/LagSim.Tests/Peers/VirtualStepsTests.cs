using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Peers;

/// <summary>Sessions that stand still, or take the place of others, as processes do that are stopped, or killed and started again.</summary>
public sealed class VirtualStepsTests
{
    private readonly VirtualClock clock = new(SimTime.FromSeconds(10));
    private readonly VirtualNetwork network;
    private readonly VirtualSteps steps;
    private readonly int[] stepped = new int[2];

    public VirtualStepsTests()
    {
        network = new VirtualNetwork(clock, 1, LinkProfiles.PureDelay(5));
        steps = new VirtualSteps(network) { BeforeStep = number => stepped[number]++ };
        IDatagramPort host = network.CreatePort(0), client = network.CreatePort(1);
        steps.Add(new HostSession(BuiltInScenes.Billiards(), host, clock, new HostOptions { ExpectedClients = 1 }, 7), host);
        steps.Add(new ClientSession(null, client, clock, new ClientOptions(), PeerAddress.Virtual(0), 1), client);
        steps.RunFor(SimDuration.FromSeconds(2));
    }

    [Fact]
    public void Freeze_ASession_IsNotSteppedAndGoesOnWithWhatWaitedForIt()
    {
        steps.Freeze(1);
        stepped[1] = 0;
        long before = network.Traffic(1).DatagramsSent;
        steps.RunFor(SimDuration.FromSeconds(5));
        steps.Wake(1);
        steps.RunFor(SimDuration.FromSeconds(1));
        Assert.True(steps.IsFrozen(1));
        Assert.Equal((0, before), (stepped[1], network.Traffic(1).DatagramsSent));
        long ignored = steps.Sessions[1].Counters.DatagramsReceived;

        steps.Thaw(1);
        steps.RunFor(SimDuration.FromSeconds(0.001));
        Assert.False(steps.IsFrozen(1));
        Assert.True(stepped[1] > 0);
        Assert.True(steps.Sessions[1].Counters.DatagramsReceived > ignored); // they had waited
        steps.RunFor(SimDuration.FromSeconds(2));
        Assert.Equal((SessionState.Running, SessionState.Running), (steps.Sessions[0].State, steps.Sessions[1].State));
        Assert.Equal(0, steps.Sessions[1].Counters.StatesDiffered);
    }

    [Fact]
    public void Replace_ASessionThatWasKilled_AnotherStandsInItsPlace()
    {
        steps.Freeze(1);
        PlayerPass pass = ((ClientSession)steps.Sessions[1]).Pass!.Value;
        IDatagramPort port = network.CreatePort(2);
        ClientSession again = new(null, port, clock, new ClientOptions { Pass = pass }, PeerAddress.Virtual(0), 2);
        steps.RunFor(SimDuration.FromSeconds(1));
        steps.Replace(1, again, port);
        steps.RunFor(SimDuration.FromSeconds(2));
        Assert.Same(again, steps.Sessions[1]);
        Assert.Equal((SessionState.Running, 1), (again.State, again.Peer));
        Assert.Equal(1, ((HostSession)steps.Sessions[0]).ClientCount);
    }
}
