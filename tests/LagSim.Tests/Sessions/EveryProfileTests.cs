using System;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A host with eight clients for a minute of virtual time, on every kind of link.</summary>
/// <remarks>
/// Without any extra history: who heard of an event after its own watermark would lose it, and a hash of each second's committed state, which is compared with the
/// host's, tells of the time that nobody keeps any more.
/// </remarks>
public sealed class EveryProfileTests
{
    private const double Seconds = 60;

    public static TheoryData<string> Profiles => [.. LinkProfiles.All.Select(profile => profile.Name)];

    [Theory]
    [MemberData(nameof(Profiles))]
    public void Worlds_HostWithEightClientsForAMinute_HaveNotOneDifferingBit(string profile)
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
        // Every datagram that holds it: the client waits for it from then on, and stands still.
        UpdateDatagram read = new();
        SessionGroup group = Play("4g", 2, 60, (group, from, to, datagram) => from == 0 && to == 4 && read.TryDecode(datagram.Span, out _)
            && read.Entries.Length > 0 && read.FirstIndex <= 40 && read.FirstIndex + read.Entries.Length > 40);
        string? difference = group.Difference();
        Assert.True(difference?.StartsWith("peer 4", StringComparison.Ordinal), difference);
    }

    [Fact]
    public void Check_RelayThatTakesOneEventOutOfItsDatagrams_IsSeenByTheSessionItself()
    {
        // The client is told that it was refused, and goes on: the hashes that it compares with the host's are what tells.
        UpdateDatagram read = new();
        byte[] buffer = new byte[WireFormat.MaxBytes];
        bool isOwn = false;
        int taken = 0;
        SessionGroup group = Play("4g", 2, 0, (group, from, to, datagram) =>
        {
            uint place = Accepted(group);
            if (isOwn || from != 0 || to != 4 || place == 0 || !read.TryDecode(datagram.Span, out _)
                || read.FirstIndex > place || read.FirstIndex + read.Entries.Length <= place)
            {
                return false;
            }

            UpdateEntry[] entries = read.Entries.ToArray();
            read.ClearEntries();
            for (uint n = 0; n < entries.Length; n++)
            {
                Verdict verdict = read.FirstIndex + n == place ? Verdict.Invalid : entries[n].Verdict;
                Assert.True(entries[n].IsOwn ? read.TryAddOwn(verdict, entries[n].Sequence) : read.TryAdd(verdict, entries[n].Event));
            }

            isOwn = true;
            group.Ports[0].Send(buffer.AsSpan(0, read.Encode(buffer)), PeerAddress.Virtual(4));
            isOwn = false;
            taken++;
            return true;
        });
        Assert.True(taken > 0);
        Assert.All(group.Sessions, s => Assert.Equal((SessionState.Running, group.Host.LogLength), (s.State, s.LogLength)));
        SessionCounters robbed = group.Sessions[4].Counters;
        Assert.True(robbed.StatesDiffered > 0 && robbed.StatesAgreed > 5, $"{robbed.StatesDiffered} differed, {robbed.StatesAgreed} agreed");
        Assert.InRange((robbed.FirstDifference - group.Log[Accepted(group)].Event.Time).ToSeconds(), 0, 1);
        Assert.All(group.Sessions.Where(s => s != group.Sessions[4]), s => Assert.Equal(0, s.Counters.StatesDiffered));
        Assert.Equal(1, robbed.Renewals); // it does not go on with what it knows to be wrong; that it was wrong stays counted
        Assert.Null(group.Difference());

        // The first accepted velocity of another from the tenth line on: early enough for its body to be there still.
        static uint Accepted(SessionGroup group) => group.Log.FirstOrDefault(e => e.Key >= 10 && e.Value.Verdict == Verdict.Accepted
            && e.Value.Event.Peer != group.Sessions[4].Peer && e.Value.Event.Kind == EventKind.SetVelocity).Key;
    }

    private static SessionGroup Play(string profile, ulong seed, double extraHistory = 0, Func<SessionGroup, int, int, ReadOnlyMemory<byte>, bool>? loses = null)
    {
        Assert.True(LinkProfiles.TryGet(profile, out LinkProfile? link, out _));
        SessionGroup group = new(ScriptedActions.Box(), 9, link, seed, _ => new HostOptions { Window = new(SimDuration.FromSeconds(5)), ExtraHistory = SimDuration.FromSeconds(extraHistory), Timeout = SimDuration.FromSeconds(loses is null ? 10 : 600) });
        group.Connect();
        if (loses is not null)
        {
            group.IsTapped = false; // what it changes is not the host's
            group.Network.Lose((from, to, datagram) => loses(group, from, to, datagram));
        }

        SimTime end = group.Clock.Now + SimDuration.FromSeconds(Seconds);
        ScriptedActions actions = new((int)seed, maxSpawns: 4); // a heap of dozens in that box would take longer than all the rest
        int done = 0;
        while (group.Clock.Now < end)
        {
            done += actions.DoIn(group, 1).Count;
            group.Run(0.25);
        }

        group.Settle(done, loses is null ? 60 : 5);
        group.Run(8); // so that all of it is committed
        return group;
    }
}
