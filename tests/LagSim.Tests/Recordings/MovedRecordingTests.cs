using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.Recordings.Recorded;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Recordings;

/// <summary>
/// A recording of a session in which an input came too late, and so happened later than its author did it, replays to the states that the
/// session had; one that has it at another time, or with another verdict, does not.
/// </summary>
public sealed class MovedRecordingTests
{
    private static readonly (byte[] Host, byte[] Other, byte[][] OfAuthor, ExternalEvent Done, CommittedState[] Committed) Session = Play();
    private static readonly Recording Whole = Read(Session.Host);
    private static readonly LogEntry Moved = Whole.Entries.Single(entry => entry.Verdict == Verdict.Moved);

    [Fact]
    public void Replay_OfEveryPeer_HasTheStatesOfTheSession()
    {
        Assert.True(Moved.Event.Time > Session.Done.Time && Moved.Event.Equals(Session.Done.At(Moved.Event.Time)));
        Assert.Contains(Whole.Entries, entry => entry.Verdict == Verdict.TooLate); // the control: what may not be moved was as late
        Assert.Equal(Session.Committed, Whole.Committed);
        Assert.Contains(Whole.Committed, state => state.Time > Moved.Event.Time);
        Recording other = Read(Session.Other);
        foreach (Recording recording in new[] { Whole, other })
        {
            RecordingReplay replay = Replayed(recording);
            Assert.Equal((ReplayOutcome.Agrees, recording.Committed.Count, 2), (replay.Outcome, replay.StatesChecked, replay.EventsApplied));
        }

        RecordingComparison both = RecordingComparison.Of(Whole, other, TestContext.Current.CancellationToken);
        Assert.Equal((ComparisonOutcome.Agrees, Whole.Entries.Count), (both.Outcome, both.EntriesCompared));
        Recording author = Read(Session.OfAuthor[^1]); // it may have taken a fresh copy
        Assert.Equal(ReplayOutcome.Agrees, Replayed(author).Outcome);
    }

    /// <summary>At the time at which its author did it, a tick off, refused, and lost: no replay of those has the recorded states.</summary>
    [Fact]
    public void Replay_WithTheInputElsewhere_DiffersAndSaysWhere()
    {
        SimTime happened = Moved.Event.Time;
        LogEntry[] wrong =
        [
            new(Moved.Index, Verdict.Accepted, Session.Done),
            new(Moved.Index, Verdict.Moved, Session.Done.At(happened + SimDuration.OneTick)),
            new(Moved.Index, Verdict.TooLate, Moved.Event),
        ];
        foreach (LogEntry entry in wrong)
        {
            Recording changed = With(entry);
            RecordingReplay replay = Replayed(changed);
            CommittedState first = Whole.Committed.First(state => state.Time > SimTime.Min(happened, entry.Event.Time));
            Assert.Equal((ReplayOutcome.Differs, first), (replay.Outcome, replay.Expected));
            Assert.StartsWith("The replay differs at T ", replay.Message, StringComparison.Ordinal);
            RecordingComparison both = RecordingComparison.Of(Whole, changed, TestContext.Current.CancellationToken);
            Assert.Equal((Moved, entry), (both.FirstEntry!.Value, both.SecondEntry!.Value));
        }

        Assert.Equal(ReplayOutcome.Agrees, Replayed(With(Moved)).Outcome); // the control: rewritten as it was
        Assert.Equal(ReplayOutcome.Agrees, Replayed(With(new LogEntry(Moved.Index, Verdict.Accepted, Moved.Event))).Outcome); // that it was moved changes nothing else
    }

    [Fact]
    public void Read_WhereTheEntryIsDamaged_NamesItAndKeepsWhatIsBefore()
    {
        int record = Boundaries(Session.Host).First(at => Session.Host[at] == (byte)RecordKind.Entry && Session.Host[at + 2] == Moved.Index);
        byte[] bytes = (byte[])Session.Host.Clone();
        const int verdict = 6; // after kind, length and index
        Assert.Equal((byte)Verdict.Moved, bytes[record + verdict]);
        bytes[record + verdict] = 7;
        Recording read = Read(bytes);
        Assert.Equal((record, "The checksum of a log entry is wrong."), (read.Damage!.Offset, read.Damage.Reason));
        Assert.Equal(Whole.Entries.Where(entry => entry.Index < Moved.Index), read.Entries);
        int end = Boundaries(Session.Host).First(at => at > record);
        BitConverter.GetBytes(Crc(bytes[record..(end - 4)])).CopyTo(bytes, end - 4);
        read = Read(bytes);
        Assert.Equal((record, "The log entry holds a value out of its range."), (read.Damage!.Offset, read.Damage.Reason));
    }

    /// <summary>The host's recording with one entry in the place of the moved one.</summary>
    private static Recording With(LogEntry entry) => Read(Bytes(
        writer =>
        {
            foreach (LogEntry kept in Whole.Entries)
            {
                LogEntry one = kept.Index == entry.Index ? entry : kept;
                writer.WriteEntry(one.Index, one.Verdict, one.Event);
            }

            foreach (CommittedState state in Whole.Committed)
            {
                writer.WriteCommitted(state.Time, state.StateHash, state.EventHash);
            }

            writer.WriteEnd(Whole.EndReason!);
        },
        Whole.Scene, Whole.Header!.Start));

    private static (byte[] Host, byte[] Other, byte[][] OfAuthor, ExternalEvent Done, CommittedState[] Committed) Play()
    {
        SimDuration history = SimDuration.FromSeconds(0.2);
        SessionGroup group = new(
            ScriptedActions.Box(), 3, LinkProfiles.PureDelay(20),
            options: _ => new HostOptions { Window = new(history), LongestHistory = history, ExtraHistory = SimDuration.FromSeconds(3) });
        List<MemoryStream>[] streams = [[], [], []];
        SessionRecorder[] recorders = [.. group.Sessions.Select((session, n) => new SessionRecorder(session, _ =>
        {
            streams[n].Add(new MemoryStream());
            return streams[n][^1];
        }))];
        List<CommittedState> committed = [];
        group.Host.StateCommitted += committed.Add;
        group.Connect();
        group.Do(0, PlayerAction.SetVelocity(Second, V(0, 1)));
        group.Run(0.5);
        group.Cut(1, 0);
        ExternalEvent done = group.Do(1, PlayerAction.Impulse(First, V(1)));
        group.Do(1, PlayerAction.Teleport(Second, V(0, 2)));
        group.Run(0.6);
        group.Restore(1, 0);
        Assert.True(group.Settle(3));
        group.Run(5);
        group.Host.Leave();
        Assert.True(group.RunUntil(() => group.Sessions.All(s => s.State == SessionState.Ended)));
        Array.ForEach(recorders, recorder => recorder.Dispose());
        return (streams[0].Single().ToArray(), streams[2].Single().ToArray(), [.. streams[1].Select(stream => stream.ToArray())], done, [.. committed]);
    }
}
