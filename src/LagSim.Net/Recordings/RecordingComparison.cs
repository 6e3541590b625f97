using System;
using System.Threading;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Recordings;

/// <summary>The result of comparing two recordings of one session: the first difference, or that they agree.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class RecordingComparison
{
    private RecordingComparison(ComparisonOutcome outcome, int entriesCompared, int statesCompared, SimTime? agreedUpTo, string message)
    {
        Outcome = outcome;
        EntriesCompared = entriesCompared;
        StatesCompared = statesCompared;
        AgreedUpTo = agreedUpTo;
        Message = message;
    }

    /// <summary>The outcome.</summary>
    public ComparisonOutcome Outcome { get; }

    /// <summary>The number of log entries that are equal in both.</summary>
    public int EntriesCompared { get; }

    /// <summary>The number of committed states that are equal in both, up to the first that is not.</summary>
    public int StatesCompared { get; }

    /// <summary>The time of the last equal state; null if there is none.</summary>
    public SimTime? AgreedUpTo { get; }

    /// <summary>For <see cref="ComparisonOutcome.EventDiffers"/>, the first recording's entry; otherwise null.</summary>
    public LogEntry? FirstEntry { get; private set; }

    /// <summary>For <see cref="ComparisonOutcome.EventDiffers"/>, the second recording's entry; otherwise null.</summary>
    public LogEntry? SecondEntry { get; private set; }

    /// <summary>For <see cref="ComparisonOutcome.StateDiffers"/>, the first recording's committed state; otherwise null.</summary>
    public CommittedState? FirstState { get; private set; }

    /// <summary>For <see cref="ComparisonOutcome.StateDiffers"/>, the second recording's committed state; otherwise null.</summary>
    public CommittedState? SecondState { get; private set; }

    /// <summary>For <see cref="ComparisonOutcome.StateDiffers"/>, the first recording replayed up to that time; otherwise null.</summary>
    public RecordingReplay? FirstReplay { get; private set; }

    /// <summary>For <see cref="ComparisonOutcome.StateDiffers"/>, the second recording replayed up to that time; otherwise null.</summary>
    public RecordingReplay? SecondReplay { get; private set; }

    /// <summary>The result as text: the outcome, up to where the recordings agree, and the extent of each.</summary>
    public string Message { get; }

    /// <summary>
    /// Compares scenes, starts, fold versions, the log entries that both contain, and the committed states at times that both contain, in
    /// this order. Where a state differs, both are replayed to see which departs from its own scene and events.
    /// </summary>
    /// <param name="first">One recording.</param>
    /// <param name="second">The other, usually of another peer.</param>
    /// <param name="cancellation">Cancels the replays.</param>
    /// <remarks>Cost: O(n) in the records; two replays if a state differs.</remarks>
    /// <exception cref="ArgumentNullException">A recording is null.</exception>
    /// <exception cref="OperationCanceledException">The token was cancelled.</exception>
    public static RecordingComparison Of(Recording first, Recording second, CancellationToken cancellation = default)
    {
        _ = first ?? throw new ArgumentNullException(nameof(first));
        _ = second ?? throw new ArgumentNullException(nameof(second));
        if (first.Header is not RecordingHeader a || second.Header is not RecordingHeader b)
        {
            return new RecordingComparison(
                ComparisonOutcome.NothingInCommon, 0, 0, null, "The recordings cannot be compared without both their headers." + Remarks(first, second));
        }

        if (a.SceneHash != b.SceneHash)
        {
            return new RecordingComparison(
                ComparisonOutcome.SceneDiffers, 0, 0, null,
                $"The scenes differ: {Title(first)} in the first, {Title(second)} in the second." + Remarks(first, second));
        }

        if (a.Start != b.Start)
        {
            return new RecordingComparison(
                ComparisonOutcome.StartDiffers, 0, 0, null,
                $"The starts differ: the first session started at {a.Start.ToShortString()}, the second at"
                + $" {b.Start.ToShortString()}." + Remarks(first, second));
        }

        if (a.FoldVersion != b.FoldVersion)
        {
            return new RecordingComparison(
                ComparisonOutcome.FoldVersionDiffers, 0, 0, null,
                FormattableString.Invariant($"The fold versions differ: {a.FoldVersion} in the first, by the library {a.LibraryVersion}; {b.FoldVersion} in the second, by the library {b.LibraryVersion}.")
                    + " They make different states of the same scene and events, so the hashes of one say nothing of the other's." + Remarks(first, second));
        }

        int entries = SameEntries(first, second, out LogEntry? firstEntry, out LogEntry? secondEntry);
        int states = SameStates(first, second, out SimTime? agreed, out CommittedState? firstState, out CommittedState? secondState);
        if (firstEntry is LogEntry one && secondEntry is LogEntry other)
        {
            return new RecordingComparison(
                ComparisonOutcome.EventDiffers, entries, states, agreed,
                FormattableString.Invariant($"Entry {one.Index} of the log differs, at {Words.SinceStart(one.Event.Time, a.Start)}. In the first it is {one}. In the second it is {other}.")
                    + (agreed is SimTime time ? $" Their states agree up to {Words.SinceStart(time, a.Start)}." : " They have no state that agrees.") + Remarks(first, second))
            {
                FirstEntry = one,
                SecondEntry = other,
            };
        }

        if (firstState is CommittedState mine && secondState is CommittedState theirs)
        {
            return OfStates(first, second, entries, states, agreed, mine, theirs, cancellation);
        }

        // Equal events say nothing about the states that a peer derived from them: without a compared state there is no agreement.
        string log = entries == 0 ? "no log entry and no committed time in common" : $"the same in {Words.Count(entries, "common log entry")}, and no"
            + " committed time in common";
        return states == 0
            ? new RecordingComparison(
                ComparisonOutcome.NothingInCommon, entries, 0, null,
                $"The recordings are of one scene and start, and have {log}: of the states nothing is known." + Remarks(first, second))
            : new RecordingComparison(
                ComparisonOutcome.Agrees, entries, states, agreed,
                $"The recordings agree in all that both hold: {Words.Count(entries, "log entry")} and {Words.Count(states, "committed state")}, up to"
                    + $" {Words.SinceStart(agreed!.Value, a.Start)}."
                    + Remarks(first, second));
    }

    private static RecordingComparison OfStates(
        Recording first,
        Recording second,
        int entries,
        int states,
        SimTime? agreed,
        in CommittedState mine,
        in CommittedState theirs,
        CancellationToken cancellation)
    {
        RecordingReplay firstReplay = RecordingReplay.Run(first, mine.Time, cancellation);
        RecordingReplay secondReplay = RecordingReplay.Run(second, mine.Time, cancellation);
        string log = entries == 0 ? "The recordings have no log entry in common" : $"The log is the same in {Words.Count(entries, "common entry")}";
        return new RecordingComparison(
            ComparisonOutcome.StateDiffers, entries, states, agreed,
            $"{log}, and the committed state at {Words.SinceStart(mine.Time, first.Header!.Start)} differs: {mine} in the first; {theirs} in the second."
                + (agreed is SimTime time ? $" Up to {Words.SinceStart(time, first.Header.Start)} they agree." : "") + FirstBody(firstReplay, secondReplay) + $" The first {Verdict(firstReplay, first)} The second"
                    + $" {Verdict(secondReplay, second)}" + Remarks(first, second))
        {
            FirstState = mine,
            SecondState = theirs,
            FirstReplay = firstReplay,
            SecondReplay = secondReplay,
        };
    }

    /// <summary>Counts the entries of equal index that are equal, up to the first pair that is not.</summary>
    private static int SameEntries(Recording first, Recording second, out LogEntry? one, out LogEntry? other)
    {
        one = other = null;
        LogEntry[] a = first.EntryArray;
        LogEntry[] b = second.EntryArray;
        if (a.Length == 0 || b.Length == 0)
        {
            return 0;
        }

        // Neither has gaps, so one offset holds for all entries.
        long begin = Math.Max(a[0].Index, b[0].Index);
        long end = Math.Min(a[^1].Index, b[^1].Index);
        for (long index = begin; index <= end; index++)
        {
            ref readonly LogEntry mine = ref a[index - a[0].Index];
            ref readonly LogEntry theirs = ref b[index - b[0].Index];
            if (!mine.Equals(theirs))
            {
                one = mine;
                other = theirs;
                return (int)(index - begin);
            }
        }

        return (int)Math.Max(0, end - begin + 1);
    }

    /// <summary>
    /// Counts the committed states of equal time that are equal, up to the first pair that is not, and returns the time of the last equal
    /// one.
    /// </summary>
    private static int SameStates(Recording first, Recording second, out SimTime? last, out CommittedState? one, out CommittedState? other)
    {
        last = null;
        one = other = null;
        CommittedState[] a = first.CommittedArray;
        CommittedState[] b = second.CommittedArray;
        int same = 0;
        for (int i = 0, j = 0; i < a.Length && j < b.Length;)
        {
            if (a[i].Time != b[j].Time)
            {
                bool isFirstEarlier = a[i].Time < b[j].Time;
                i += isFirstEarlier ? 1 : 0;
                j += isFirstEarlier ? 0 : 1;
                continue;
            }

            if (!a[i].Equals(b[j]))
            {
                one = a[i];
                other = b[j];
                return same;
            }

            last = a[i].Time;
            same++;
            i++;
            j++;
        }

        return same;
    }

    /// <summary>
    /// Names the first body in which the worlds differ, if both recordings match their replays. A recording holds only hashes, which name
    /// no body.
    /// </summary>
    private static string FirstBody(RecordingReplay first, RecordingReplay second)
    {
        if (first.Outcome != ReplayOutcome.Agrees || second.Outcome != ReplayOutcome.Agrees)
        {
            return " A recording holds hashes of states: which body differs in one that departs from its replay, it cannot tell.";
        }

        Simulation a = first.World!, b = second.World!;
        SimTime time = first.Actual!.Value.Time;
        for (int n = 0; n < Math.Max(a.BodyCount, b.BodyCount); n++)
        {
            BodyId body = n < a.BodyCount ? a.BodyAt(n) : b.BodyAt(n);
            bool isInFirst = a.TryRead(body, time, out BodyState mine), isInSecond = b.TryRead(body, time, out BodyState theirs);
            if (isInFirst != isInSecond || !mine.IsSameBits(theirs))
            {
                return $" The first body that differs is {Words.Named(a.Scene, body)}: {State(isInFirst, mine)} in the first, {State(isInSecond, theirs)} in"
                    + " the second.";
            }
        }

        return " No body differs in its place or motion: what else belongs to a state does, such as who holds what.";
    }

    private static string State(bool isThere, in BodyState state) =>
        !isThere ? "not there"
        : $"{state.Motion} at {state.Position} m with {state.Velocity} m/s" + (state.Spin == Vector3D.Zero ? "" : $" and {state.Spin} rad/s");

    private static string Verdict(RecordingReplay replay, Recording of) => replay.Outcome switch
    {
        ReplayOutcome.Agrees => "agrees with its own replay.",
        ReplayOutcome.Differs => $"departs from its own replay at {Words.SinceStart(replay.Expected!.Value.Time, of.Header!.Start)}.",
        _ => $"has no replay to tell: {replay.Message}",
    };

    private static string Title(Recording recording) =>
        recording.Scene is null ? $"{recording.Header!.SceneHash:x16}" : $"'{recording.Scene.Name}' ({recording.Header!.SceneHash:x16})";

    private static string Remarks(Recording first, Recording second) => $" The first {first.Extent} The second {second.Extent}";
}
