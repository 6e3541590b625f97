using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Each step of a join has a sentence of its own, and a join that fails ends with the last of them.</summary>
public sealed class WhyNotRunningTests
{
    [Fact]
    public void Join_StepByStep_SaysEachThatIsNotDoneYet()
    {
        SessionGroup group = new(ManyBalls(), 1, LinkProfiles.PureDelay(40), expected: 1, options: _ => new HostOptions { StartLead = SimDuration.FromSeconds(2) });
        Assert.StartsWith("The session has not begun: its thread was not started", group.Host.WhyNotRunning, StringComparison.Ordinal);
        group.Run(0.5);
        Assert.Equal("0 of the 1 players that this host waits for are in.", group.Host.WhyNotRunning);
        ClientSession client = group.Join(7, 99);
        List<string> said = [];
        Assert.True(group.RunUntil(() =>
        {
            said.Add(client.WhyNotRunning ?? "");
            return client.State == SessionState.Running;
        }));

        Assert.Equal("", said[^1]);
        string[] expected =
        [
            "The session has not begun: ", "No answer from the host yet.", "The host answered, and has not let this peer in yet.", "This peer has ",
            "The session begins in ",
        ];
        int[] at = [.. expected.Select(begin => said.FindIndex(s => s.StartsWith(begin, StringComparison.Ordinal)))];
        Assert.True(at.All(n => n >= 0) && at.SequenceEqual(at.Order()), string.Join("\n", said.Distinct()));
        Assert.Contains(said, s => s.StartsWith("This peer has ", StringComparison.Ordinal) && s.EndsWith(" kB of the copy of the world.", StringComparison.Ordinal)
            && !s.StartsWith("This peer has 0 of", StringComparison.Ordinal));
        group.Run(0.1);
        Assert.Null(group.Host.WhyNotRunning);
    }

    [Fact]
    public void Join_WhileOthersAreMissing_SaysWhoWaitsForWhom()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5), expected: 2);
        List<string?> said = [];
        Assert.True(group.RunUntil(() =>
        {
            said.Add(group.Sessions[1].WhyNotRunning);
            return group.Sessions[1].State == SessionState.Waiting;
        }));
        Assert.Contains("This peer measures the offset of its clock from that of the host.", said);
        group.Run(2);
        Assert.Equal(SessionState.Waiting, group.Sessions[1].State);
        Assert.Equal("This peer is in. The host has not begun the session: it waits for other players.", group.Sessions[1].WhyNotRunning);
        Assert.Equal("1 of the 2 players that this host waits for are in.", group.Host.WhyNotRunning);
    }

    [Fact]
    public void Join_WithoutAnswer_SaysSoAndEndsWithForHowLong()
    {
        SessionGroup group = new(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(5));
        group.Steps.Freeze(0);
        ClientSession client = group.Join(7, 99);
        group.Run(5.05);
        Assert.Equal("No answer from the host yet.", client.WhyNotRunning);
        group.Run(6);
        Assert.Equal("No answer from the host within 10 s.", client.EndReason);
        Assert.Equal(client.EndReason, client.WhyNotRunning);
    }

    [Fact]
    public void Join_ThatLosesTheHostOnTheWay_EndsWithHowFarItCame()
    {
        SessionGroup group = new(ManyBalls(), 1, LinkProfiles.PureDelay(40));
        ClientSession client = group.Join(7, 99);
        Assert.True(group.RunUntil(() => client.WhyNotRunning?.StartsWith("This peer has ", StringComparison.Ordinal) == true));
        group.Steps.Freeze(0);
        Assert.True(group.RunUntil(() => client.State == SessionState.Ended));
        Assert.StartsWith("The host fell silent for 10 s. This peer has ", client.EndReason, StringComparison.Ordinal);
        Assert.EndsWith(" kB of the copy of the world.", client.EndReason, StringComparison.Ordinal);
    }

    [Fact]
    public void Join_AnsweredButNotDecided_EndsWithThat()
    {
        SessionGroup group = new(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(5));
        group.Network.Lose((from, _, datagram) => from == 0 && datagram.Span[3] == (byte)DatagramType.Welcome);
        ClientSession client = group.Join(7, 99);
        Assert.True(group.RunUntil(() => client.State == SessionState.Ended));
        Assert.Equal("The host answered, and did not let this peer in within 10 s.", client.EndReason);
    }

    [Fact]
    public void Full_ForOneWhoComesBack_IsSaidWhileItAsksAndAtTheEnd()
    {
        HostOptions one = new() { MaxClientsPerAddress = 1, RejoinTime = SimDuration.FromSeconds(4), Timeout = SimDuration.FromSeconds(2), KeepAlive = SimDuration.FromSeconds(0.5) };
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5), options: _ => one).Connect();
        foreach ((int from, int to) in new[] { (0, 1), (1, 0) })
        {
            group.Cut(from, to);
        }

        group.Run(2.5);
        ClientSession client = group.Client(1);
        Assert.Equal(SessionState.Rejoining, client.State);
        Assert.Equal("The host fell silent for 2 s. Asking to be let in again.", client.WhyNotRunning);
        for (int n = 0; n < SessionOptions.MaxClients; n++)
        {
            ClientSession other = group.Join(20 + n, 200 + (ulong)n);
            Assert.True(group.RunUntil(() => other.State == SessionState.Running, 2), other.EndReason);
        }

        group.Restore(0, 1);
        group.Restore(1, 0);
        group.Run(0.3);
        Assert.Equal("The host fell silent for 2 s. The host refused: the session is full. This peer asks again each second.", client.WhyNotRunning);
        Assert.True(group.RunUntil(() => client.State == SessionState.Ended));
        Assert.Equal(
            "The host fell silent for 2 s. This peer asked for 4 s to be let in again, in vain. The host refused: the session is full.", client.EndReason);
    }

    [Theory]
    [InlineData("wrong", "The host refused: the key is wrong.")]
    [InlineData("", null)] // the control: the right one
    public void Join_ByAKey_SaysWhatIsWrongWithIt(string key, string? expected)
    {
        SessionGroup group = new(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(5));
        ClientSession client = group.Join(7, 99, new ClientOptions { ConnectKey = key });
        group.Run(2);
        Assert.Equal(expected, client.WhyNotRunning);
    }

    /// <summary>A scene whose copy takes many datagrams.</summary>
    private static Scene ManyBalls()
    {
        SceneBuilder builder = new SceneBuilder("many").WithSmallestRadius(0.25).AddPlane("floor", Vector3D.Up, V(0), 0.9);
        for (int n = 0; n < 400; n++)
        {
            builder.AddBody($"ball {n}", Ball(0.3), V(2 * n, 1));
        }

        return builder.Build();
    }
}
