using System;
using System.Collections.Generic;
using System.Globalization;

namespace LagSim.Harness.Experiments.Sweep;

/// <summary>The result of one cell of the sweep over full links.</summary>
public sealed record SweepOutcome
{
    /// <summary>The cell.</summary>
    public required SweepCell Cell { get; init; }

    /// <summary>The bytes per second that a client's share of events needs on its link, without datagram overhead.</summary>
    public double OfferedBytesPerSecond { get; init; }

    /// <summary>The bytes per second of that which arrived during play, averaged over all clients.</summary>
    public double DeliveredBytesPerSecond { get; init; }

    /// <summary>The bytes per second that the host sent to a client, with UDP and IP headers.</summary>
    public double SentBytesPerSecond { get; init; }

    /// <summary>The bytes per second that a client sent to the host, with UDP and IP headers.</summary>
    public double SentUpBytesPerSecond { get; init; }

    /// <summary>The round trip of an idle session on such a link, in milliseconds.</summary>
    public double IdleRoundTripMs { get; init; }

    /// <summary>The median round trip during play, in milliseconds.</summary>
    public double RoundTripP50Ms { get; init; }

    /// <summary>The 99th percentile of the round trips, in milliseconds.</summary>
    public double RoundTripP99Ms { get; init; }

    /// <summary>The longest time after a dip until the round trip was below twice the idle one again, in seconds; 0 without dips.</summary>
    public double RecoverySeconds { get; init; }

    /// <summary>How long queues towards clients were not empty, in seconds, summed over all clients.</summary>
    public double QueuedSeconds { get; init; }

    /// <summary>
    /// The bytes of updates that the host sent meanwhile for each byte of entries that arrived, without UDP and IP headers; 0 if no queue
    /// built up.
    /// </summary>
    public double SentPerNeededByteWhileQueued { get; init; }

    /// <summary>The number of events of the clients.</summary>
    public long Done { get; init; }

    /// <summary>The number of events that the host refused.</summary>
    public long Refused { get; init; }

    /// <summary>The number of events without a verdict, because the client lost its world first.</summary>
    public long Unanswered { get; init; }

    /// <summary>The number of accepted events that reached a client neither by the log nor in a snapshot.</summary>
    public long Lost { get; init; }

    /// <summary>The number of committed states that differ from the host's.</summary>
    public long Differed { get; init; }

    /// <summary>The share of the host's committed states that a client compared; the least of all clients.</summary>
    public double ComparedShare { get; init; }

    /// <summary>The number of fresh snapshots that clients got.</summary>
    public long Copies { get; init; }

    /// <summary>The number of clients whose sessions ended because the link is too slow.</summary>
    public int TooSlow { get; init; }

    /// <summary>Any other failure, as a sentence; null if there is none.</summary>
    public string? Failure { get; init; }

    /// <summary>The least <see cref="ComparedShare"/> that a cell must show.</summary>
    public const double MinComparedShare = 0.9;

    /// <summary>The load up to which no link may be too slow for a client.</summary>
    public const double LoadForAll = 0.8;

    /// <summary>
    /// The fraction of the link that the events, and one update for each three of them, would take, in the busier direction.
    /// </summary>
    public double LoadShare { get; init; }

    /// <summary>
    /// Whether the cell passes: nothing is lost, nothing differs, and enough was compared. On links with less than 80 % load, no client may
    /// be too slow either.
    /// </summary>
    public bool IsGood => Shortfall is null;

    /// <summary>The reasons why the cell fails, as sentences, <see cref="Failure"/> first; null if it passes.</summary>
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

    /// <summary>A share in percent, rounded down to a tenth, so that a value below a bound never reads as if it reached it.</summary>
    internal static string PercentBelow(double share) => (Math.Floor(1000 * share) / 10).ToString("0.#", CultureInfo.InvariantCulture);
}
