using System;
using LagSim.Time;

namespace LagSim.Net.Clocks;

/// <summary>
/// Estimates how far another peer's clock is ahead of this one and how fast it drifts, from the four timestamps of each exchange, as NTP
/// does.
/// </summary>
/// <remarks>
/// <para>The exchange with the shortest round trip of each second is kept for <see cref="Window"/>, since what waited least in queues is
/// the most precise (NTP's clock filter, RFC 5905).</para>
/// <para><b>Bounds.</b> Whatever the two directions took, the other clock had not yet read t1 when the request left at t0, and had read t2
/// when the answer arrived at t3. So every exchange limits the offset from above at t0 and from below at t3, and every two limit the drift
/// (Duda and others, "Estimating global time in distributed systems", 1987). <see cref="ClockEstimate.ErrorBound"/> is what all of them
/// together leave: at most half the best round trip, plus the possible error of the drift since then. It holds for every path, symmetric or
/// not, as long as the drift is within <see cref="ClockEstimate.MaxDrift"/> and changes by no more than <see cref="Wander"/> over two
/// windows, and readings are good to 1 microsecond.</para>
/// <para><b>Drift.</b> A weighted least-squares line through the midpoints of the kept exchanges. The weight falls with a round trip's
/// excess over the shortest, as in chrony: whatever spoils an offset shows there, so outliers are known before the line is fitted. A prior
/// of no drift, give or take 100 parts per million, counts as one more measurement: few or noisy exchanges move the drift little.</para>
/// <para><b>Offset.</b> The midpoint of what the exchanges leave possible, each aged by the drift and twice its standard error.</para>
/// <para><b>A clock that was stepped</b> (a laptop that slept) or changed its rate contradicts the earlier exchanges: no single line passes
/// between all limits. All but the newest exchange are then forgotten, and the estimate is right again to half a round trip at once. A step
/// too small to contradict, less than a round trip, has left the estimate after one window; until then the bound may be wrong by it.</para>
/// <para>An asymmetric path cannot be detected from two clocks: the same four timestamps arise on a symmetric path between clocks that
/// differ by half the asymmetry more or less. The offset is wrong by that half, which never exceeds the bound.</para>
/// <para>For one thread at a time. Deterministic. Bounded memory, no allocation after construction. An exchange costs a few passes over at
/// most 60 others, however many were added.</para>
/// </remarks>
internal sealed class ClockSync
{
    /// <summary>How long an exchange counts: 60 s. The newest counts until there is a newer one.</summary>
    public static readonly SimDuration Window = SimDuration.FromSeconds(WindowSeconds);

    /// <summary>The longest useful exchange, waiting at the other peer included; a longer one is refused.</summary>
    public static readonly SimDuration MaxExchange = SimDuration.FromSeconds(60);

    /// <summary>
    /// How much the drift may change over two windows, in parts per million: 5. This is an assumption: the bound depends on it, and it is
    /// not checked.
    /// </summary>
    public const double Wander = 5;

    private const int WindowSeconds = 60;
    private const int SecondBits = 40; // a tick is 2^-40 s
    private const double Millionth = 1e-6;
    private const double MaxDrift = ClockEstimate.MaxDrift * Millionth;
    private const double PriorDrift = 100 * Millionth;
    private const double ReadingError = 1e-6; // of one limit, in seconds: some clocks tick at 10 MHz
    private const double PairError = 2 * ReadingError;
    private const int LeastToFit = 4;
    private const int FitPasses = 2; // the weights depend on the typical excess and vice versa; a third pass changes nothing that matters

    // Readings beyond a quarter of the range of a time, 24 days, are refused, so that no difference of two offsets can overflow, 32 s of
    // drift included.
    private const long MaxReading = (1L << 61) - (1L << 45);

    private readonly ClockExchange[] kept = new ClockExchange[WindowSeconds]; // the best of each second, oldest first
    private readonly int readyAfter;
    private int count;
    private SimTime last;
    private double drift;
    private double driftError = 2 * PriorDrift; // two standard errors

    /// <summary>Creates an estimate without samples.</summary>
    /// <param name="readyAfter">The number of samples that make it <see cref="IsReady"/>, at least 1.</param>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="readyAfter"/> is below 1.</exception>
    public ClockSync(int readyAfter = 8)
    {
        if (readyAfter < 1)
        {
            throw new ArgumentOutOfRangeException(nameof(readyAfter), readyAfter, "At least one sample is needed to know anything.");
        }

        this.readyAfter = readyAfter;
    }

    /// <summary>The number of accepted samples, including those that have left the window.</summary>
    public int SampleCount { get; private set; }

    /// <summary>The number of samples refused as impossible.</summary>
    public int RefusedCount { get; private set; }

    /// <summary>
    /// How often a sample contradicted the earlier ones, which were then forgotten: a clock was stepped or changed its rate.
    /// </summary>
    public int RestartCount { get; private set; }

    /// <summary>Whether there are enough samples to set a clock.</summary>
    public bool IsReady => SampleCount >= readyAfter;

    /// <summary>The estimate of the other peer's clock as of the newest sample; without samples, that the two clocks are equal.</summary>
    public ClockEstimate Estimate { get; private set; }

    /// <summary>The shortest round trip in the window, without the time spent at the other peer; zero without samples.</summary>
    public SimDuration RoundTrip { get; private set; }

    /// <summary>Adds one exchange. The two own times are of this peer's clock, the two other times of the other peer's.</summary>
    /// <param name="ownSend">t0: when the request left.</param>
    /// <param name="otherReceive">t1: when it arrived at the other peer.</param>
    /// <param name="otherSend">t2: when the answer left the other peer.</param>
    /// <param name="ownReceive">t3: when the answer arrived.</param>
    /// <returns>
    /// False if the sample is refused as impossible or absurd: a time beyond 24 days of its origin, times out of order, a negative round
    /// trip that no drift explains, or more than <see cref="MaxExchange"/> in all. Never throws.
    /// </returns>
    public bool Add(SimTime ownSend, SimTime otherReceive, SimTime otherSend, SimTime ownReceive)
    {
        if (!IsReading(ownSend) || !IsReading(otherReceive) || !IsReading(otherSend) || !IsReading(ownReceive))
        {
            return Refuse();
        }

        SimDuration length = ownReceive - ownSend;
        if (length < SimDuration.Zero || length > MaxExchange || otherSend < otherReceive)
        {
            return Refuse();
        }

        ClockExchange exchange = new(ownSend, otherReceive, otherSend, ownReceive);
        if (exchange.Width(MaxDrift) < -PairError)
        {
            return Refuse();
        }

        SampleCount += SampleCount < int.MaxValue ? 1 : 0;
        if (count > 0 && (ownReceive < last || !TryTake(exchange)))
        {
            RestartCount += RestartCount < int.MaxValue ? 1 : 0;
            count = 0;
            drift = 0;
            driftError = 2 * PriorDrift;
        }

        if (count == 0)
        {
            TryTake(exchange); // a lone exchange contradicts nothing
        }

        last = ownReceive;
        return true;
    }

    private static bool IsReading(SimTime time) => time.Ticks is > -MaxReading and < MaxReading;

    private static long Second(SimTime time) => time.Ticks >> SecondBits;

    private bool Refuse()
    {
        RefusedCount += RefusedCount < int.MaxValue ? 1 : 0;
        return false;
    }

    /// <summary>
    /// Keeps the exchange if it is the best of its second, and updates the estimate. False if it contradicts those kept: the estimate is
    /// then unchanged, and the kept exchanges are useless.
    /// </summary>
    private bool TryTake(ClockExchange exchange)
    {
        Forget(exchange.Back - Window);
        for (int i = 0; i < count; i++)
        {
            exchange.LimitDrift(kept[i], PairError);
        }

        if (count > 0 && Second(kept[count - 1].Back) == Second(exchange.Back))
        {
            // Whichever stays keeps the drift limits of both.
            ref ClockExchange newest = ref kept[count - 1];
            double steepest = drift + driftError;
            ClockExchange other = newest;
            if (exchange.Width(steepest) <= newest.Width(steepest))
            {
                newest = exchange;
                newest.Intersect(other.MinDriftSeen, other.MaxDriftSeen);
            }
            else
            {
                newest.Intersect(exchange.MinDriftSeen, exchange.MaxDriftSeen);
            }
        }
        else
        {
            kept[count++] = exchange;
        }

        return TryEstimate(exchange.Back, exchange.Least);
    }

    private void Forget(SimTime before)
    {
        int old = 0;
        while (old < count && Second(kept[old].Back) <= Second(before))
        {
            old++;
        }

        count -= old;
        Array.Copy(kept, old, kept, 0, count);
    }

    private bool TryEstimate(SimTime at, SimDuration reference)
    {
        double least = -MaxDrift, most = MaxDrift;
        for (int i = 0; i < count; i++)
        {
            least = Math.Max(least, kept[i].MinDriftSeen - (Wander * Millionth));
            most = Math.Min(most, kept[i].MaxDriftSeen + (Wander * Millionth));
        }

        (double low, double high) = Limits(at, reference, least, most, 0);
        if (least > most || low - high > PairError)
        {
            return false;
        }

        FitDrift(at, reference, least, most);
        (double likelyLow, double likelyHigh) = Limits(at, reference, drift, drift, driftError);
        double middle = (likelyLow + likelyHigh) / 2;
        middle = low <= high ? Math.Min(Math.Max(middle, low), high) : (low + high) / 2;
        double bound = Math.Max(Math.Max(high - middle, middle - low), 0) + ReadingError;
        Estimate = new ClockEstimate(
            at,
            reference + SimDuration.FromSeconds(middle),
            drift,
            SimDuration.FromSeconds(bound),
            Math.Max(most - drift, drift - least));
        RoundTrip = SimDuration.FromSeconds(Math.Max(0, Narrowest(drift)));
        return true;
    }

    /// <summary>
    /// The range of offsets that all exchanges allow at a local time, in seconds above a reference, for a drift in a range.
    /// </summary>
    /// <param name="at">The local time.</param>
    /// <param name="reference">The reference.</param>
    /// <param name="minDrift">The least drift, as a fraction.</param>
    /// <param name="maxDrift">The most drift, as a fraction.</param>
    /// <param name="widening">
    /// How much the range of an exchange widens with its age, equally to both sides, so that its midpoint stays.
    /// </param>
    private (double Low, double High) Limits(SimTime at, SimDuration reference, double minDrift, double maxDrift, double widening)
    {
        double low = double.NegativeInfinity, high = double.PositiveInfinity;
        for (int i = 0; i < count; i++)
        {
            low = Math.Max(low, kept[i].LowerBoundAt(at, reference, minDrift) - (widening * kept[i].Age(at)));
            high = Math.Min(high, kept[i].UpperBoundAt(at, reference, maxDrift) + (widening * kept[i].Age(at)));
        }

        return (low, high);
    }

    private double Narrowest(double ifDrift)
    {
        double narrowest = double.PositiveInfinity;
        for (int i = 0; i < count; i++)
        {
            narrowest = Math.Min(narrowest, kept[i].Width(ifDrift));
        }

        return narrowest;
    }

    private void FitDrift(SimTime at, SimDuration reference, double least, double most)
    {
        if (count < LeastToFit)
        {
            return; // a few round trips can be alike by chance, and would look certain
        }

        double typical = double.PositiveInfinity; // excess of a round trip; all weigh the same before it is known
        for (int pass = 0; pass < FitPasses; pass++)
        {
            double steepest = drift + driftError;
            double narrowest = Narrowest(steepest);
            typical = ReadingError + TypicalExcess(steepest, narrowest, typical);

            double sum = 0, times = 0, offsets = 0;
            for (int i = 0; i < count; i++)
            {
                double weight = Weight(kept[i].Width(steepest) - narrowest, typical);
                (double time, double offset) = kept[i].Middle(at, reference);
                sum += weight;
                times += weight * time;
                offsets += weight * offset;
            }

            double timeSquares = 0, products = 0, offsetSquares = 0;
            for (int i = 0; i < count; i++)
            {
                double weight = Weight(kept[i].Width(steepest) - narrowest, typical);
                (double time, double offset) = kept[i].Middle(at, reference);
                timeSquares += weight * (time - (times / sum)) * (time - (times / sum));
                products += weight * (time - (times / sum)) * (offset - (offsets / sum));
                offsetSquares += weight * (offset - (offsets / sum)) * (offset - (offsets / sum));
            }

            // Offsets that scatter more than their round trips suggested are worth less.
            double scatter = Math.Max(1, (offsetSquares - (products * products / timeSquares)) / (count - 2));
            double squares = (timeSquares / scatter) + (1 / (PriorDrift * PriorDrift));
            drift = Math.Min(Math.Max(products / scatter / squares, least), most);
            driftError = 2 / Math.Sqrt(squares);
        }
    }

    private double TypicalExcess(double steepest, double narrowest, double typical)
    {
        double sum = 0, excesses = 0;
        for (int i = 0; i < count; i++)
        {
            double excess = kept[i].Width(steepest) - narrowest;
            double weight = double.IsPositiveInfinity(typical) ? 1 : Weight(excess, typical);
            sum += weight;
            excesses += weight * excess;
        }

        return excesses / sum;
    }

    /// <summary>
    /// The inverse variance of an offset. An excess e shifts it by at most e / 2; typically half of that is its standard deviation.
    /// </summary>
    private static double Weight(double excess, double typical) => 16 / ((typical + excess) * (typical + excess));
}
