using System;
using LagSim.Time;

namespace LagSim.Net.Clocks;

/// <summary>How far another peer's clock is ahead of one's own, from the four times of each exchange, as NTP does it.</summary>
/// <remarks>
/// <para>Of the last <see cref="WindowSamples"/> exchanges the one with the least bound on its error counts: half its round trip, for what
/// waited least in queues says most, and what two clocks may have drifted apart since, <see cref="DriftShare"/> of its age, as in NTP's
/// dispersion. The drift itself is not fitted.</para>
/// <para>A path that is slower one way than the other cannot be seen from two clocks. It shifts the offset by half the difference, never by
/// more than <see cref="ErrorBound"/>.</para>
/// <para>For one thread at a time. Integers only, no allocation after construction.</para>
/// </remarks>
public sealed class ClockSync
{
    /// <summary>The number of exchanges among which the best is chosen.</summary>
    public const int WindowSamples = 64;

    /// <summary>An exchange that took longer than this, waiting at the other peer included, says nothing worth having.</summary>
    public static readonly SimDuration MaxExchange = SimDuration.FromSeconds(60);

    /// <summary>One part in this many is what two clocks are allowed to drift apart: 50 millionths.</summary>
    public const int DriftShare = 20_000;

    // Readings beyond a quarter of the range of a time, 24 days, are refused: no difference of two offsets can overflow.
    private const long MaxReading = 1L << 61;

    private readonly Sample[] window = new Sample[WindowSamples];
    private readonly int readyAfter;
    private Sample best;
    private int next;

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

    /// <summary>Whether there are enough samples to set a clock by.</summary>
    public bool IsReady => SampleCount >= readyAfter;

    /// <summary>The other peer's clock minus one's own; zero without samples.</summary>
    public SimDuration Offset => best.Offset;

    /// <summary>The shortest round trip in the window, without the time spent at the other peer; zero without samples.</summary>
    public SimDuration RoundTrip => best.RoundTrip;

    /// <summary>Half the round trip, rounded up: the most that <see cref="Offset"/> was wrong by when its sample was taken.</summary>
    public SimDuration ErrorBound => (best.RoundTrip + SimDuration.OneTick) / 2;

    /// <summary>Takes in one exchange. The two own times are of one clock, the two other times of the other peer's.</summary>
    /// <param name="ownSend">t0: when the request left.</param>
    /// <param name="otherReceive">t1: when it arrived there.</param>
    /// <param name="otherSend">t2: when the answer left there.</param>
    /// <param name="ownReceive">t3: when it arrived.</param>
    /// <returns>
    /// False when the sample is impossible or absurd, and refused: a time beyond 24 days of its origin, an order that cannot be, a negative
    /// round trip, or more than <see cref="MaxExchange"/> in all. Never throws.
    /// </returns>
    public bool Add(SimTime ownSend, SimTime otherReceive, SimTime otherSend, SimTime ownReceive)
    {
        if (!IsReading(ownSend) || !IsReading(otherReceive) || !IsReading(otherSend) || !IsReading(ownReceive))
        {
            return Refuse();
        }

        SimDuration exchange = ownReceive - ownSend;
        SimDuration held = otherSend - otherReceive;
        SimDuration roundTrip = exchange - held;
        if (held < SimDuration.Zero || roundTrip < SimDuration.Zero || exchange > MaxExchange)
        {
            return Refuse();
        }

        // ((t1-t0)+(t2-t3))/2, written so that no sum of two large clock differences arises.
        Sample sample = new(otherSend - ownReceive + (roundTrip / 2), roundTrip, ownReceive);
        window[next] = sample;
        next = (next + 1) % WindowSamples;
        SampleCount += SampleCount < int.MaxValue ? 1 : 0;
        ChooseBest(ownReceive);
        return true;
    }

    private static bool IsReading(SimTime time) => time.Ticks is > -MaxReading and < MaxReading;

    private bool Refuse()
    {
        RefusedCount += RefusedCount < int.MaxValue ? 1 : 0;
        return false;
    }

    private void ChooseBest(SimTime now)
    {
        // From the oldest to the newest, so that of equals the newest counts.
        int samples = Math.Min(SampleCount, WindowSamples);
        int oldest = next + WindowSamples - samples;
        best = window[oldest % WindowSamples];
        for (int i = 1; i < samples; i++)
        {
            Sample sample = window[(oldest + i) % WindowSamples];
            best = sample.BoundAt(now) <= best.BoundAt(now) ? sample : best;
        }
    }

    private readonly struct Sample
    {
        public Sample(SimDuration offset, SimDuration roundTrip, SimTime taken)
        {
            Offset = offset;
            RoundTrip = roundTrip;
            Taken = taken;
        }

        public SimDuration Offset { get; }

        public SimDuration RoundTrip { get; }

        private SimTime Taken { get; }

        /// <summary>How wrong the offset may be by now.</summary>
        public SimDuration BoundAt(SimTime now) => (RoundTrip / 2) + ((now - Taken) / DriftShare);
    }
}
