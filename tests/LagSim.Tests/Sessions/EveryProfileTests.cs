using System;
using System.Linq;
using LagSim.Harness.Links;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A host with eight joiners for a minute of virtual time, on every kind of link.</summary>
public sealed class EveryProfileTests
{
    private const double Seconds = 60;

    public static TheoryData<string> Profiles => [.. LinkProfiles.All.Select(profile => profile.Name)];

    [Theory]
    [MemberData(nameof(Profiles))]
    public void Worlds_HostWithEightJoinersForAMinute_HaveNotOneDifferingBit(string profile)
    {
        SessionGroup group = Play(profile, 1);
        Assert.All(group.Sessions, s => Assert.Equal(SessionState.Running, s.State));
        Assert.Equal(0, group.Host.Counters.EventsRefused);
        Assert.All(group.Sessions, s => Assert.Equal(0, s.Counters.EventsLost + s.Counters.EventsForged + s.Counters.StatesDiffered));
        Assert.True(group.Difference() is null, group.Difference());
        Assert.All(group.Sessions.Skip(1), s => Assert.True(s.Counters.StatesAgreed > Seconds / 3, $"{s.Counters.StatesAgreed} compared"));
        Assert.True(group.Log.Count > 150, $"{group.Log.Count} events");
        Assert.True(group.Sessions.Sum(s => s.Counters.Heals) > 300, "next to nothing came late");
    }

    [Theory]
    [InlineData("awful")]
    [InlineData("starlink")]
    public void Play_SameSeedTwice_IsTheSameToTheBitAndTheDatagram(string profile)
    {
        string once = Trace(Play(profile, 5));
        Assert.Equal(once, Trace(Play(profile, 5)));
        Assert.NotEqual(once, Trace(Play(profile, 6)));

        static string Trace(SessionGroup group) => string.Join(" ", group.Sessions.Select(
            s => $"{s.Committed} {s.Counters.DatagramsSent} {s.Links.Sum(l => l.BytesSent)}"));
    }

    [Fact]
    public void Check_RelayThatLosesOneEventForGood_IsSeenToFail()
    {
        UpdateDatagram read = new();
        SessionGroup group = Play("4g", 2, (from, to, datagram) => from == 0 && to == 4 && read.TryDecode(datagram.Span, out _)
            && read.Entries.Length > 0 && read.FirstIndex <= 40 && read.FirstIndex + read.Entries.Length > 40);
        string? difference = group.Difference();
        Assert.True(difference?.StartsWith("peer 4", StringComparison.Ordinal), difference);
    }

    private static SessionGroup Play(string profile, ulong seed, Func<int, int, ReadOnlyMemory<byte>, bool>? loses = null)
    {
        Assert.True(LinkProfiles.TryGet(profile, out LinkProfile? link, out _));
        SessionGroup group = new(Deeds.Box(), 9, link, seed, _ => new SessionOptions { History = SimDuration.FromSeconds(5), ExtraHistory = SimDuration.FromSeconds(60), Timeout = SimDuration.FromSeconds(loses is null ? 10 : 600) });
        group.Connect();
        if (loses is not null)
        {
            group.Network.Lose(loses);
        }

        SimTime end = group.Clock.Now + SimDuration.FromSeconds(Seconds);
        Deeds deeds = new((int)seed, mostSpawns: 4); // a heap of dozens in that box would take longer than all the rest
        int done = 0;
        while (group.Clock.Now < end)
        {
            done += deeds.DoIn(group, 1).Count;
            group.Run(0.25);
        }

        group.Settle(done, loses is null ? 60 : 5);
        group.Run(8); // so that all of it is committed
        return group;
    }
}
