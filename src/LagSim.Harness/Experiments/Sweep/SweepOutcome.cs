using System;
using System.Collections.Generic;
using System.Globalization;

namespace LagSim.Harness.Experiments.Sweep;

/// <summary>What came of one cell of the sweep over full links.</summary>
public sealed record SweepOutcome
{
    /// <summary>The cell.</summary>
    public required SweepCell Cell { get; init; }

    /// <summary>What the events that a client is to hear of need a second on its link, in bytes, without what datagrams add.</summary>
    public double OfferedBytesPerSecond { get; init; }

    /// <summary>What of that came while it was played, in the mean of all clients.</summary>
    public double DeliveredBytesPerSecond { get; init; }

    /// <summary>What the host sent a client a second, in bytes, with what UDP and IP add.</summary>
    public double SentBytesPerSecond { get; init; }

    /// <summary>What a client sent the host, likewise.</summary>
    public double SentUpBytesPerSecond { get; init; }

    /// <summary>The round trip of an idle session on such a link, in milliseconds.</summary>
    public double IdleRoundTripMs { get; init; }

    /// <summary>The median of the round trips while it was played.</summary>
    public double RoundTripP50Ms { get; init; }

    /// <summary>Their 99th percentile.</summary>
    public double RoundTripP99Ms { get; init; }

    /// <summary>The longest after a dip until the round trip was below twice the idle one again, in seconds; 0 without dips.</summary>
    public double RecoverySeconds { get; init; }

    /// <summary>For how long queues showed on the way to clients, in seconds, summed over all of them.</summary>
    public double QueuedSeconds { get; init; }

    /// <summary>
    /// What the host sent meanwhile, in bytes of updates without UDP and IP, for each byte of entries that came; 0 if no queue showed.
    /// </summary>
    public double SentPerNeededByteWhileQueued { get; init; }

    /// <summary>Events that clients did.</summary>
    public long Done { get; init; }

    /// <summary>Those that the host refused.</summary>
    public long Refused { get; init; }

    /// <summary>Those on which no client heard a verdict, since it lost its world first.</summary>
    public long Unanswered { get; init; }

    /// <summary>Accepted events that stand in the host's log and came to a client neither by the log nor in a copy.</summary>
    public long Lost { get; init; }

    /// <summary>Committed states that were not the host's.</summary>
    public long Differed { get; init; }

    /// <summary>How many of the states that the host committed each client compared, as a share; the least of all clients.</summary>
    public double ComparedShare { get; init; }

    /// <summary>How often a client got a fresh copy.</summary>
    public long Copies { get; init; }

    /// <summary>How many clients' sessions ended because the link is too slow.</summary>
    public int TooSlow { get; init; }

    /// <summary>What went wrong otherwise, as a sentence; null if nothing did.</summary>
    public string? Failure { get; init; }

    /// <summary>The least <see cref="ComparedShare"/> that a cell must show.</summary>
    public const double MinComparedShare = 0.9;

    /// <summary>The load up to which no link may be too slow for a client.</summary>
    public const double LoadForAll = 0.8;

    /// <summary>
    /// How much of the link the events and what one update for each three of them adds would take, in the direction that carries more.
    /// </summary>
    public double LoadShare { get; init; }

    /// <summary>
    /// Whether the cell shows what it must: nothing lost, nothing differs, enough compared; on links with less than 80 % of load, nobody
    /// too slow either.
    /// </summary>
    public bool IsGood => Shortfall is null;

    /// <summary>What of that it does not show, as sentences, <see cref="Failure"/> first; null if it shows all of it.</summary>
    public string? Shortfall
    {
        get
        {
            List<string> sentences = Failure is null ? [] : [Failure];
            Add(Lost > 0, $"{Lost} of the accepted events did not reach a client; all must.");
            Add(Differed > 0, $"{Differed} of the committed states compared differed; none may.");
            Add(
                Failure is null && !(ComparedShare >= MinComparedShare),
                $"A client compared only {PercentBelow(ComparedShare)} % of the host's committed states; at least {100 * MinComparedShare:0} % must be compared.");
            Add(
                TooSlow > 0 && LoadShare <= LoadForAll,
                $"The link was too slow for {TooSlow} of the clients at {100 * LoadShare:0} % load; up to {100 * LoadForAll:0} % it must not be.");
            return sentences.Count == 0 ? null : string.Join(" ", sentences);

            void Add(bool isSo, FormattableString sentence)
            {
                if (isSo)
                {
                    sentences.Add(FormattableString.Invariant(sentence));
                }
            }
        }
    }

    /// <summary>A share in percent, rounded down to a tenth, so that what is below a bound never reads as if it reached it.</summary>
    internal static string PercentBelow(double share) => (Math.Floor(1000 * share) / 10).ToString("0.#", CultureInfo.InvariantCulture);
}
