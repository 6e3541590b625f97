using System;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Rules;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>
/// A host whose world stands at an instant in which the rules fail waits for an event, and is not busy meanwhile.
/// </summary>
public sealed class BlockedWorldTests
{
    [Fact]
    public void Step_OfAHostWhoseWorldStands_WaitsUntilItEndsWithASentence()
    {
        // A ball that comes to a wall at 3 s, and rules that cannot bear it.
        GivenRules rules = new() { Hears = (_, _, _) => true, Contact = (_, _) => throw new InvalidOperationException("No such wall.") };
        Vector3D right = new(1, 0, 0);
        Scene scene = new SceneBuilder("wall").WithGravity(Vector3D.Zero).AddPlane("wall", right, 0.0)
            .AddBody("ball", new BodySpec(0.5, 1, 1), right * 3.5, -right).WithRules(rules).Build();
        VirtualClock clock = new(SimTime.FromSeconds(10));
        VirtualNetwork network = new(clock, 1, LinkProfiles.Lan);
        HostOptions options = new()
        {
            ExpectedClients = 0,
            PlayerBudget = null,
            Window = new(SimDuration.FromSeconds(3), SimDuration.FromMilliseconds(100)),
            Cancellation = TestContext.Current.CancellationToken,
        };
        HostSession host = new(scene, network.CreatePort(0), clock, options, 1);
        SimDuration longest = SimDuration.FromSeconds(1);
        int steps = 0, whileBlocked = 0;
        while (host.State != SessionState.Ended && clock.Now < SimTime.FromSeconds(30) && steps < 10_000)
        {
            SimDuration wait = host.Step();
            steps++;
            whileBlocked += host.World?.BlockedAt < SimTime.MaxValue ? 1 : 0;
            clock.Now += wait < SimDuration.OneTick ? SimDuration.OneTick : wait < longest ? wait : longest;
        }

        Assert.InRange(whileBlocked, 10, 1000); // a commit is due while it stands, and cannot come
        Assert.Equal(SessionState.Ended, host.State);
        Assert.Contains("No such wall", host.EndReason, StringComparison.Ordinal);
    }
}
