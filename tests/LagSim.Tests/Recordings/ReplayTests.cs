using System;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.Recordings.Recorded;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Recordings;

public sealed class ReplayTests
{
    [Fact]
    public void Run_ARecordedRun_GivesItsHashes()
    {
        RecordingReplay replay = Replayed(Read(Small()));

        Assert.Equal(ReplayOutcome.Agrees, replay.Outcome);
        Assert.Equal((5, 5, Start + Seconds(2)), (replay.StatesChecked, replay.EventsApplied, replay.AgreedUpTo));
        Assert.Equal(World(Log).StateHash(Start + Seconds(2)), replay.Actual!.Value.StateHash);
        Assert.StartsWith("The replay agrees: 5 committed states up to T 2 s, with 5 accepted events; state ", replay.Message, StringComparison.Ordinal);
        Assert.EndsWith(". The recording holds 6 log entries, and 5 committed states up to T 2 s.", replay.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Run_AnyWorldWhoseEventsCameInAnyOrder_GivesItsHashes()
    {
        for (int seed = 1; seed <= 100; seed++)
        {
            RecordingReplay replay = Replayed(Read(Recorded.Random(seed, out RandomWorld world), world.Scene.Accelerations));
            Assert.True(replay.Outcome == ReplayOutcome.Agrees, $"seed {seed}: {replay.Message}");
            Assert.Equal((11, world.Events.Count), (replay.StatesChecked, replay.EventsApplied));
        }
    }

    [Fact]
    public void Run_OneBitOfAnEventChanged_DiffersAtTheFirstStateAfterIt()
    {
        LogEntry was = Log[3]; // at 0.75 s
        ExternalEvent changed = ExternalEvent.Impulse(
            was.Event.Time, 2, 2, Second, V(Math.BitIncrement(was.Event.Velocity.X), was.Event.Velocity.Y));
        RecordingReplay replay = Replayed(Read(Small(With(4, Verdict.Accepted, changed))));

        Assert.Equal(ReplayOutcome.Differs, replay.Outcome);
        Assert.Equal((2, Start + Seconds(0.5)), (replay.StatesChecked, replay.AgreedUpTo));
        Assert.Equal(Start + Seconds(1), replay.Expected!.Value.Time);
        Assert.Equal(World(Log).StateHash(Start + Seconds(1)), replay.Expected.Value.StateHash);
        Assert.Equal(World(With(4, Verdict.Accepted, changed)).StateHash(Start + Seconds(1)), replay.Actual!.Value.StateHash);
        Assert.StartsWith("The replay differs at T 1 s: recorded state ", replay.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Run_AnEventTheRecordedPeerNeverHad_NamesTheBodiesThatHadEventsSince()
    {
        Simulation whole = World(Log);
        foreach ((uint lost, double since, double differs) in new[] { (1u, 0.0, 0.5), (4u, 0.5, 1.0), (6u, 1.0, 1.5) })
        {
            string[] named = [.. Bodies(whole)
                .Where(body => whole.Timeline(body).Any(e => e.Key.Time > Start + Seconds(since) && e.Key.Time <= Start + Seconds(differs)))
                .Select(body => body == First ? "'left'" : body == Second ? "'right'" : "the spawned body 2.1.0")];
            string message = Replayed(Read(Small(truth: [.. Log.Where(entry => entry.Index != lost)]))).Message;
            Assert.StartsWith(FormattableString.Invariant($"The replay differs at T {differs} s: "), message, StringComparison.Ordinal);
            Assert.Contains(
                FormattableString.Invariant($" Since T {since} s, the last that agrees, the replay has events of {named.Length} of 3 bodies: {string.Join(", ", named)}. The recording holds "),
                message, StringComparison.Ordinal);
        }

        string still = Replayed(Read(Bytes(w => w.WriteCommitted(Start + Seconds(0.1), 1, 2)))).Message;
        Assert.Contains(" Since the start, the replay has events of 0 of 2 bodies. The recording has ", still, StringComparison.Ordinal); // the control: nothing has happened by then
    }

    [Fact]
    public void Run_AnotherVerdict_Differs()
    {
        Assert.Equal(ReplayOutcome.Differs, Replayed(Read(Small(With(3, Verdict.Accepted, Log[2].Event)))).Outcome);
        Assert.Equal(ReplayOutcome.Differs, Replayed(Read(Small(With(1, Verdict.NoRight, Log[0].Event)))).Outcome);
        Assert.Equal(ReplayOutcome.Agrees, Replayed(Read(Small(With(3, Verdict.Invalid, Log[2].Event)))).Outcome);
    }

    [Fact]
    public void Run_OnlyTheEventHashDiffers_IsNoticed()
    {
        Simulation world = World([]);
        SimTime time = Start + Seconds(1);
        byte[] bytes = Bytes(writer => writer.WriteCommitted(time, world.StateHash(time), world.EventHash(time) ^ 1));
        RecordingReplay replay = Replayed(Read(bytes));
        Assert.Equal(ReplayOutcome.Differs, replay.Outcome);
        Assert.Contains(" The states are the same; what happened on the way there is not. ", replay.Message, StringComparison.Ordinal);
        Assert.Contains(" Since the start, the replay has events of 2 of 2 bodies: 'left', 'right'. The recording has ", replay.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Run_DamagedRecording_AgreesUpToTheDamage()
    {
        byte[] whole = Small();
        RecordingReplay replay = Replayed(Read(whole[..^60]));
        Assert.Equal(ReplayOutcome.Agrees, replay.Outcome);
        Assert.InRange(replay.StatesChecked, 2, 4);
        Assert.Contains(" The recording is damaged at byte ", replay.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Run_RecordingWithoutItsEnd_AgreesAsFarAsItHoldsAndSaysSo()
    {
        RecordingReplay replay = Replayed(Read(Small(end: null)));
        Assert.Equal((ReplayOutcome.Agrees, 5), (replay.Outcome, replay.StatesChecked));
        Assert.EndsWith(
            ". The recording has no end record: its writer was ended or still writes, or the file is cut; it holds 6 log entries, and 5 committed states up to T 2 s.",
            replay.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Run_OfAnotherFoldVersion_IsRefusedWithBoth()
    {
        Recording other = Read(OfFold(Small(), OtherFold));
        Cannot(
            $"The recording cannot be run again. Its states are of fold version {OtherFold}, by the library {other.Header!.LibraryVersion};"
            + $" this library computes fold version {Simulation.FoldVersion}, which gives other hashes.", OfFold(Small(), OtherFold));
        Assert.Equal((Log.Length, 5, true), (other.Entries.Count, other.Committed.Count, other.IsWhole)); // all of it can be read
        Assert.Equal(ReplayOutcome.Agrees, Replayed(Read(OfFold(Small(), (ushort)Simulation.FoldVersion))).Outcome); // the control
    }

    [Fact]
    public void Run_NothingToCheck_IsNotAgreement()
    {
        Assert.Equal(ReplayOutcome.NothingToCheck, Replayed(Read(Bytes(_ => { }))).Outcome);
        Assert.Equal(
            ReplayOutcome.NothingToCheck, Replayed(Read(Bytes(writer => writer.WriteEntry(1, Verdict.Accepted, Log[0].Event)))).Outcome);
    }

    [Fact]
    public void Run_WhatCannotBeRun_SaysWhy()
    {
        Cannot("The recording cannot be run again. The file is damaged before its scene ends. Damaged at byte 0: The file is empty.", []);
        Cannot("The recording cannot be run again. The scene needs the acceleration 'test force' of version 1, which is not here.", Recorded.Random(1, out _));
        Cannot(
            "The recording cannot be run again. Entry 1 of its log is accepted, and lies before the start: Remove of body 0.0.0 at",
            Small([new LogEntry(1, Verdict.Accepted, ExternalEvent.Remove(Start - SimDuration.OneTick, 1, 1, First))]));
        Cannot(
            "The recording cannot be run again. Entry 1 of its log is accepted, and may not enter the world: There is no such body",
            Small([new LogEntry(1, Verdict.Accepted, ExternalEvent.Remove(Start + Seconds(0.1), 1, 1, BodyId.OfScene(9)))]));

        // A body that cannot take its first step: in a wind of 1e12 m/s none can.
        Scene storm = new SceneBuilder("storm").AddForce(Force.QuadraticDrag("wind", 1, V(1e12)), out ForceSet wind)
            .AddBody("leaf", new BodySpec(0.1, 1e-3, 0, forces: wind), V(0)).Build();
        Cannot("The recording cannot be run again. At ", Bytes(writer => writer.WriteCommitted(Start + Seconds(3600), 1, 2), storm));
    }

    [Fact]
    public void Run_LateClient_GoesOnFromItsSnapshot()
    {
        // Entry 2 is of a time that the snapshot covers, so it is in it and not submitted again.
        RecordingReplay replay = Replayed(Read(Small(Log[1..], 3, joined: Joined(2, 0.6))));
        Assert.Equal((ReplayOutcome.Agrees, 3, 3), (replay.Outcome, replay.StatesChecked, replay.EventsApplied));

        // One at its very time is not in it.
        replay = Replayed(Read(Small(Log, 3, joined: Joined(1, 0.5))));
        Assert.Equal((ReplayOutcome.Agrees, 4, 4), (replay.Outcome, replay.StatesChecked, replay.EventsApplied));

        // The control: a snapshot in which an event is missing, and the log from behind an event that is in no snapshot.
        WorldSnapshot without = World(Log[..1]).Snapshot(Start + Seconds(0.6));
        Assert.Equal(ReplayOutcome.Differs, Replayed(Read(Small(Log[2..], 3, joined: new JoinedState(3, without)))).Outcome);
        Assert.Equal(ReplayOutcome.Differs, Replayed(Read(Small(Log[1..], 3, joined: Joined(2, 0.5)))).Outcome);
        Assert.Equal(ReplayOutcome.Differs, Replayed(Read(Small(Log[4..], 3, joined: Joined(5, 0.6)))).Outcome);
    }

    [Fact]
    public void Run_LateClientBeforeTheFirstStep_BeginsFromTheScene()
    {
        LogEntry refused = new(1, Verdict.Invalid, ExternalEvent.Remove(Start - Seconds(1), 2, 1, First));
        LogEntry[] log = [refused, .. Log.Select(entry => new LogEntry(entry.Index + 1, entry.Verdict, entry.Event))];
        RecordingReplay replay = Replayed(Read(Small(log[1..], 3, truth: log, joined: new JoinedState(2, null))));
        Assert.Equal((ReplayOutcome.Agrees, 5, 5), (replay.Outcome, replay.StatesChecked, replay.EventsApplied));
    }

    [Fact]
    public void Run_AnyWorldFromAnySnapshot_GivesItsHashes()
    {
        for (int seed = 1; seed <= 60; seed++)
        {
            RandomWorld world = new(seed);
            Simulation simulation = world.OnTime();
            SimTime[] times = RandomWorld.Times.ToArray();
            WorldSnapshot snapshot = simulation.Snapshot(times[1 + (seed % 9)]);
            ExternalEvent[] later = [.. world.Events.Where(e => e.Time >= snapshot.Time)];
            byte[] bytes = Bytes(
                writer =>
                {
                    uint index = 100;
                    foreach (ExternalEvent what in later)
                    {
                        writer.WriteEntry(index++, Verdict.Accepted, what);
                    }

                    foreach (SimTime time in times.Where(t => t >= snapshot.Time))
                    {
                        writer.WriteCommitted(time, simulation.StateHash(time), simulation.EventHash(time));
                    }
                },
                world.Scene, SimTime.Zero, 1, new JoinedState(100, snapshot));
            RecordingReplay replay = Replayed(Read(bytes, world.Scene.Accelerations));
            Assert.True(replay.Outcome == ReplayOutcome.Agrees, $"seed {seed}: {replay.Message}");
            Assert.Equal(later.Length, replay.EventsApplied);
        }
    }

    [Fact]
    public void Run_SnapshotOfAnotherWorld_SaysWhy()
    {
        WorldSnapshot snapshot = World(Log).Snapshot(Start + Seconds(0.6));
        JoinedState twice = new(3, new WorldSnapshot(snapshot.Start, snapshot.Time, snapshot.EventHash, [snapshot.Bodies[0], snapshot.Bodies[0]]));
        Cannot("The recording cannot be run again. In the snapshot body 0.0.0 follows body 0.0.0; identities must ascend.", Small(Log[2..], 3, joined: twice));
    }

    [Fact]
    public void Run_Cancelled_Ends()
    {
        using CancellationTokenSource source = new();
        source.Cancel();
        Assert.Throws<OperationCanceledException>(() => RecordingReplay.Run(Read(Small()), source.Token));
        Assert.Throws<ArgumentNullException>(() => Replayed(null!));
    }

    [Fact]
    public void Run_LongWithManyEventsOnOneBody_KeepsOnlyAnInstantOfThem()
    {
        // 20,000 events on one ball between two committed states: what a replay allocates is the list it sorts, not the world's history.
        const int count = 20_000;
        LogEntry[] log = Enumerable.Range(1, count).Select(n => new LogEntry(
            (uint)n, Verdict.Accepted, ExternalEvent.SetVelocity(Start + Seconds(n * 1e-3), 1, (uint)n, First, V(n % 3 - 1, 1)))).ToArray();
        SimTime end = Start + Seconds(21);
        byte[] Written(ulong state, ulong events) => Bytes(writer =>
        {
            foreach (LogEntry entry in log.Reverse().Select((entry, i) => new LogEntry((uint)i + 1, entry.Verdict, entry.Event)))
            {
                writer.WriteEntry(entry.Index, entry.Verdict, entry.Event);
            }

            writer.WriteCommitted(end, state, events);
        });
        CommittedState actual = Replayed(Read(Written(0, 0))).Actual!.Value;
        Recording recording = Read(Written(actual.StateHash, actual.EventHash));
        long before = GC.GetAllocatedBytesForCurrentThread();

        Assert.Equal(ReplayOutcome.Agrees, Replayed(recording).Outcome);

        Assert.InRange(GC.GetAllocatedBytesForCurrentThread() - before, count * 4, 1_000_000);
        Assert.Equal(World(log, 21).StateHash(end), actual.StateHash);
    }

    private static void Cannot(string message, byte[] bytes)
    {
        RecordingReplay replay = Replayed(Read(bytes));
        Assert.Equal(ReplayOutcome.CannotRun, replay.Outcome);
        Assert.StartsWith(message, replay.Message, StringComparison.Ordinal);
    }
}
