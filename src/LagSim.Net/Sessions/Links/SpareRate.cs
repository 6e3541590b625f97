using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// How much one link may carry beyond what has to go: repetitions before a loss is known, and small datagrams that could have waited for
/// more.
/// </summary>
/// <remarks>
///  A token bucket of one datagram. Its rate grows by a twelfth each tenth of a second, or round trip, while it is used up and no queue
/// shows, and is cut to 0.7 when one does; while one does only the least flows in. So the links of several sessions find their shares, and
/// what could be left out keeps no queue standing. Where nothing is answered any more it goes on at the rate it had for a while, since a
/// link that loses many datagrams in a row is lost for longer the fewer are sent; then the rate is halved step by step.
/// </remarks>
internal class SpareRate
{
    private const int Full = CongestionControl.FullDatagramBytes;
    private const double CutTo = 0.7;
    private const double Growth = 1.08;

    /// <summary>The highest rate, in bytes a second: a full datagram each resend interval, by default.</summary>
    private const double Most = Full / 0.03;

    /// <summary>
    ///  The rate of a new link, in bytes a second: a small update each resend interval, with room for a few repeated entries. No less while
    /// nothing is answered and no queue showed, and a link that is at rest comes back to it.
    /// </summary>
    private const double First = 12_000;

    /// <summary>
    /// The lowest rate: jitter may be taken for a queue, and a link that loses many datagrams in a row then still needs a repetition now
    /// and then.
    /// </summary>
    private const double Least = 400;

    /// <summary>So often the rate is looked at, or each round trip if that is longer: in so long a queue comes and goes.</summary>
    private static readonly SimDuration LookInterval = SimDuration.FromMilliseconds(100);

    private double rate = First;
    private double filling = First; // by what is known now: the rate, or less
    private double tokens = Full;
    private bool isUsedUp; // since the rate was last looked at
    private SimTime counted = SimTime.MinValue;
    private SimTime looked = SimTime.MinValue;

    /// <summary>How many bytes may go, as of the last <see cref="Advance"/>.</summary>
    internal int Bytes => (int)tokens;

    /// <summary>Goes on to a time.</summary>
    /// <param name="now">By the own clock.</param>
    /// <param name="trips">What is known of the link's round trips.</param>
    /// <param name="isSilent">Whether answers are overdue.</param>
    /// <param name="halvings">How often the rate is halved meanwhile, since nobody may be there.</param>
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

    /// <summary>How long until so many bytes may go; where that is not now, the rate counts as used up, and so may grow.</summary>
    internal SimDuration WaitFor(int bytes)
    {
        double missing = Math.Min(bytes, Full) - tokens;
        isUsedUp |= missing > 0;
        return SimDuration.FromSeconds(Math.Max(0, missing / filling));
    }

    /// <summary>Notes what went.</summary>
    internal void Spend(int bytes) => tokens = Math.Max(-Full, tokens - bytes);

    /// <summary>The window was cut: what could be left out goes first.</summary>
    internal virtual void Cut() => rate = Math.Max(Least, rate * CutTo);

    /// <summary>Whether there is a queue on the way, which is reason to repeat less.</summary>
    internal virtual bool HasQueue(RoundTrips trips) => trips.HasQueue;
}
