using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>How many bytes may be on their way over one link: a window, as in TCP and QUIC (RFC 9002, section 7).</summary>
/// <remarks>
///  It doubles a round trip while no queue shows and it was never cut, else grows by a datagram a round trip, and is cut to 0.7 (CUBIC, RFC
/// 9438) of what is used, at most once a round trip, when datagrams are lost. It grows only while it is used. A loss counts as congestion
/// where there is a queue, or where a larger share is lost than by a bad radio link: drop-tail queues lose when they are full, and one that
/// was full when this link began shows by nothing else.
/// </remarks>
internal class CongestionControl
{
    /// <summary>What IPv4 and UDP add to each datagram, in bytes.</summary>
    internal const int DatagramOverhead = 28;

    /// <summary>What the largest datagram takes with that, in bytes.</summary>
    internal const int FullDatagramBytes = Carriers.IDatagramPort.MaxDatagramBytes + DatagramOverhead;

    private const int Full = FullDatagramBytes;

    /// <summary>
    ///  Above the ten datagrams of RFC 9002: an event that waits for the window to open is an event too late. This is what the most that a
    /// host takes of a client by default, 500 events a second, has on its way on the longest link that is reported on, 2 s there and back.
    /// </summary>
    private const int InitialWindow = 50 * Full;

    private const int LeastWindow = 2 * Full; // RFC 9002, 7.2

    /// <summary>
    ///  How many of the longest datagrams make a window: a loss shows by three that come after it (RFC 9002, 6.1), and two large ones a
    /// short queue drops together. Then the one of two sessions behind one link of 64 kbit/s to which this happens falls silent for
    /// seconds: in a trial with 4, 6 and 8 they shared it within a factor of two in 42, 46 and 47 of 48 runs.
    /// </summary>
    private const int DatagramsPerWindow = 8;

    private const int MostWindow = 400 * Full; // below what SentDatagrams remembers
    private const double CutTo = 0.7;

    /// <summary>
    ///  Half as much again as <c>awful</c> loses, the worst link that is reported on (WebRTC's controller bears a tenth, BBR a fiftieth).
    /// In a trial 114 of 120 pairs of sessions shared one link within a factor of two; with twice as much 106; with none 111, and
    /// <c>awful</c> carried 400 of 490 events a second.
    /// </summary>
    private const double BearableLoss = 0.15;

    private const double LossMemory = 1.0 / 128;

    private double window = InitialWindow;
    private double threshold = double.PositiveInfinity; // below it the window doubles a round trip: what it was last cut to
    private int peak; // the most that was on its way since the window was last cut: what of the window was used (RFC 7661)
    private double lossShare;
    private SimTime cut = SimTime.MinValue; // what was sent before that is not counted against the window again

    /// <summary>How many bytes are on their way: sent, and neither acknowledged nor lost.</summary>
    internal int InFlight { get; private set; }

    /// <summary>How many bytes may be.</summary>
    internal int Window => (int)window;

    /// <summary>How long a datagram may be, with what UDP and IP add.</summary>
    internal int DatagramBytes => Math.Min(Full, Window / DatagramsPerWindow);

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
            window = Math.Min(MostWindow, window + (hasQueue || window >= threshold ? (double)Full * bytes / window : bytes));
        }
    }

    /// <summary>What was sent has not come.</summary>
    /// <returns>Whether the window was cut for it.</returns>
    internal bool OnLost(int bytes, SimTime sent, SimTime now, bool hasQueue)
    {
        InFlight -= bytes;
        lossShare += (1 - lossShare) * LossMemory;
        if (!IsCutFor(sent, hasQueue))
        {
            return false;
        }

        window = threshold = Math.Max(LeastWindow, Math.Min(window, peak) * CutTo);
        peak = InFlight;
        cut = now;
        return true;
    }

    /// <summary>Nothing was answered, again and again: the link may have become another one (RFC 9002, 7.6).</summary>
    internal virtual void OnSilence(SimTime now)
    {
        window = LeastWindow;
        cut = now;
    }

    /// <summary>
    /// Whether the window is cut for a loss: one that a queue explains, or one of too many; once for all that was on its way.
    /// </summary>
    internal virtual bool IsCutFor(SimTime sent, bool hasQueue) => (hasQueue || lossShare > BearableLoss) && sent > cut;
}
