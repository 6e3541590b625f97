using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>A client retracts what the host refuses, however late the refusal comes.</summary>
public sealed class RefusedEventTests
{
    private const double History = 0.3;

    [Theory]
    [InlineData(true, true)]
    [InlineData(true, false)]
    [InlineData(false, true)] // nothing gets to the host, but its watermark gets to the sender
    [InlineData(false, false)]
    public void TooLate_LinkCutForLongerThanTheHistory_IsTakenBackByTheSender(bool bothWays, bool keepsMore)
    {
        for (ulong seed = 1; seed <= 5; seed++)
        {
            SessionGroup group = Group(seed, keepsMore ? 60 : 0);
            group.Run(0.2 * seed);
            group.Cut(1, 0);
            if (bothWays)
            {
                group.Cut(0, 1);
            }

            ExternalEvent late = group.Do(1, PlayerAction.Teleport(First, V(0, 3), V(2, 6)));
            group.Run(0.1);
            ExternalEvent spawn = group.Do(1, PlayerAction.Spawn(Ball(0.25), V(0, 4)));
            group.Run(0.5);
            group.Do(0, PlayerAction.Impulse(Second, V(-1, 4))); // and the others have the host's event meanwhile
            group.Run(0.5);
            Assert.True(group.Sessions[1].World!.Simulation.TryRead(spawn.Body, group.Sessions[1].World!.Simulation.SimulatedTo, out _));
            group.Restore(1, 0);
            group.Restore(0, 1);
            ExternalEvent inTime = group.Do(1, PlayerAction.Impulse(Third, V(1, 1)));
            Assert.True(group.Settle(4));
            group.Run(3);

            Assert.Equal([late, spawn], group.Log.Values.Where(e => e.Verdict == Verdict.TooLate).Select(e => e.Event));
            Assert.Contains(inTime, group.Accepted);
            Assert.All(group.Sessions, s => Assert.Equal((2, 2, 0), (s.Counters.EventsAccepted, s.Counters.EventsRefused, s.Counters.EventsLost)));
            Assert.True(group.Difference() is null, $"seed {seed}: {group.Difference()}");
            Assert.NotNull(group.Difference(group.Alone(group.Log.Values.Select(e => e.Event)))); // the refused ones would have shown
        }
    }

    [Fact]
    public void TooLate_LinkCutForLessThanTheHistory_IsAccepted()
    {
        SessionGroup group = Group(1, 0);
        group.Cut(1, 0);
        ExternalEvent late = group.Do(1, PlayerAction.SetVelocity(First, V(2, 6)));
        group.Run(History - 0.1);
        group.Restore(1, 0);
        Assert.True(group.Settle(1));
        Assert.Equal([late], group.Accepted);
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Commit_WhileAnOwnEventIsNotValidated_KeepsWhatTakingItBackNeedsAndNoMore()
    {
        SessionGroup group = Group(3, 0);
        group.Cut(1, 0);
        ExternalEvent late = group.Do(1, PlayerAction.SetVelocity(First, V(2, 6)));
        group.Run(2.5);
        Assert.True(group.Host.World!.Simulation.HistoryEdge > late.Time);
        Assert.True(group.Sessions[1].World!.Simulation.HistoryEdge <= late.Time);
        Assert.True(group.Sessions[2].World!.Simulation.HistoryEdge > late.Time);
        group.Restore(1, 0);
        group.Run(4);
        Assert.True(group.Sessions[1].World!.Simulation.HistoryEdge > late.Time);
    }

    [Fact]
    public void TooLate_AcknowledgedBeforeTheVerdictThenAnOldWatermark_IsStillTakenBack()
    {
        // The host has the event and says so, but its verdict no longer fits into the datagram, and those that follow on it are lost; and an older update,
        // whose watermark holds for a log that ended before all this, comes after it.
        SessionGroup group = Group(1, 0);
        UpdateDatagram read = new();
        byte[] old = [];
        bool acknowledged = false, goesOn = false;
        group.Network.Lose((from, to, datagram) =>
        {
            if (acknowledged || from != 0 || to != 1 || !read.TryDecode(datagram.Span, out _))
            {
                return acknowledged && !goesOn && from == 0 && to == 1;
            }

            acknowledged = read.EventsReceived == 1;
            old = acknowledged || read.Entries.Length > 0 ? old : datagram.ToArray();
            return !acknowledged;
        });
        group.Cut(1, 0);
        ExternalEvent late = group.Do(1, PlayerAction.Teleport(First, V(0, 3), V(2, 6)));
        group.Run(2 * History);
        const int others = 40;
        for (int i = 0; i < others; i++)
        {
            group.Do(0, PlayerAction.Impulse(Second, V(0.01, 0.1)));
        }

        group.Restore(1, 0);
        Assert.True(group.RunUntil(() => acknowledged, 2));
        Assert.True(read.Watermark > late.Time && read.Entries.Length < others);
        Assert.True(read.TryDecode(old, out _) && read.Watermark > late.Time);
        goesOn = true;
        group.Ports[0].Send(old, PeerAddress.Virtual(1));
        Assert.True(group.Settle(others + 1, 4));

        Assert.Equal([late], group.Log.Values.Where(e => e.Verdict == Verdict.TooLate).Select(e => e.Event));
        Assert.All(group.Sessions, s => Assert.Equal((1, 0), (s.Counters.EventsRefused, s.Counters.EventsLost)));
        group.Run(1);
        Assert.True(group.Difference() is null, group.Difference());
    }

    [Fact]
    public void Do_OwnTimeBehindTheHostsWatermark_IsSeenHereAtOnceAndTakenBack()
    {
        // The way from the host becomes shorter all at once: until the clock has been bent, it is behind by more than the history.
        SessionGroup group = new SessionGroup(
            ScriptedActions.Box(), 2, new LinkProfile("uneven", toHost: new LinkLeg(5), fromHost: new LinkLeg(300)), 1,
            _ => new HostOptions { Window = new(SimDuration.FromSeconds(0.05)), KeepAlive = SimDuration.FromSeconds(0.02) }).Connect();
        group.Run(3);
        group.Restore(0, 1);
        group.Run(0.1);
        ExternalEvent behind = group.Do(1, PlayerAction.Teleport(First, V(0, 3), V(2, 6)));
        Assert.True(behind.Time < group.Host.Watermark);
        Simulation world = group.Sessions[1].World!.Simulation;
        Assert.Equal(V(2, 6), Read(world, First, behind.Time).Velocity);

        Assert.True(group.Settle(1, 4));
        Assert.Equal([Verdict.TooLate], group.Log.Values.Select(e => e.Verdict));
        group.Run(4);
        Assert.Equal(0, group.Sessions[1].Counters.EventsLost);
        Assert.True(group.Difference() is null, group.Difference());
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Retract_OfWhatWasAccepted_IsCountedAndNotDone(bool byNumber)
    {
        // No host of ours changes a verdict.
        SessionGroup group = Group(1, 0);
        UpdateDatagram last = new();
        group.Network.Lose((from, to, datagram) =>
        {
            _ = from == 0 && to == 1 && last.TryDecode(datagram.Span, out _);
            return false;
        });
        ExternalEvent own = group.Do(1, PlayerAction.SetVelocity(First, V(2, 6)));
        Assert.True(group.Settle(1, 1));
        group.IsTapped = false;
        last.Number++;
        last.FirstIndex = 2;
        last.ClearEntries();
        _ = byNumber ? last.TryAddOwn(Verdict.TooLate, own.Sequence) : last.TryAdd(Verdict.TooLate, own);
        byte[] bytes = new byte[last.EncodedLength];
        last.Encode(bytes);
        group.Ports[0].Send(bytes, PeerAddress.Virtual(1));
        group.Run(0.02);
        Assert.Equal((1L, 0L), (group.Sessions[1].Counters.EventsForged, group.Sessions[1].Counters.EventsLost));
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Do_ValueThatMayNotEnter_ThrowsAndTakesNoNumber()
    {
        SessionGroup group = Group(1, 0);
        Assert.Throws<SceneException>(() => group.Do(1, PlayerAction.SetVelocity(First, V(double.NaN))));
        Assert.Throws<SceneException>(() => group.Do(1, PlayerAction.Teleport(BodyId.OfScene(99), V(0, 4))));
        Assert.Throws<SceneException>(() => group.Do(0, PlayerAction.Teleport(First, V(0, 2e12))));
        Assert.Equal(1u, group.Do(1, PlayerAction.SetVelocity(First, V(1))).Sequence);
        Assert.True(group.Settle(1));
        Assert.Null(group.Difference());
    }

    private static SessionGroup Group(ulong seed, double extra) => new SessionGroup(
        ScriptedActions.Box(), 3, LinkProfiles.PureDelay(5), seed,
        _ => new HostOptions { Window = new(SimDuration.FromSeconds(History)), ExtraHistory = SimDuration.FromSeconds(extra), KeepAlive = SimDuration.FromSeconds(0.1) }).Connect();
}
