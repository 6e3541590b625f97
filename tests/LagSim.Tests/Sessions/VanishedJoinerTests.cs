using System;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A client that asked to join and then vanished costs the host few datagrams: its address may be of somebody who never asked.</summary>
public sealed class VanishedJoinerTests
{
    private const int Most = 10;

    [Theory]
    [InlineData("Joining", false)]
    [InlineData("Joining", true)]
    [InlineData("Synchronising", false)]
    [InlineData("Synchronising", true)]
    [InlineData("written", false)]
    [InlineData("written", true)]
    [InlineData("seated", false)]
    [InlineData("seated", true)]
    public void Host_OfAClientThatVanishes_SendsItTenDatagramsAtMost(string when, bool isProtected)
    {
        (int sent, SessionGroup group) = SentAfter(when, isProtected, expected: 0);
        Assert.InRange(sent, 0, Most);
        Assert.Equal((0, 0), (group.Host.ComingCount, group.Host.Links.Count)); // and it is given up
    }

    /// <summary>The same while nothing else wakes the host: it waits for more players, and no world moves.</summary>
    [Theory]
    [InlineData("Joining")]
    [InlineData("Synchronising")]
    [InlineData("written")]
    [InlineData("seated")]
    public void Host_ThatHasNotBegun_GivesItUpToo(string when)
    {
        (int sent, SessionGroup group) = SentAfter(when, isProtected: false, expected: 2);
        Assert.InRange(sent, 0, Most);
        Assert.Equal((0, 0), (group.Host.ComingCount, group.Host.Links.Count));
    }

    /// <summary>The control: a player who was in is spoken to until it is given up, since a link may lose many datagrams in a row.</summary>
    [Fact]
    public void Host_OfAPlayerThatVanishes_SendsOn() => Assert.InRange(SentAfter("Running", isProtected: false, expected: 0).Sent, 50, 1_000);

    /// <summary>How many datagrams the host sends in 20 s to a client that joined so far and then neither sent nor received anything.</summary>
    private static (int Sent, SessionGroup Group) SentAfter(string when, bool isProtected, int expected)
    {
        using HostIdentity identity = HostIdentity.Draw();
        SessionGroup group = new(
            BuiltInScenes.Pair(), 1, LinkProfiles.PureDelay(25), options: _ => new HostOptions { Protection = isProtected ? new SecureHost(identity) : null },
            expected: expected);
        group.Run(2);
        bool isGone = false;
        int sent = 0;
        group.Network.Lose((from, _, _) =>
        {
            sent += isGone && from == 0 ? 1 : 0;
            return isGone;
        });
        ClientSession client = group.Join(1, 7, new ClientOptions { Protection = isProtected ? new SecureClient(identity.Fingerprint) : null });
        Assert.True(group.RunUntil(() => when switch
        {
            "written" => client.State == SessionState.Synchronising && client.Links.Count > 0 && client.Links[0].BytesSent > 200,
            "seated" => group.Host.Links.Count > 0,
            _ => client.State >= Enum.Parse<SessionState>(when),
        }));
        isGone = true;
        group.Run(20);
        return (sent, group);
    }
}
