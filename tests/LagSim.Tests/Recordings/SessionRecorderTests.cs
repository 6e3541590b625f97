using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Tests.Cli;
using LagSim.Tests.Sessions;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.Recordings.Recorded;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Recordings;

/// <summary>What peers record of a session, in virtual time: run again it is what they had, and it is the same for all.</summary>
public sealed class SessionRecorderTests
{
    [Theory]
    [InlineData("lan", 1)]
    [InlineData("awful", 2)]
    [InlineData("awful", 3)]
    public void Recordings_OfAllPeersALateOneIncluded_AgreeAndReplay(string link, int seed)
    {
        Assert.True(LinkProfiles.TryGet(link, out LinkProfile? profile, out _));
        SessionGroup group = new(
            ScriptedActions.Box(), 4, profile, (ulong)seed, _ => new HostOptions { Timeout = SimDuration.FromSeconds(20) }, expected: 2); // some of which is cut
        MemoryStream[] streams = Record(group, out SessionRecorder[] recorders);
        group.Cut(3, 0);
        Assert.True(group.RunUntil(() => group.Sessions.Take(3).All(s => s.State == SessionState.Running)));
        ScriptedAction(group, 0, PlayerAction.Teleport(First, V(0, 4)));
        ScriptedAction(group, 1, PlayerAction.Spawn(Ball(0.3), V(1, 4)));
        group.Run(3);
        group.Network.SetLink(3, 0, profile.ToHost);
        Assert.True(group.RunUntil(() => group.Sessions[3].State == SessionState.Running), group.Sessions[3].EndReason);
        ScriptedAction(group, 3, PlayerAction.Impulse(Second, V(1, 5)));
        ScriptedAction(group, 2, PlayerAction.Remove(Third));
        ScriptedAction(group, 0, PlayerAction.SetVelocity(First, V(2, 3)));
        group.Run(8);
        group.Sessions[2].Leave();
        group.Run(1);
        group.Host.Leave();
        Assert.True(group.RunUntil(() => group.Sessions.All(s => s.State == SessionState.Ended)));
        Array.ForEach(recorders, recorder => recorder.Dispose());

        Recording[] recordings = [.. streams.Select(stream => Read(stream.ToArray()))];
        Assert.All(recorders, recorder => Assert.Null(recorder.Failure));
        Assert.All(recordings, recording => Assert.True(recording.IsWhole, recording.Extent));
        Assert.All(recordings, recording => Assert.Equal(ReplayOutcome.Agrees, Replayed(recording).Outcome));
        Assert.All(recordings[1..], recording => Assert.Equal(ComparisonOutcome.Agrees, Compared(recordings[0], recording).Outcome));
        Assert.Equal([0, 1, 2, 3], recordings.Select(recording => (int)recording.Header!.Peer).Order());
        Assert.Equal(group.Sessions.Select(s => s.EndReason), recordings.Select(recording => recording.EndReason));
        Assert.Equal([true, true, true, false], recordings.Select(recording => recording.Joined is null));
        Assert.NotNull(recordings[3].Joined!.Snapshot);
        Assert.True(recordings[3].Joined!.FirstIndex > 1 && recordings[3].Committed.Count >= 5, $"{recordings[3].Joined!.FirstIndex} {recordings[3].Committed.Count}");
        Assert.Equal(group.Log.Count, recordings[0].Entries.Count);

        // The control: one event less in what a peer recorded, and it is named.
        Recording less = Read(Without(recordings[1], 3));
        RecordingComparison compared = Compared(recordings[0], less);
        Assert.Equal(ComparisonOutcome.EventDiffers, compared.Outcome);
        Assert.Equal(3u, compared.FirstEntry!.Value.Index);
        Assert.Contains("Entry 3 of the log differs, at T ", compared.Message, StringComparison.Ordinal);
        Assert.Equal(ReplayOutcome.Differs, Replayed(less).Outcome);
    }

    [Fact]
    public void Recording_OfWhatCameBeforeTheStart_HasItsPlaceInTheLog()
    {
        // A client that acts before there is a world is refused; the entry stands in the host's log, and one that comes later does not get it.
        SessionGroup group = new(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(2), expected: 2);
        MemoryStream[] streams = Record(group, out SessionRecorder[] recorders);
        group.Cut(1, 0);
        group.Cut(2, 0);
        RawClient raw = new(group);
        raw.Claim(1, ExternalEvent.Teleport(At(1), raw.Peer, 1, First, V(0, 3)));
        Assert.Equal(Verdict.Invalid, group.Log[1].Verdict);
        group.Run(1.5); // the copy that was made for it serves the next for a second
        Assert.Null(group.Host.World);
        group.Restore(1, 0);
        Assert.True(group.RunUntil(() => group.Host.World is not null));
        group.Restore(2, 0);
        group.Connect();
        ScriptedAction(group, 2, PlayerAction.Teleport(First, V(0, 4)));
        group.Run(4);
        Array.ForEach(recorders, recorder => recorder.Dispose());

        Recording[] recordings = [.. streams.Select(stream => Read(stream.ToArray()))];
        Assert.Equal([2, 1, 1], recordings.Select(recording => recording.Entries.Count));
        Assert.Null(recordings[0].Joined);
        Assert.Equal((2u, true), (recordings[2].Joined!.FirstIndex, recordings[2].Joined!.Snapshot is null));
        Assert.All(recordings, recording => Assert.Equal(ReplayOutcome.Agrees, Replayed(recording).Outcome));
        Assert.All(recordings, recording => Assert.Equal(ComparisonOutcome.Agrees, Compared(recordings[0], recording).Outcome));
        Assert.All(recordings, recording => Assert.Equal("The recording ended before the session.", recording.EndReason));
    }

    [Fact]
    public void Record_DiskThatFillsUp_TellsOnceAndTheSessionGoesOn()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(2));
        FullStream full = new(1500);
        using SessionRecorder recorder = new(group.Host, _ => full);
        List<string> told = [];
        recorder.Failed += told.Add;
        group.Connect();
        group.Run(3);
        Assert.Null(recorder.Failure);
        for (int i = 0; i < 15; i++)
        {
            ScriptedAction(group, 1, PlayerAction.Teleport(First, V(0, 4)));
        }

        group.Run(3);
        Assert.Equal([SessionState.Running, SessionState.Running], group.Sessions.Select(s => s.State));
        Assert.Equal(15, group.Host.Counters.EventsAccepted);
        Assert.Equal("The recording ends here: No space left.", recorder.Failure);
        Assert.Equal(recorder.Failure, Assert.Single(told));
        Assert.True(full.IsDisposed);
        recorder.Dispose();

        Recording left = Read(full.ToArray());
        Assert.Null(left.EndReason);
        Assert.InRange(left.Entries.Count, 1, 14);
        Assert.Equal(ReplayOutcome.Agrees, Replayed(left).Outcome);
    }

    [Theory]
    [InlineData(0)] // no room for the header
    [InlineData(-1)] // cannot even be opened
    public void Record_FileThatCannotBeMade_TellsAndTheSessionGoesOn(int room)
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(2));
        using SessionRecorder recorder = new(group.Host, _ => room < 0 ? throw new UnauthorizedAccessException("Not you.") : new FullStream(room));
        group.Connect();
        group.Run(3);
        Assert.Equal(room < 0 ? "The recording ends here: Not you." : "The recording ends here: No space left.", recorder.Failure);
        Assert.Equal(SessionState.Running, group.Host.State);
    }

    [Fact]
    public void Dispose_DiskThatFailsAtTheEnd_TellsAndDoesNotThrow()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(2));
        FullStream full = new(100_000);
        SessionRecorder recorder = new(group.Host, _ => full);
        group.Connect();
        full.Room = 0;
        recorder.Dispose();
        recorder.Dispose();
        Assert.Equal("The recording ends here: No space left.", recorder.Failure);
    }

    [Fact]
    public void Record_SessionWithoutAWorld_LeavesNoFile()
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["kept.lagsim"], "of yesterday");
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(2), expected: 2);
        using (SessionRecorder recorder = new(group.Sessions[1], folder["kept.lagsim"]))
        {
            group.Run(3);
            Assert.Null(recorder.Failure);
        }

        Assert.Equal("of yesterday", File.ReadAllText(folder["kept.lagsim"]));
    }

    [Fact]
    public void Record_ToAFile_IsThereWhileTheSessionGoesOn()
    {
        using TemporaryFolder folder = new();
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(2));
        using SessionRecorder recorder = new(group.Sessions[1], folder["mine.lagsim"]);
        group.Connect();
        group.Run(5);
        Recording read = Recording.Read(folder["mine.lagsim"]);
        Assert.True(read.Damage is null && read.EndReason is null && read.Committed.Count > 0);
    }

    [Fact]
    public void Files_AfterAFreshCopy_NameTheFurtherFileToo()
    {
        using TemporaryFolder folder = new();
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(2));
        using SessionRecorder recorder = new(group.Sessions[1], folder["mine.lagsim"]), hosts = new(group.Host, folder["hosts.lagsim"]);
        Assert.Empty(recorder.Files);
        group.Connect();
        group.Run(5);
        Assert.Equal([folder["mine.lagsim"]], recorder.Files);
        group.Cut(0, 1);
        group.Cut(1, 0);
        group.Run(15);
        group.Restore(0, 1);
        group.Restore(1, 0);
        Assert.True(group.RunUntil(() => group.Sessions[1].Counters.Renewals == 1));
        group.Run(3);
        Assert.Equal([folder["mine.lagsim"], folder["mine.2.lagsim"]], recorder.Files);
        Assert.Equal([folder["hosts.lagsim"]], hosts.Files); // the control: nothing took the place of its world
        recorder.Dispose();
        Assert.All(recorder.Files, file => Assert.Equal(ReplayOutcome.Agrees, Replayed(Recording.Read(file)).Outcome));
    }

    [Fact]
    public void Record_ForALength_LeavesLaterStatesOut()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(2));
        MemoryStream some = new(), all = new();
        using (SessionRecorder first = new(group.Host, _ => some, Seconds(2)), second = new(group.Host, _ => all))
        {
            group.Connect();
            ScriptedAction(group, 1, PlayerAction.Teleport(First, V(0, 4)));
            group.Run(6);
        }

        SimTime start = group.Host.World!.Simulation.Start;
        Assert.Equal([start + Seconds(1), start + Seconds(2)], Read(some.ToArray()).Committed.Select(state => state.Time));
        Assert.True(Read(all.ToArray()).Committed.Count > 3);
    }

    [Fact]
    public void Constructor_SessionThatHasBegunOrNone_IsRefused()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(2)).Connect();
        Assert.Contains("from its beginning on", Assert.Throws<InvalidOperationException>(() => new SessionRecorder(group.Host, "x.lagsim")).Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentNullException>(() => new SessionRecorder(null!, "x.lagsim"));
        Assert.Throws<ArgumentNullException>(() => new SessionRecorder(group.Host, (string)null!));
        Assert.Contains("names a file", Assert.Throws<ArgumentException>(() => new SessionRecorder(group.Host, " ")).Message, StringComparison.Ordinal);
    }

    /// <summary>A recording without one of its entries; those behind it move up.</summary>
    internal static byte[] Without(Recording recording, uint index) => Bytes(
        writer =>
        {
            int next = 0;
            uint place = 1;
            foreach (CommittedState state in recording.Committed)
            {
                for (; next < recording.Entries.Count && recording.Entries[next].Event.Time <= state.Time; next++)
                {
                    if (recording.Entries[next].Index != index)
                    {
                        writer.WriteEntry(place++, recording.Entries[next].Verdict, recording.Entries[next].Event);
                    }
                }

                writer.WriteCommitted(state.Time, state.StateHash, state.EventHash);
            }
        },
        recording.Scene, recording.Header!.Start, recording.Header.Peer);

    private static MemoryStream[] Record(SessionGroup group, out SessionRecorder[] recorders)
    {
        MemoryStream[] streams = [.. group.Sessions.Select(_ => new MemoryStream())];
        recorders = [.. group.Sessions.Select((session, i) => new SessionRecorder(session, _ => streams[i]))];
        return streams;
    }

    private static void ScriptedAction(SessionGroup group, int peer, PlayerAction action)
    {
        group.Do(peer, action);
        group.Run(0.2);
    }

    /// <summary>A disk with room for so many bytes.</summary>
    private sealed class FullStream(int room) : MemoryStream
    {
        internal int Room { get; set; } = room;

        internal bool IsDisposed { get; private set; }

        public override void Write(ReadOnlySpan<byte> buffer)
        {
            Room -= buffer.Length;
            if (Room < 0)
            {
                throw new IOException("No space left.");
            }

            base.Write(buffer);
        }

        protected override void Dispose(bool disposing)
        {
            IsDisposed = true;
            base.Dispose(disposing);
        }
    }
}
