using System;
using LagSim.Cli.Commands;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>What is said to a host while it runs.</summary>
[Collection(RealTime.Name)]
[Trait("Time", "real")]
public sealed class HostAdminTests
{
    [Theory]
    [InlineData("kick", "'kick' lacks the player's number; 'players' tells who is there.")]
    [InlineData("Kick 1", "'Kick 1' is no command; there are: " + HostAdmin.Syntax + ".")]
    [InlineData("kick 0", "'0' is no player's number; it must be 1 to 48.")]
    [InlineData("ban -1", "'-1' is no player's number; it must be 1 to 48.")]
    [InlineData("remove-bodies 256", "'256' is no player's number; it must be 1 to 48.")]
    [InlineData("kick 7", "There is no player 7.")]
    [InlineData("ban 7", "There is no player 7.")]
    [InlineData("unban 10.0.0.1", "'10.0.0.1' is not banned; banned are: none.")]
    [InlineData("remove-bodies 7", "0 bodies of player 7 are removed.")]
    public void Do_WhatCannotBe_SaysWhatCan(string line, string answer)
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(10)).Connect();
        Assert.Equal(answer, new HostAdmin().Do(line, group.Host));
        Assert.Equal(1, group.Host.ClientCount);
    }

    /// <summary>Two processes, and a line on the host's standard input.</summary>
    [Fact]
    public void Host_ToldToBanAPlayer_SendsItAwayAndLetsItInNoMore()
    {
        using ToolProcess host = ToolProcess.Start("host --scene pair --joiners 1 --admin");
        using ToolProcess player = ToolProcess.Start($"join {host.Address}");
        player.Says("T 1 ");
        host.Types("players");
        host.Says("player 1 at 127.0.0.1:");
        host.Types("ban 1");
        host.Says("Player 1 is disconnected, and nobody can join from 127.0.0.1 any more.");
        player.Ends(3);
        Assert.Contains("sent this player away", player.ToString(), StringComparison.Ordinal);
        using ToolProcess again = ToolProcess.Start($"join {host.Address}");
        again.Ends(3);
        Assert.Contains("it has shut out this player, or this address", again.ToString(), StringComparison.Ordinal);
        host.Types("unban 127.0.0.1");
        host.Says("Players from 127.0.0.1 may come in again.");
        using ToolProcess third = ToolProcess.Start($"join {host.Address}");
        third.Says("T ");
    }
}
