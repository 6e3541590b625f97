using System;
using System.Linq;
using LagSim.Harness.Experiments.Sweep;
using LagSim.Tests.Sessions;
using Xunit;

namespace LagSim.Tests.Sweep;

/// <summary>What a session gets through links that are nearly full, or more than that; and that what goes wrong without each rule is seen.</summary>
public sealed class LinkSweepTests
{
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Play_TwentyEventsASecondOfThreeThrough256Kilobits_KeepsTheRoundTripAndRefusesNothing(bool isShared)
    {
        SweepOutcome outcome = Play(Usual with { IsShared = isShared });

        Assert.True(outcome.IsGood, Text(outcome));
        Assert.True(outcome.RoundTripP50Ms < 2 * outcome.IdleRoundTripMs, Text(outcome));
        Assert.Equal(0, outcome.Refused);
        Assert.InRange(outcome.DeliveredBytesPerSecond, 0.98 * outcome.OfferedBytesPerSecond, 1.02 * outcome.OfferedBytesPerSecond);
    }

    [Fact]
    public void Play_ControllerThatNeverBacksOff_IsSeenByTheRoundTrip()
    {
        SweepOutcome outcome = Play(Usual with { IsShared = true, Prepare = static (_, session) => session.Put(SessionFault.NeverBacksOff) });

        Assert.True(outcome.RoundTripP50Ms > 2 * outcome.IdleRoundTripMs, Text(outcome));
    }

    [Fact]
    public void Play_AfterADip_IsBackWithinThreeSeconds()
    {
        SweepOutcome outcome = Play(Usual with { PlaySeconds = 100 }, hasDips: true);

        Assert.True(outcome.IsGood && outcome.RecoverySeconds <= 3, Text(outcome));
    }

    [Fact]
    public void Play_WhereQueuesStand_SendsAtMostHalfAsMuchAgainAsIsNeeded()
    {
        SweepOptions full = Usual with { Clients = [8], EventsPerSecond = [20], KilobitsPerSecond = [64] };
        SweepOutcome outcome = Play(full);
        SweepOutcome pushed = Play(full with { Prepare = static (_, session) => session.Put(SessionFault.NeverBacksOff) });

        Assert.True(outcome.QueuedSeconds > 20, Text(outcome));
        Assert.True(outcome.SentPerNeededByteWhileQueued <= 1.5, Text(outcome));
        Assert.True(pushed.SentPerNeededByteWhileQueued > 1.5, Text(pushed));
    }

    [Fact]
    public void Play_MoreThanTheLinkCarries_LosesNothingUnlessItForgetsTooEarly()
    {
        SweepOptions tooMuch = Usual with { Clients = [3], EventsPerSecond = [40], KilobitsPerSecond = [64], RestSeconds = 60 };
        SweepOutcome outcome = Play(tooMuch, hasDips: true);
        SweepOutcome forgetful = Play(tooMuch with { Prepare = static (_, session) => session.Put(SessionFault.ForgetsTooEarly) }, hasDips: true);

        Assert.True(outcome.IsGood && outcome.Lost == 0 && outcome.Differed == 0, Text(outcome));
        Assert.True(forgetful.Lost + forgetful.Differed > 0, Text(forgetful));
    }

    [Fact]
    public void Play_TheSameCellTwice_IsTheSame() => Assert.Equal(Play(Usual with { PlaySeconds = 5 }), Play(Usual with { PlaySeconds = 5 }));

    private static readonly SweepOptions Usual = new()
    {
        Clients = [3],
        EventsPerSecond = [20],
        KilobitsPerSecond = [256],
        QueueMilliseconds = [500],
        PlaySeconds = 40,
        RestSeconds = 20,
        Workers = 1,
    };

    private static SweepOutcome Play(SweepOptions options, bool hasDips = false) =>
        LinkSweep.Run(options with { Dips = hasDips }, null, TestContext.Current.CancellationToken).Single(o => o.Cell.HasDips == hasDips);

    private static string Text(SweepOutcome outcome) => FormattableString.Invariant(
        $"{outcome.Cell}: {outcome.Failure} idle {outcome.IdleRoundTripMs:0} ms, p50 {outcome.RoundTripP50Ms:0}, p99 {outcome.RoundTripP99Ms:0}, offered {outcome.OfferedBytesPerSecond:0}, ")
        + FormattableString.Invariant($"came {outcome.DeliveredBytesPerSecond:0}, refused {outcome.Refused}, lost {outcome.Lost}, differ {outcome.Differed}, recovery {outcome.RecoverySeconds:0.0} s, ")
        + FormattableString.Invariant($"queued {outcome.QueuedSeconds:0} s at {outcome.SentPerNeededByteWhileQueued:0.00}, compared {outcome.ComparedShare:0.00}, too slow {outcome.TooSlow}");
}
