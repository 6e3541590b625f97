using System;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>How much may be on its way over one link, and how much beyond what has to be.</summary>
/// <remarks>
/// <para>What has to go goes under a window of bytes, as in TCP and QUIC (RFC 9002, section 7): it doubles a round trip while no queue shows, else grows by a
/// datagram a round trip, and is cut to 0.7 (CUBIC, RFC 9438) of what is used, at most once a round trip, when datagrams are lost. It grows only while it is used. A loss counts
/// as congestion where there is a queue, or where more than half is lost: drop-tail queues lose when they are full, and a bad radio link must not be taken
/// for a full one (WebRTC's controller bears up to a tenth, BBR a fiftieth; <c>awful</c> loses a tenth, in bursts).</para>
/// <para>What could be left out is comfort: to repeat what is on its way, and to send at once what could wait for more. It has a rate of its own, which grows
/// while it is used up and no queue shows, by a twelfth each tenth of a second or round trip, and is cut to 0.7 when one does. So the links of several sessions find their
/// shares, and what a link adds for its own comfort keeps no queue standing. Where nothing is answered any more it goes on at the rate it had: a link that loses
/// many datagrams in a row is lost for longer the fewer are sent.</para>
/// </remarks>
internal sealed class CongestionControl
{
    /// <summary>What IPv4 and UDP add to each datagram, in bytes.</summary>
    internal const int DatagramOverhead = 28;

    private const int Full = Carriers.IDatagramPort.MaxDatagramBytes + DatagramOverhead;

    /// <summary>
    /// Above the ten datagrams of RFC 9002: an event that waits for the window to open is an event too late. This is what the most that a host takes of a joiner by
    /// default, 500 events a second, has on its way on the longest link that is reported on, 2 s there and back.
    /// </summary>
    private const int InitialWindow = 50 * Full;

    private const int LeastWindow = 2 * Full; // RFC 9002, 7.2
    private const int MostWindow = 400 * Full; // below what SentDatagrams remembers
    private const double CutTo = 0.7;
    private const double BearableLoss = 0.5;
    private const double LossMemory = 1.0 / 128;

    /// <summary>The most comfort, in bytes a second: a full datagram each resend interval, by default.</summary>
    private const double MostComfort = Full / 0.03;

    /// <summary>The comfort of a new link: a small update each resend interval, with room for a few repeated entries. No less while nothing is answered: that is no sign of a queue.</summary>
    private const double FirstComfort = 12_000;

    private const double LeastComfort = 1_000;
    private const double Growth = 1.08;

    private readonly bool neverBacksOff;
    private double window = InitialWindow;
    private int peak; // the most that was on its way since the window was last cut: what of the window was used (RFC 7661)
    private double lossShare;
    private double comfort = FirstComfort; // bytes a second
    private bool isUsedUp; // since the rate was last looked at
    private double allowance = Full;
    private SimTime counted = SimTime.MinValue;
    private SimTime adjusted = SimTime.MinValue; // when the rate was last looked at
    private SimTime cut = SimTime.MinValue; // what was sent before that is not counted against the window again

    /// <param name="fault">What is done wrong on purpose.</param>
    internal CongestionControl(SessionFault fault = SessionFault.None) => neverBacksOff = (fault & SessionFault.NeverBacksOff) != 0;

    /// <summary>How many bytes are on their way: sent, and neither acknowledged nor lost.</summary>
    internal int InFlight { get; private set; }

    /// <summary>How many bytes may be.</summary>
    internal int Window => (int)window;

    /// <summary>Whether another datagram may go.</summary>
    internal bool HasRoom => InFlight + Full <= window || InFlight == 0;

    /// <summary>Whether half of the window is used.</summary>
    internal bool IsHalfFull => 2 * InFlight > window;

    internal void OnSent(int bytes)
    {
        InFlight += bytes;
        peak = Math.Max(peak, InFlight);
    }

    /// <summary>What was sent has come.</summary>
    internal void OnAcknowledged(int bytes, bool hasQueue)
    {
        bool isUsed = 2 * InFlight >= window; // before this one left
        InFlight -= bytes;
        lossShare -= lossShare * LossMemory;
        if (isUsed)
        {
            window = Math.Min(MostWindow, window + (hasQueue ? (double)Full * bytes / window : bytes));
        }
    }

    /// <summary>What was sent has not come.</summary>
    internal void OnLost(int bytes, SimTime sent, SimTime now, bool hasQueue)
    {
        InFlight -= bytes;
        lossShare += (1 - lossShare) * LossMemory;
        if ((hasQueue || lossShare > BearableLoss) && sent > cut && !neverBacksOff)
        {
            window = Math.Max(LeastWindow, Math.Min(window, peak) * CutTo);
            peak = InFlight;
            comfort = Math.Max(LeastComfort, comfort * CutTo);
            cut = now;
        }
    }

    /// <summary>Nothing was answered, again and again: the link may have become another one (RFC 9002, 7.6).</summary>
    internal void OnSilence(SimTime now)
    {
        window = neverBacksOff ? window : LeastWindow;
        cut = now;
    }

    /// <summary>How many bytes of comfort may go now.</summary>
    /// <param name="now">By the own clock.</param>
    /// <param name="trips">What is known of the link's round trips.</param>
    /// <param name="isSilent">Whether answers are overdue.</param>
    internal int ComfortAt(SimTime now, RoundTrips trips, bool isSilent)
    {
        if (counted == SimTime.MinValue)
        {
            counted = adjusted = now;
        }

        SimDuration interval = trips.Mean > LookInterval ? trips.Mean : LookInterval;
        if (now - adjusted >= interval)
        {
            comfort = isSilent || !trips.IsMeasured ? comfort // nothing new is known
                : trips.HasQueue && !neverBacksOff ? Math.Max(LeastComfort, comfort * CutTo)
                : isUsedUp ? Math.Min(MostComfort, comfort * Growth)
                : Math.Max(comfort, Math.Min(FirstComfort, comfort * Math.Pow(Growth, (now - adjusted).ToSeconds() / interval.ToSeconds()))); // as a new link again
            adjusted = now;
            isUsedUp = false;
        }

        double rate = isSilent && !trips.HasQueue ? Math.Max(comfort, FirstComfort) : comfort;
        allowance = Math.Min(Full, allowance + ((now - counted).ToSeconds() * rate));
        counted = now;
        return (int)allowance;
    }

    /// <summary>How long until so many bytes of comfort may go, if no queue shows; as of the last time that was asked how many may.</summary>
    internal SimDuration UntilComfort(int bytes)
    {
        double missing = Math.Min(bytes, Full) - allowance;
        isUsedUp |= missing > 0;
        return SimDuration.FromSeconds(Math.Max(0, missing / comfort));
    }

    /// <summary>Notes comfort that went.</summary>
    internal void Spend(int bytes) => allowance = Math.Max(-Full, allowance - bytes);

    /// <summary>So often the rate of comfort is looked at, or each round trip if that is longer: a tenth of a second, in which a queue comes and goes.</summary>
    private static readonly SimDuration LookInterval = SimDuration.FromMilliseconds(100);
}
