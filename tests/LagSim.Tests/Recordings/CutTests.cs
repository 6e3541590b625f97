using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Recordings;
using LagSim.Tests.Determinism;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.Recordings.Recorded;

namespace LagSim.Tests.Recordings;

/// <summary>Wherever a recording is cut, at a record's end or within it, it is told, and what it holds is compared and run again.</summary>
public sealed class CutTests
{
    private const string NoEnd = " has no end record: its writer was ended or still writes, or the file is cut; it holds ";

    [Fact]
    public void CompareAndReplay_CutAtEveryByte_AgreeAsFarAsItHoldsAndSaySo()
    {
        byte[][] files =
        [
            Small(),
            Small(Log[2..], 3, joined: Joined(3, 1)),
            Small(log: []), // states alone, of a peer that never was told a thing
        ];
        foreach (byte[] whole in files)
        {
            Recording all = Read(whole);
            HashSet<int> ends = [.. Boundaries(whole)];
            int scene = Boundaries(whole)[2], agreed = 0;
            for (int length = 0; length <= whole.Length; length++)
            {
                Recording cut = Read(whole[..length]);
                string lacks = length == whole.Length ? " holds " : ends.Contains(length) && length >= scene ? NoEnd : " is damaged at byte ";
                Assert.Equal(length == whole.Length, cut.IsWhole);
                Assert.Equal(cut.Committed.Count > 0 ? cut.Committed[^1].Time : null, cut.HoldsUpTo);
                Assert.StartsWith(lacks, " " + cut.Extent, StringComparison.Ordinal);
                if (cut.HoldsUpTo is SimTime until)
                {
                    string holds = FormattableString.Invariant($"{cut.Entries.Count} log entr");
                    Assert.Contains(holds, cut.Extent, StringComparison.Ordinal);
                    Assert.Contains(FormattableString.Invariant($"{cut.Committed.Count} committed state"), cut.Extent, StringComparison.Ordinal);
                    Assert.Contains(FormattableString.Invariant($" up to T {(until - Start).ToSeconds()} s"), cut.Extent, StringComparison.Ordinal);
                }

                RecordingComparison compared = Compared(all, cut), turned = Compared(cut, all);
                bool isEnough = cut.HoldsUpTo is not null;
                Assert.Equal(isEnough ? ComparisonOutcome.Agrees : ComparisonOutcome.NothingInCommon, compared.Outcome);
                Assert.Equal((cut.Committed.Count, cut.HoldsUpTo), (compared.StatesCompared, compared.AgreedUpTo));
                Assert.Equal((compared.Outcome, compared.EntriesCompared, compared.AgreedUpTo), (turned.Outcome, turned.EntriesCompared, turned.AgreedUpTo));
                Assert.EndsWith($" The first {all.Extent} The second {cut.Extent}", compared.Message, StringComparison.Ordinal);
                agreed += isEnough ? 1 : 0;
            }

            Assert.InRange(agreed, 50, whole.Length - scene); // or nothing was tried
        }
    }

    [Fact]
    public void Replay_CutAtEveryByteBehindTheScene_AgreesUpToItsLastState()
    {
        byte[] whole = Small();
        for (int length = Boundaries(whole)[2]; length <= whole.Length; length++)
        {
            Recording cut = Read(whole[..length]);
            RecordingReplay replay = Replayed(cut);

            // Entries are written when they come and states when nothing more can come before them, so what is there up to a state is all that made it.
            Assert.Equal(cut.HoldsUpTo is null ? ReplayOutcome.NothingToCheck : ReplayOutcome.Agrees, replay.Outcome);
            Assert.Equal((cut.Committed.Count, cut.HoldsUpTo), (replay.StatesChecked, replay.AgreedUpTo));
            Assert.EndsWith(" The recording " + cut.Extent, replay.Message, StringComparison.Ordinal);
        }
    }

    [Fact]
    public void CompareAndReplay_AnyWorldCutAnywhere_AgreeAsFarAsItHolds()
    {
        for (int seed = 1; seed <= 20; seed++)
        {
            byte[] whole = [.. Recorded.Random(seed, out RandomWorld world), .. Record(6, [])]; // an end may have no reason
            Recording all = Read(whole, world.Scene.Accelerations);
            Assert.True(all.IsWhole, all.Extent);
            Random random = new(seed);
            foreach (int length in Boundaries(whole).Skip(2).SkipLast(1).SelectMany(at => new[] { at, at + 1 + random.Next(5) }))
            {
                Recording cut = Read(whole[..length], world.Scene.Accelerations);
                Assert.False(cut.IsWhole);
                Assert.Equal(cut.HoldsUpTo, Compared(cut, all).AgreedUpTo);
            }

            // Half of it is run again.
            int half = Boundaries(whole)[Boundaries(whole).Count / 2];
            RecordingReplay replay = Replayed(Read(whole[..half], world.Scene.Accelerations));
            Assert.True(replay.Outcome is ReplayOutcome.Agrees or ReplayOutcome.NothingToCheck, $"seed {seed}: {replay.Message}");
        }
    }

    [Fact]
    public void Compare_CutThatDiffersBeforeIt_IsNoAgreement()
    {
        // The control: that a recording is cut excuses nothing of what it holds.
        byte[] other = Small(truth: Log[1..]); // hashes of a world in which the first event never was
        int cut = Boundaries(other)[^2];
        RecordingComparison compared = Compared(Read(Small()), Read(other[..cut]));
        Assert.Equal((ComparisonOutcome.StateDiffers, Start), (compared.Outcome, compared.AgreedUpTo));
        Assert.Contains(" The second" + NoEnd, compared.Message, StringComparison.Ordinal);
        Assert.Equal((ReplayOutcome.Differs, Start), (Replayed(Read(other[..cut])).Outcome, Replayed(Read(other[..cut])).AgreedUpTo));
    }

    [Fact]
    public void IsWhole_OfAnEndAndMoreBehindIt_IsFalse()
    {
        byte[] whole = Small();
        Assert.True(Read(whole).IsWhole);
        Recording more = Read([.. whole, 5]);
        Assert.False(more.IsWhole);
        Assert.Equal(
            $"is damaged at byte {whole.Length}, and holds 6 log entries, and 5 committed states up to T 2 s before that: There is a committed state after the recording's end.", more.Extent);
    }
}
