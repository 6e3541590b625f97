using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Clients;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>A client whose committed state is not the host's says since when, and which event makes the difference, in both versions; nobody else notices.</summary>
public sealed class DivergenceTests
{
    private readonly SessionGroup group = new(
        ScriptedActions.Box(), 3, LinkProfiles.PureDelay(20), options: _ => new HostOptions { Window = new(SimDuration.FromMilliseconds(200)) });
    private readonly FaultyEngineParts parts = new(); // of the third's world
    private readonly List<Divergence> told = [];
    private readonly UpdateDatagram read = new();
    private readonly byte[] buffer = new byte[WireFormat.MaxBytes];

    public DivergenceTests()
    {
        group.Sessions[2].Put(parts);
        group.Connect();
        group.Client(2).Diverged += told.Add;
    }

    private SimTime Start => group.Host.World!.Simulation.Start;

    [Fact]
    public void Hash_AsItIs_IsNoDivergence()
    {
        Play(40);
        Assert.Empty(told);
        Assert.All(group.Sessions.Skip(1), s => Assert.True(s.Counters.StatesAgreed >= 2 && s.Counters.StatesDiffered == 0));
        Assert.Null(group.Client(2).Divergence);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(150)] // more than one answer tells
    public void Event_ThatARelayTurnsIntoARefusedOne_IsNamedInBothVersions(int before)
    {
        // The client is told that an accepted event was refused, and so goes on without it.
        uint place = (uint)before + 1;
        List<(byte Peer, SimTime At)> said = [];
        group.Host.ClientDiverged += (peer, at) => said.Add((peer, at));
        group.IsTapped = false;
        Change(update => update.FirstIndex <= place && update.FirstIndex + update.Entries.Length > place, update =>
        {
            UpdateEntry[] entries = update.Entries.ToArray();
            update.ClearEntries();
            for (uint n = 0; n < entries.Length; n++)
            {
                Verdict verdict = update.FirstIndex + n == place ? Verdict.Invalid : entries[n].Verdict;
                Assert.True(entries[n].IsOwn ? update.TryAddOwn(verdict, entries[n].Sequence) : update.TryAdd(verdict, entries[n].Event));
            }
        });
        group.Run(1.2); // some states agree first
        for (int i = 0; i < before; i++)
        {
            group.Do(0, PlayerAction.Impulse(Second, V(0.01, 0.01)));
        }

        group.Run(0.01);
        ExternalEvent changed = group.Do(1, PlayerAction.SetVelocity(First, V(1, 5)));
        group.Run(3);

        Divergence found = Assert.Single(told);
        Assert.Equal(DivergenceFinding.EventDiffers, found.Finding);
        Assert.Equal(new LogEntry(place, Verdict.Accepted, changed), found.HostVersion);
        Assert.Equal(new LogEntry(place, Verdict.Invalid, changed), found.OwnVersion);
        Assert.False(found.HasOwnEffect);
        Assert.True(found.After < changed.Time && changed.Time <= found.At);
        Assert.Equal(before, found.Events.Count);
        Assert.NotEqual(found.OwnHash, found.HostHash);
        Assert.Same(found, group.Client(2).Divergence);
        Assert.Equal([(group.Client(2).Peer, found.At)], said);
        string sentences = found.ToString();
        Assert.Contains($"at the host entry {place} of the log", sentences, StringComparison.Ordinal);
        Assert.Contains("Invalid: ", sentences, StringComparison.Ordinal);
        AssertOthersGoOn();
    }

    [Fact]
    public void Event_ThatCameTooLateForTheHistoryHere_IsCountedAndTheWorldReplaced()
    {
        // Between two instants to be committed: the first is, and the second is still to come.
        Play(20);
        Simulation world = group.Sessions[2].World!.Simulation;
        SimTime Next() => group.Sessions[2].Committed!.Value.Time + SimDuration.FromSeconds(1);
        for (int i = 0; i < 30 && world.SimulatedTo + SimDuration.FromSeconds(0.3) > Next(); i++)
        {
            group.Do(0, PlayerAction.SetVelocity(Second, V(1, 2))); // who has nothing to tell tells the watermark rarely
            group.Run(0.05);
        }

        SimTime next = Next();
        ExternalEvent late = group.Do(1, PlayerAction.SetVelocity(First, V(1, 5)));
        group.Run(0.02);
        world.DropHistoryBefore(world.SimulatedTo);
        Assert.True(world.HistoryEdge > late.Time && world.HistoryEdge < next);
        List<string> renewed = [];
        group.Sessions[2].Renewed += renewed.Add;
        group.Run(3);
        Assert.Contains("came too late", Assert.Single(renewed), StringComparison.Ordinal);
        SessionCounters counters = group.Sessions[2].Counters;
        Assert.Equal((1L, 1L, SessionState.Running), (counters.EventsLost, counters.Renewals, group.Sessions[2].State));
        Assert.NotSame(world, group.Sessions[2].World!.Simulation);
        Assert.Null(group.Difference());
        AssertOthersGoOn();
    }

    [Fact]
    public void World_ThatMakesSomethingElseOfTheSameEvents_IsSaidToDoSo()
    {
        parts.SwapsOperands = true;
        parts.Healing = HealingFault.ForgetsThePast | HealingFault.CutsByTime;
        Play(60);
        Divergence found = Assert.Single(told);
        Assert.Equal(DivergenceFinding.EventsAgree, found.Finding);
        Assert.Null(found.HostVersion ?? found.OwnVersion);
        AssertOthersGoOn();
    }

    [Fact]
    public void Hash_ThatLies_IsReportedOnceAndTheSessionGoesOn()
    {
        group.IsTapped = false;
        bool lies = true;
        Change(update => lies && update.HasStateHash, update => update.Hashes[0] ^= 1);
        Play(30);
        lies = false;
        Play(30);
        Divergence found = Assert.Single(told);
        Assert.Equal((DivergenceFinding.EventsAgree, found.OwnHash ^ 1), (found.Finding, found.HostHash));
        SessionCounters counters = group.Client(2).Counters;
        Assert.True(counters.StatesDiffered is > 0 and < 8 && counters.StatesAgreed > 0, $"{counters.StatesDiffered} {counters.StatesAgreed}");
        Assert.Equal(found.At, counters.FirstDifference);
        Assert.Null(group.Difference());
        AssertOthersGoOn();
    }

    [Fact]
    public void Host_ThatDoesNotAnswer_IsSaidNotToAfterTheTimeout()
    {
        group.Network.Lose((from, to, datagram) => from == 0 && to == 2 && datagram.Span[3] == (byte)DatagramType.DesyncReport);
        group.Sessions[2].World!.Simulation.Submit(ExternalEvent.SetVelocity(group.Host.SharedTime.Now, 9, 1, First, V(0, 3))); // what nobody knows of
        Assert.True(group.RunUntil(() => group.Client(2).Divergence is not null));
        group.Run(2);
        Assert.Equal(DivergenceFinding.Asking, group.Client(2).Divergence!.Finding);
        Assert.Empty(told);
        Assert.True(group.RunUntil(() => told.Count > 0, 60));
        Assert.Equal(DivergenceFinding.Unanswered, Assert.Single(told).Finding);
        AssertOthersGoOn();
    }

    [Fact]
    public void DesyncQuery_OfAStrangerOrOfWhatIsNotCommittedOrTooOften_IsCountedAndNotAnswered()
    {
        RawClient raw = new(group);
        group.Run(1.5);
        raw.Received();
        SimTime now = group.Host.SharedTime.Now, past = Start + SimDuration.FromSeconds(1);
        long ignored = group.Host.Counters.DatagramsIgnored;
        Ask(raw, raw.SessionId + 1, raw.Peer, 1, past);
        Ask(raw, raw.SessionId, (byte)(raw.Peer + 1), 1, past);
        Ask(raw, raw.SessionId, raw.Peer, 0, past);
        Ask(raw, raw.SessionId, raw.Peer, 1, now);
        Assert.Equal(ignored + 4, group.Host.Counters.DatagramsIgnored);
        Assert.DoesNotContain(raw.Received(), d => d.Type == DatagramType.DesyncReport);

        // The control: in its own name, of what is committed; and then as often as it likes.
        int answers = 0;
        for (uint n = 1; n <= 100; n++)
        {
            Ask(raw, raw.SessionId, raw.Peer, n, past);
            answers += raw.Received().Count(d => d.Type == DatagramType.DesyncReport);
        }

        Assert.InRange(answers, 16, 20);
        Assert.Equal(ignored + 104 - answers, group.Host.Counters.DatagramsIgnored);
        AssertOthersGoOn();
    }

    [Fact]
    public void DesyncReport_ThatNobodyAskedForOrThatDoesNotFit_IsCountedAndChangesNothing()
    {
        DesyncQuery inquiry = new(At(1), At(2), At(0));
        Assert.False(inquiry.Take(new DesyncReportDatagram(1, 2000, 0, 1, ExternalEvent.Remove(At(1.5), 1, 1, First)), At(0))); // more than a host keeps
        Assert.False(inquiry.Take(new DesyncReportDatagram(1, 2, 1, 1, ExternalEvent.Remove(At(1.5), 1, 1, First)), At(0))); // not the next
        Assert.False(inquiry.Take(new DesyncReportDatagram(1, 2, 0, 1, ExternalEvent.Remove(At(2.5), 1, 1, First)), At(0))); // not asked for
        Assert.True(inquiry.Take(new DesyncReportDatagram(1, 2, 0, 1, ExternalEvent.Remove(At(1.5), 1, 1, First)), At(0)));
        Assert.False(inquiry.Take(new DesyncReportDatagram(1, true), At(0))); // none after all
        Assert.False(inquiry.IsComplete);
        Assert.True(inquiry.Take(new DesyncReportDatagram(1, 2, 1, 2, ExternalEvent.Remove(At(2), 1, 2, First)), At(0)));
        Assert.True(inquiry.IsComplete && inquiry.IsWhole && inquiry.Events.Count == 2);

        long ignored = group.Client(2).Counters.DatagramsIgnored;
        group.Ports[0].Send(AnyDesyncReport(), PeerAddress.Virtual(2));
        group.Run(0.1);
        Assert.Equal(ignored + 1, group.Client(2).Counters.DatagramsIgnored);
        Assert.Empty(told);
        AssertOthersGoOn();
    }

    [Fact]
    public void Recent_MoreThanAreKept_KnowsThatItIsNotWhole()
    {
        RecentEvents recent = new();
        for (uint n = 1; n <= RecentEvents.Most + 10; n++)
        {
            recent.Add(new LogEntry(n, n % 2 == 0 ? Verdict.Accepted : Verdict.TooLate, ExternalEvent.Remove(At(n), 1, n, First)), hasEffect: n % 4 != 0);
        }

        Assert.False(recent.IsWholeAfter(At(9)));
        Assert.True(recent.IsWholeAfter(At(10)));
        Assert.Equal([14u, 18, 22], recent.Between(At(10), At(22)).Select(e => e.Index));
        Assert.True(recent.TryFind(ExternalEvent.Remove(At(12), 1, 12, First), out LogEntry found, out bool hasEffect) && found.Index == 12 && !hasEffect);
        Assert.False(recent.TryFind(ExternalEvent.Remove(At(5), 1, 5, First), out _, out _));
    }

    private static byte[] AnyDesyncReport()
    {
        byte[] bytes = new byte[WireFormat.EmptyDesyncReportBytes];
        new DesyncReportDatagram(1, true).Encode(bytes);
        return bytes;
    }

    private void Ask(RawClient raw, ulong session, byte peer, uint number, SimTime upTo)
    {
        byte[] bytes = new byte[WireFormat.DesyncQueryBytes];
        new DesyncQueryDatagram(session, peer, number, Start, upTo, 0).Encode(bytes);
        raw.Send(bytes);
        group.Run(0.005);
    }

    /// <summary>A tenth of a second each, and something done in all of them.</summary>
    private void Play(int tenths)
    {
        for (int i = 0; i < tenths; i++)
        {
            group.Do(i % 2, PlayerAction.SetVelocity(i % 3 == 0 ? First : Second, V(((i * 7) % 5) - 2, ((i * 3) % 7) - 3)));
            group.Run(0.1);
        }

        group.Run(1);
    }

    /// <summary>Has what is true of the host's updates to the second client said otherwise on their way.</summary>
    private void Change(Func<UpdateDatagram, bool> isIt, Action<UpdateDatagram> change)
    {
        bool isOwn = false;
        group.Network.Lose((from, to, datagram) =>
        {
            if (isOwn || from != 0 || to != 2 || !read.TryDecode(datagram.Span, out _) || !isIt(read))
            {
                return false;
            }

            change(read);
            isOwn = true;
            group.Ports[0].Send(buffer.AsSpan(0, read.Encode(buffer)), PeerAddress.Virtual(2));
            isOwn = false;
            return true;
        });
    }

    private void AssertOthersGoOn()
    {
        group.Run(1);
        Assert.All(group.Sessions, s => Assert.Equal(SessionState.Running, s.State));
        Assert.Equal((0L, 0L), (group.Client(1).Counters.StatesDiffered, group.Host.Counters.StatesDiffered));
        ExternalEvent last = group.Do(2, PlayerAction.SetVelocity(First, V(0, 1))); // and the one that differs still takes part
        Assert.True(group.RunUntil(() => group.Log.Values.Any(e => e.Event.Equals(last)) && group.Sessions.All(s => s.LogLength == group.Host.LogLength), 3));
    }
}
