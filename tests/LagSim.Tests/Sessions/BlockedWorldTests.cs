using System;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>
/// A host whose world stands at an instant with more impacts than can be followed waits for an event, and is not busy meanwhile.
/// </summary>
public sealed class BlockedWorldTests
{
    [Fact]
    public void Step_OfAHostWhoseWorldStands_WaitsUntilItEndsWithASentence()
    {
        // A light ball between a wall and a heavy one that comes, without a loss.
        BodySpec light = new(0.5, 1, 1), heavy = new(0.5, 1e30, 1);
        Vector3D right = new(1, 0, 0);
        Scene scene = new SceneBuilder("squeeze").WithGravity(Vector3D.Zero).AddPlane("wall", right, 0.0)
            .AddBody("light", light, right * 0.5).AddBody("heavy", heavy, right * 4, -right).Build();
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
        Assert.Contains("have no end", host.EndReason, StringComparison.Ordinal);
    }
}
