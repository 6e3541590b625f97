using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Tests.Sessions;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.Recordings.Recorded;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Recordings;

public sealed class ComparisonTests
{
    /// <summary>What is said in the end of two whole recordings.</summary>
    private const string Both = " The first holds 6 log entries, and 5 committed states up to T 2 s. The second holds 6 log entries, and 5 committed states up to T 2 s.";

    [Fact]
    public void Of_TwoPeersOfOneSession_Agree()
    {
        RecordingComparison compared = Compare(Small(peer: 0), Small(peer: 1));

        Assert.Equal((ComparisonOutcome.Agrees, 6, 5, Start + Seconds(2)), (compared.Outcome, compared.EntriesCompared, compared.StatesCompared, compared.AgreedUpTo));
        Assert.Equal($"The recordings agree in all that both hold: 6 log entries and 5 committed states, up to T 2 s.{Both}", compared.Message);
    }

    [Fact]
    public void Of_OneBitOfOneEvent_IsNamedWithBothVersions()
    {
        ExternalEvent was = Log[4].Event;
        ExternalEvent changed = ExternalEvent.SetVelocity(was.Time, 0, 1, Second, V(0, Math.BitIncrement(5)));
        LogEntry[] other = With(5, Verdict.Accepted, changed);
        RecordingComparison compared = Compare(Small(), Small(other, truth: other));

        Assert.Equal((ComparisonOutcome.EventDiffers, 4, 3, Start + Seconds(1)), (compared.Outcome, compared.EntriesCompared, compared.StatesCompared, compared.AgreedUpTo));
        Assert.Equal(Log[4], compared.FirstEntry);
        Assert.Equal(other[4], compared.SecondEntry);
        Assert.Equal(
            "Entry 5 of the log differs, at T 1.25 s. In the first it is Accepted: SetVelocity of body 0.0.1 at 101.5s by 0.1: to (0, 5, 0) m/s."
                + " In the second it is Accepted: SetVelocity of body 0.0.1 at 101.5s by 0.1: to (0, 5.000000000000001, 0) m/s."
                + " Their states agree up to T 1 s." + Both,
            compared.Message);
    }

    [Fact]
    public void Of_ASpawnThatTurnsOtherwise_IsNamedWithBothSpins()
    {
        ExternalEvent was = Log[1].Event;
        LogEntry[] other = With(2, Verdict.Accepted, ExternalEvent.Spawn(was.Time, was.Peer, was.Sequence, was.Spec, was.Position, was.Velocity, V(0, 0, 1e-9)));
        RecordingComparison compared = Compare(Small(), Small(other, truth: other));
        Assert.Equal((ComparisonOutcome.EventDiffers, 1), (compared.Outcome, compared.EntriesCompared));
        Assert.Contains("m/s and (0, 0, 0) rad/s. In the second", compared.Message, StringComparison.Ordinal);
        Assert.Contains("m/s and (0, 0, 1E-09) rad/s. Their states agree up to T 0 s. The first holds", compared.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Of_AnotherVerdict_IsNamed()
    {
        RecordingComparison compared = Compare(Small(), Small(With(3, Verdict.Accepted, Log[2].Event)));
        Assert.Equal(ComparisonOutcome.EventDiffers, compared.Outcome);
        Assert.Equal((Verdict.TooLate, Verdict.Accepted), (compared.FirstEntry!.Value.Verdict, compared.SecondEntry!.Value.Verdict));
    }

    [Fact]
    public void Of_AStateThatDeparts_SaysWhichOfThemDepartsFromItsOwnReplay()
    {
        // The second peer had another world than its log says: it lost an event, and hashed what came of that.
        LogEntry[] lost = [.. Log.Where(entry => entry.Index != 4)];
        RecordingComparison compared = Compare(Small(), Small(truth: lost));

        Assert.Equal((ComparisonOutcome.StateDiffers, 6, 2), (compared.Outcome, compared.EntriesCompared, compared.StatesCompared));
        Assert.Equal(Start + Seconds(1), compared.FirstState!.Value.Time);
        Assert.Equal(World(Log).StateHash(Start + Seconds(1)), compared.FirstState.Value.StateHash);
        Assert.Equal(World(lost).StateHash(Start + Seconds(1)), compared.SecondState!.Value.StateHash);
        Assert.Equal((ReplayOutcome.Agrees, ReplayOutcome.Differs), (compared.FirstReplay!.Outcome, compared.SecondReplay!.Outcome));
        Assert.Equal(3, compared.FirstReplay.StatesChecked); // no further than to where they differ
        Assert.Equal(Start + Seconds(0.5), compared.AgreedUpTo);
        Assert.StartsWith("The log is the same in 6 common entries, and the committed state at T 1 s differs: state ", compared.Message, StringComparison.Ordinal);
        Assert.Contains(" in the second. Up to T 0.5 s they agree. ", compared.Message, StringComparison.Ordinal);
        Assert.EndsWith("The first agrees with its own replay. The second departs from its own replay at T 1 s." + Both, compared.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Of_StatesThatBothReplay_NamesTheFirstBodyThatDiffers()
    {
        // The second joined with another copy of the world, in which the left ball was never lifted; since then it is what its own log makes of that.
        LogEntry[] lost = [.. Log.Where(entry => entry.Index != 1)];
        JoinedState wrong = new(3, World(lost).Snapshot(Start + Seconds(1)));
        RecordingComparison compared = Compare(Small(), Small(Log[2..], truth: lost, joined: wrong));

        Assert.Equal((ComparisonOutcome.StateDiffers, 4), (compared.Outcome, compared.EntriesCompared));
        Assert.Equal((ReplayOutcome.Agrees, ReplayOutcome.Agrees), (compared.FirstReplay!.Outcome, compared.SecondReplay!.Outcome));
        World(Log).TryRead(First, Start + Seconds(1), out BodyState lifted);
        World(lost).TryRead(First, Start + Seconds(1), out BodyState falling);
        Assert.Contains(
            $" The first body that differs is 'left': Ballistic at {lifted.Position} m with {lifted.Velocity} m/s in the first, Ballistic at {falling.Position} m with {falling.Velocity} m/s in the second. ",
            compared.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Of_AStateThatDeparts_WithoutTheForceItNeeds_SaysThatThereIsNoReplay()
    {
        Simulation world = new RandomWorld(1).OnTime();
        byte[] Written(ulong state) => Bytes(writer => writer.WriteCommitted(At(1), state, 0), world.Scene, SimTime.Zero);
        RecordingComparison compared = Compare(Written(1), Written(2));

        Assert.Equal(ComparisonOutcome.StateDiffers, compared.Outcome);
        Assert.StartsWith("The recordings have no log entry in common, and the committed state at T 1 s differs", compared.Message, StringComparison.Ordinal);
        Assert.Contains("The second has no replay to tell: The recording cannot be run again. The scene needs", compared.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Of_OtherSceneOrStart_IsSaidFirst()
    {
        Scene other = new SceneBuilder("other").Build();
        RecordingComparison scenes = Compare(Small(), Bytes(_ => { }, other));
        Assert.Equal(ComparisonOutcome.SceneDiffers, scenes.Outcome);
        Assert.Equal($"The scenes differ: 'two' ({Recorded.Scene.Hash:x16}) in the first, 'other' ({other.Hash:x16}) in the second."
            + " The first holds 6 log entries, and 5 committed states up to T 2 s. The second has no end record: its writer was ended or still writes, or the file is cut;"
            + " it holds 0 log entries and no committed state.", scenes.Message);

        RecordingComparison starts = Compare(Small(), Bytes(_ => { }, start: Start + Seconds(1)));
        Assert.Equal(ComparisonOutcome.StartDiffers, starts.Outcome);
        Assert.StartsWith("The starts differ: the first session started at 100.25s, the second at 101.25s. The first holds ", starts.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Of_NothingInCommon_IsNotAgreement()
    {
        byte[] first = Bytes(writer =>
        {
            writer.WriteEntry(1, Verdict.Accepted, Log[0].Event);
            writer.WriteCommitted(Start, 1, 2);
        });
        byte[] second = Bytes(
            writer =>
            {
                writer.WriteEntry(2, Verdict.Accepted, Log[1].Event);
                writer.WriteCommitted(Start + Seconds(1), 1, 2);
            },
            joined: Joined(2, 0.6));

        RecordingComparison compared = Compare(first, second);
        Assert.Equal(ComparisonOutcome.NothingInCommon, compared.Outcome);
        Assert.Null(compared.AgreedUpTo);
        Assert.StartsWith(
            "The recordings are of one scene and start, and have no log entry and no committed time in common: of the states nothing is known.", compared.Message, StringComparison.Ordinal);
        Assert.Equal(ComparisonOutcome.NothingInCommon, Compare(Bytes(_ => { }), Bytes(_ => { })).Outcome);

        RecordingComparison unreadable = Compare(first, [1, 2, 3]);
        Assert.Equal(ComparisonOutcome.NothingInCommon, unreadable.Outcome);
        Assert.StartsWith("The recordings cannot be compared without both their headers. The first has no end record", unreadable.Message, StringComparison.Ordinal);
        Assert.Contains(" The second is damaged at byte 0, and holds nothing before that: This is no recording", unreadable.Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentNullException>(() => Compared(null!, Read(first)));
        Assert.Throws<ArgumentNullException>(() => Compared(Read(first), null!));
    }

    [Fact]
    public void Of_LateClient_IsComparedWhereBothCover()
    {
        JoinedState joined = Joined(3, 1);
        RecordingComparison compared = Compare(Small(), Small(Log[2..], joined: joined));
        Assert.Equal((ComparisonOutcome.Agrees, 4, 3), (compared.Outcome, compared.EntriesCompared, compared.StatesCompared));

        LogEntry[] other = With(6, Verdict.NoRight, Log[5].Event);
        RecordingComparison differs = Compare(Small(Log[2..], joined: joined), Small(other));
        Assert.Equal((ComparisonOutcome.EventDiffers, 3), (differs.Outcome, differs.EntriesCompared));
        Assert.Equal((6u, 6u), (differs.FirstEntry!.Value.Index, differs.SecondEntry!.Value.Index));
    }

    [Fact]
    public void Of_EntriesWithoutStates_IsNotAgreement()
    {
        RecordingComparison compared = Compare(Small(), Bytes(writer => writer.WriteEntry(1, Log[0].Verdict, Log[0].Event)));
        Assert.Equal((ComparisonOutcome.NothingInCommon, 1, 0), (compared.Outcome, compared.EntriesCompared, compared.StatesCompared));
        Assert.Contains("have the same in 1 common log entry, and no committed time in common: of the states nothing is known.", compared.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Of_DamagedRecording_CountsUpToTheDamageAndSaysSo()
    {
        byte[] bytes = Small();
        bytes[^40] ^= 1;
        RecordingComparison compared = Compare(Small(), bytes);
        Assert.Equal(ComparisonOutcome.Agrees, compared.Outcome);
        Assert.InRange(compared.StatesCompared, 3, 4);
        Assert.Matches(
            "The second is damaged at byte [0-9]+, and holds 6 log entries, and [34] committed states up to T 1(\\.5)? s before that: The checksum of a committed state is wrong.$",
            compared.Message);
    }

    [Fact]
    public void Of_RecordingWithoutItsEnd_CountsAsFarAsItHoldsAndSaysSo()
    {
        byte[] whole = Small();
        List<int> at = Boundaries(whole);
        byte[] cut = whole[..at[^4]]; // before the last two states and the end
        RecordingComparison compared = Compare(cut, whole);
        Assert.Equal((ComparisonOutcome.Agrees, 3, Start + Seconds(1)), (compared.Outcome, compared.StatesCompared, compared.AgreedUpTo));
        Assert.Equal(
            "The recordings agree in all that both hold: 6 log entries and 3 committed states, up to T 1 s. The first has no end record: its writer was ended or still"
            + " writes, or the file is cut; it holds 6 log entries, and 3 committed states up to T 1 s. The second holds 6 log entries, and 5 committed states up to T 2 s.",
            compared.Message);
        Assert.EndsWith(Both, Compare(whole, whole).Message, StringComparison.Ordinal); // the control
    }

    [Fact]
    public void Of_OtherFoldVersions_IsSaidBeforeAnythingThatWasComputed()
    {
        // Of one session, as builds of two versions would record it: the states differ, and that is nothing new.
        RecordingComparison compared = Compare(Small(), OfFold(Small(truth: Log[1..]), OtherFold));
        Assert.Equal((ComparisonOutcome.FoldVersionDiffers, 0, 0), (compared.Outcome, compared.EntriesCompared, compared.StatesCompared));
        string library = Read(Small()).Header!.LibraryVersion;
        Assert.Equal(
            $"The fold versions differ: {Simulation.FoldVersion} in the first, by the library {library};"
            + $" {OtherFold} in the second, by the library {library}."
            + $" They make different states of the same scene and events, so the hashes of one say nothing of the other's.{Both}",
            compared.Message);

        // Two of a version that is not this library's are compared as any; only their replays are missing.
        Assert.Equal(ComparisonOutcome.Agrees, Compare(OfFold(Small(), OtherFold), OfFold(Small(peer: 1), OtherFold)).Outcome);
        RecordingComparison differs = Compare(OfFold(Small(), OtherFold), OfFold(Small(truth: Log[1..]), OtherFold));
        Assert.Equal((ComparisonOutcome.StateDiffers, ReplayOutcome.CannotRun), (differs.Outcome, differs.FirstReplay!.Outcome));
        string says = $" The second has no replay to tell: The recording cannot be run again. Its states are of fold version {OtherFold}, ";
        Assert.Contains(says, differs.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Of_PeersOfARealSession_AgreeAndGiveTheirHashesAgain()
    {
        for (ulong seed = 1; seed <= 3; seed++)
        {
            Recording[] recordings = OfPeers(AgreementTests.Play(
                "loss-10", 3, seed, _ => new HostOptions { Window = new(SimDuration.FromSeconds(5)), ExtraHistory = SimDuration.FromSeconds(60) }));
            Assert.All(recordings, recording => Assert.Equal(ReplayOutcome.Agrees, Replayed(recording).Outcome));
            Assert.All(recordings[1..], recording => Assert.Equal(ComparisonOutcome.Agrees, Compared(recordings[0], recording).Outcome));
            Assert.True(recordings[0].Committed.Count >= 3 && recordings[0].Entries.Count == 24, $"{recordings[0].Committed.Count} states");
        }
    }

    [Fact]
    public void Of_PeersThatApplyLate_AreSeenToDepart()
    {
        // With the strategy none a peer's world is not the fold of its log, and a recording of it shows that.
        Recording[] recordings = OfPeers(AgreementTests.Play(
            "delay-100ms", 2, 1, _ => new HostOptions { Strategy = LateEventStrategy.ApplyOnArrival, ExtraHistory = SimDuration.FromSeconds(60) }));
        RecordingComparison compared = Compared(recordings[0], recordings[1]);
        Assert.Equal(ComparisonOutcome.StateDiffers, compared.Outcome);
        Assert.Contains(" departs from its own replay at ", compared.Message, StringComparison.Ordinal);
    }

    private static RecordingComparison Compare(byte[] first, byte[] second) => Compared(Read(first), Read(second));

    /// <summary>What each peer of a settled session would have recorded.</summary>
    private static Recording[] OfPeers(SessionGroup group)
    {
        SimTime start = group.Host.World!.Simulation.Start;
        SimTime last = group.Sessions.Min(session => session.World!.Simulation.SimulatedTo);
        List<UpdateEntry> log = [.. group.Log.OrderBy(entry => entry.Key).Select(entry => entry.Value)];
        return group.Sessions.Select(session => Read(Bytes(
            writer =>
            {
                uint index = 1;
                foreach (UpdateEntry entry in log)
                {
                    writer.WriteEntry(index++, entry.Verdict, entry.Event);
                }

                for (SimTime time = start; time <= last; time += Seconds(0.25))
                {
                    writer.WriteCommitted(time, session.World!.Simulation.StateHash(time), session.World.Simulation.EventHash(time));
                }
            },
            group.Scene, start, session.Peer))).ToArray();
    }
}
