using System;
using LagSim.Time;

namespace LagSim.Net.Clocks;

/// <summary>How far another peer's clock is ahead of one's own and how fast it drifts, from the four times of each exchange, as NTP takes them.</summary>
/// <remarks>
/// <para>Of each second the exchange of the shortest round trip is kept, for what waited least in queues says most (NTP's clock filter,
/// RFC 5905), for <see cref="Window"/>.</para>
/// <para><b>Bounds.</b> Whatever the ways took, the other clock had not yet read t1 when the request left at t0, and had read t2 when the answer came at
/// t3. So every exchange limits the offset from above at t0 and from below at t3, and every two limit the drift (Duda and others,
/// "Estimating global time in distributed systems", 1987). <see cref="ClockEstimate.ErrorBound"/> is what all of them together leave: at most
/// half the best round trip, plus what the drift may be wrong by since. It holds for every path, symmetric or not, as long as the drift is
/// within <see cref="ClockEstimate.MaxDrift"/> and changes by no more than <see cref="Wander"/> over two windows, and readings are good to 1
/// microsecond.</para>
/// <para><b>Drift.</b> A weighted least-squares line through the middles of the kept exchanges. The weight falls with what a round trip has in excess of
/// the shortest, as chrony's does: whatever makes an offset wrong shows there, so an outlier is known before the line is drawn. No drift, give or
/// take 100 parts per million, counts as one more measurement: few or noisy exchanges move the drift little.</para>
/// <para><b>Offset.</b> The middle of what the exchanges leave possible, each aged by the drift and twice its standard error.</para>
/// <para><b>A clock that was stepped</b> (a laptop that slept) or changed its rate contradicts the exchanges before: no one line passes between all
/// limits. Then all but the newest exchange is forgotten, and the estimate is right again to half a round trip at once. A step too small to contradict,
/// less than a round trip, is gone when the window is; until then the bound may be wrong by it.</para>
/// <para>A path that is slower one way than the other cannot be seen from two clocks: the same four times arise on an even path between clocks that
/// differ by half the difference more or less. The offset is wrong by that half, which is never more than the bound.</para>
/// <para>For one thread at a time. Deterministic. Bounded memory, no allocation after construction. An exchange costs a few passes over at most 60 others,
/// however many came.</para>
/// </remarks>
internal sealed class ClockSync
{
    /// <summary>For how long an exchange counts: 60 s. The newest counts until there is a newer one.</summary>
    public static readonly SimDuration Window = SimDuration.FromSeconds(WindowSeconds);

    /// <summary>An exchange that took longer than this, waiting at the other peer included, says nothing worth having.</summary>
    public static readonly SimDuration MaxExchange = SimDuration.FromSeconds(60);

    /// <summary>By how much the drift may change over two windows, in parts per million: 5. An assumption: the bound rests on it, nothing checks it.</summary>
    public const double Wander = 5;

    private const int WindowSeconds = 60;
    private const int SecondBits = 40; // a tick is 2^-40 s
    private const double Millionth = 1e-6;
    private const double MaxDrift = ClockEstimate.MaxDrift * Millionth;
    private const double PriorDrift = 100 * Millionth;
    private const double ReadingError = 1e-6; // of one limit, in seconds: clocks of 10 MHz exist
    private const double PairError = 2 * ReadingError;
    private const int LeastToFit = 4;
    private const int FitPasses = 2; // the weights depend on the typical excess, and that on the weights; a third pass changes nothing that counts

    // Readings beyond a quarter of the range of a time, 24 days, are refused: no difference of two offsets can overflow, 32 s of drift included.
    private const long MaxReading = (1L << 61) - (1L << 45);

    private readonly ClockExchange[] kept = new ClockExchange[WindowSeconds]; // the best of each second, oldest first
    private readonly int readyAfter;
    private int count;
    private SimTime last;
    private double drift;
    private double driftError = 2 * PriorDrift; // two standard errors

    /// <summary>An estimate without samples.</summary>
    /// <param name="readyAfter">How many samples make it <see cref="IsReady"/>, at least 1.</param>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="readyAfter"/> is below 1.</exception>
    public ClockSync(int readyAfter = 8)
    {
        if (readyAfter < 1)
        {
            throw new ArgumentOutOfRangeException(nameof(readyAfter), readyAfter, "At least one sample is needed to know anything.");
        }

        this.readyAfter = readyAfter;
    }

    /// <summary>How many samples were taken in, including those that left the window since.</summary>
    public int SampleCount { get; private set; }

    /// <summary>How many samples were refused as impossible.</summary>
    public int RefusedCount { get; private set; }

    /// <summary>How often a sample contradicted those before it, which were then forgotten: a clock was stepped or changed its rate.</summary>
    public int RestartCount { get; private set; }

    /// <summary>Whether there are enough samples to set a clock by.</summary>
    public bool IsReady => SampleCount >= readyAfter;

    /// <summary>What is known of the other peer's clock, as of the newest sample; both clocks the same without samples.</summary>
    public ClockEstimate Estimate { get; private set; }

    /// <summary>The shortest round trip in the window, without the time spent at the other peer; zero without samples.</summary>
    public SimDuration RoundTrip { get; private set; }

    /// <summary>Takes in one exchange. The two own times are of one clock, the two other times of the other peer's.</summary>
    /// <param name="ownSend">t0: when the request left.</param>
    /// <param name="otherReceive">t1: when it arrived there.</param>
    /// <param name="otherSend">t2: when the answer left there.</param>
    /// <param name="ownReceive">t3: when it arrived.</param>
    /// <returns>
    /// False when the sample is impossible or absurd, and refused: a time beyond 24 days of its origin, an order that cannot be, a negative
    /// round trip that no drift explains, or more than <see cref="MaxExchange"/> in all. Never throws.
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
            TryTake(exchange); // alone it contradicts nothing
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
    /// Keeps the exchange if it is the best of its second, and estimates anew. False if it contradicts what is kept: the estimate is the old one, and what is
    /// kept is of no use.
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
            // Whichever stays, what both said of the drift does.
            ref ClockExchange newest = ref kept[count - 1];
            double steepest = drift + driftError;
            ClockExchange other = newest;
            if (exchange.Width(steepest) <= newest.Width(steepest))
            {
                newest = exchange;
                newest.Intersect(other.LeastDrift, other.MostDrift);
            }
            else
            {
                newest.Intersect(exchange.LeastDrift, exchange.MostDrift);
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
            least = Math.Max(least, kept[i].LeastDrift - (Wander * Millionth));
            most = Math.Min(most, kept[i].MostDrift + (Wander * Millionth));
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

    /// <summary>What all exchanges leave possible for the offset at that own time, in seconds above a reference, if the drift is between the two.</summary>
    /// <param name="at">The own time.</param>
    /// <param name="reference">The reference.</param>
    /// <param name="leastDrift">The least drift, as a fraction.</param>
    /// <param name="mostDrift">The most drift, as a fraction.</param>
    /// <param name="widening">How much wider the room of an exchange is made with its age: to both sides alike, so that its middle stays where it is.</param>
    private (double Low, double High) Limits(SimTime at, SimDuration reference, double leastDrift, double mostDrift, double widening)
    {
        double low = double.NegativeInfinity, high = double.PositiveInfinity;
        for (int i = 0; i < count; i++)
        {
            low = Math.Max(low, kept[i].LeastAt(at, reference, leastDrift) - (widening * kept[i].Age(at)));
            high = Math.Min(high, kept[i].MostAt(at, reference, mostDrift) + (widening * kept[i].Age(at)));
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
            return; // few round trips can be alike by chance, and would seem to know
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

            // Offsets that scatter more than their round trips told say less.
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

    /// <summary>One over the variance of an offset. An excess e moves it by at most e / 2; typically half of that is its standard deviation.</summary>
    private static double Weight(double excess, double typical) => 16 / ((typical + excess) * (typical + excess));
}
