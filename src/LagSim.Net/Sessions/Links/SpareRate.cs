using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// Limits what a link carries beyond what it has to: repetitions before a loss is known, and small datagrams that could have waited for
/// more.
/// </summary>
/// <remarks>
/// It is a token bucket of one datagram. Its rate grows by 8 % per tenth of a second, or per round trip, while it is used up and no
/// queue shows; it is cut to 0.7 when a queue shows, and during that only the least rate flows in. So the links of several sessions find
/// their shares, and optional traffic keeps no queue standing. When answers stop, the rate stays for a while, since a link that loses many
/// datagrams in a row is lost for longer the fewer are sent; then it is halved step by step.
/// </remarks>
internal class SpareRate
{
    private const int Full = CongestionControl.FullDatagramBytes;
    private const double CutTo = 0.7;
    private const double Growth = 1.08;

    /// <summary>The highest rate, in bytes per second: a full datagram per default resend interval.</summary>
    private const double Most = Full / 0.03;

    /// <summary>
    /// The rate of a new link, in bytes per second: a small update per resend interval, with room for a few repeated entries. It is also
    /// the least rate while answers are overdue and no queue showed, and an idle link returns to it.
    /// </summary>
    private const double First = 12_000;

    /// <summary>
    /// The lowest rate: jitter may be taken for a queue, and a link that loses many datagrams in a row then still needs a repetition now
    /// and then.
    /// </summary>
    private const double Least = 400;

    /// <summary>How often the rate is adjusted, or per round trip if that is longer: a queue comes and goes in that time.</summary>
    private static readonly SimDuration LookInterval = SimDuration.FromMilliseconds(100);

    private double rate = First;
    private double filling = First; // the rate for what is known now: the rate itself, or less
    private double tokens = Full;
    private bool isUsedUp; // since the last adjustment
    private SimTime counted = SimTime.MinValue;
    private SimTime looked = SimTime.MinValue;

    /// <summary>How many bytes may be sent, as of the last <see cref="Advance"/>.</summary>
    internal int Bytes => (int)tokens;

    /// <summary>Advances to a time.</summary>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="trips">The link's round trips.</param>
    /// <param name="isSilent">Whether answers are overdue.</param>
    /// <param name="halvings">How often the rate is halved meanwhile, since the other end may be gone.</param>
    internal void Advance(SimTime now, RoundTrips trips, bool isSilent, int halvings = 0)
    {
        if (counted == SimTime.MinValue)
        {
            counted = looked = now;
        }

        SimDuration interval = trips.Mean > LookInterval ? trips.Mean : LookInterval;
        if (now - looked >= interval)
        {
            rate = isSilent || !trips.IsMeasured ? rate // nothing new is known
                : HasQueue(trips) ? Math.Max(Least, rate * CutTo)
                : isUsedUp ? Math.Min(Most, rate * Growth)
                : Math.Max(rate, Math.Min(First, rate * Math.Pow(Growth, (now - looked).ToSeconds() / interval.ToSeconds())));
            looked = now;
            isUsedUp = false;
        }

        tokens = Math.Min(Full, tokens + ((now - counted).ToSeconds() * filling));
        filling = HasQueue(trips) ? Least : isSilent ? Math.Max(rate, First) / (1 << halvings) : rate;
        counted = now;
    }

    /// <summary>How long until that many bytes may be sent; if that is not now, the rate counts as used up, and so may grow.</summary>
    internal SimDuration WaitFor(int bytes)
    {
        double missing = Math.Min(bytes, Full) - tokens;
        isUsedUp |= missing > 0;
        return SimDuration.FromSeconds(Math.Max(0, missing / filling));
    }

    /// <summary>Spends bytes.</summary>
    internal void Spend(int bytes) => tokens = Math.Max(-Full, tokens - bytes);

    /// <summary>Called when the window was cut: optional traffic is cut first.</summary>
    internal virtual void Cut() => rate = Math.Max(Least, rate * CutTo);

    /// <summary>Whether there is a queue on the path, which is a reason to repeat less.</summary>
    internal virtual bool HasQueue(RoundTrips trips) => trips.HasQueue;
}
