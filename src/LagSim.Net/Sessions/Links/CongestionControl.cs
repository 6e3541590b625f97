using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Limits the bytes in flight over one link: a congestion window, as in TCP and QUIC (RFC 9002, section 7).</summary>
/// <remarks>
/// The window doubles per round trip while no queue shows and it was never cut; otherwise it grows by a datagram per round trip. On loss it
/// is cut to 0.7 (CUBIC, RFC 9438) of what is used, at most once per round trip. It grows only while it is used. A loss counts as
/// congestion if there is a queue, or if a larger share is lost than by a bad radio link: drop-tail queues lose when they are full, and one
/// that was full when this link began shows by nothing else.
/// </remarks>
internal class CongestionControl
{
    /// <summary>The bytes that IPv4 and UDP headers add to each datagram.</summary>
    internal const int DatagramOverhead = 28;

    /// <summary>The size of the largest datagram including those, in bytes.</summary>
    internal const int FullDatagramBytes = Carriers.IDatagramPort.MaxDatagramBytes + DatagramOverhead;

    private const int Full = FullDatagramBytes;

    /// <summary>
    /// The initial window: the default maximum of a client, 500 events per second, in flight on the longest link that is reported on, a 2 s
    /// round trip. It is above the ten datagrams of RFC 9002, because an event that waits for the window to open is late.
    /// </summary>
    private const int InitialWindow = 50 * Full;

    private const int MinWindow = 2 * Full; // RFC 9002, 7.2

    /// <summary>
    /// The number of full-sized datagrams in a window: a loss shows by three later arrivals (RFC 9002, 6.1), and a short queue drops two
    /// large datagrams together.
    /// </summary>
    /// <remarks>
    /// When that happens to one of two sessions behind one link of 64 kbit/s, it falls silent for seconds: in a trial with 4, 6 and 8 they
    /// shared it within a factor of two in 42, 46 and 47 of 48 runs.
    /// </remarks>
    private const int DatagramsPerWindow = 8;

    private const int MaxWindow = 400 * Full; // below what SentDatagrams remembers
    private const double CutTo = 0.7;

    /// <summary>
    /// The share of losses that does not count as congestion: half as much again as <c>awful</c> loses, the worst link that is reported on
    /// (WebRTC's controller bears a tenth, BBR a fiftieth).
    /// </summary>
    /// <remarks>
    /// In a trial 114 of 120 pairs of sessions shared one link within a factor of two; with twice as much 106; with none 111, and
    /// <c>awful</c> carried 400 of 490 events per second.
    /// </remarks>
    private const double BearableLoss = 0.15;

    private const double LossMemory = 1.0 / 128;

    private double window = InitialWindow;
    private double threshold = double.PositiveInfinity; // below it the window doubles per round trip; its last cut size
    private int peak; // the most in flight since the last cut: the used part of the window (RFC 7661)
    private double lossShare;
    private SimTime cut = SimTime.MinValue; // losses of datagrams sent before it do not cut the window again

    /// <summary>The bytes in flight: sent, and neither acknowledged nor lost.</summary>
    internal int InFlight { get; private set; }

    /// <summary>The most bytes that may be in flight.</summary>
    internal int Window => (int)window;

    /// <summary>The longest datagram to send, UDP and IP headers included.</summary>
    internal int DatagramBytes => Math.Min(Full, Window / DatagramsPerWindow);

    /// <summary>Whether another datagram may be sent.</summary>
    internal bool HasRoom => InFlight + Full <= window || InFlight == 0;

    /// <summary>Whether half of the window is used.</summary>
    internal bool IsHalfFull => 2 * InFlight > window;

    internal void OnSent(int bytes)
    {
        InFlight += bytes;
        peak = Math.Max(peak, InFlight);
    }

    /// <summary>Called when bytes were acknowledged.</summary>
    internal void OnAcknowledged(int bytes, bool hasQueue)
    {
        bool isUsed = 2 * InFlight >= window; // before these left
        InFlight -= bytes;
        lossShare -= lossShare * LossMemory;
        if (isUsed)
        {
            window = Math.Min(MaxWindow, window + (hasQueue || window >= threshold ? (double)Full * bytes / window : bytes));
        }
    }

    /// <summary>Called when bytes were lost.</summary>
    /// <returns>Whether the window was cut for it.</returns>
    internal bool OnLost(int bytes, SimTime sent, SimTime now, bool hasQueue)
    {
        InFlight -= bytes;
        lossShare += (1 - lossShare) * LossMemory;
        if (!IsCutFor(sent, hasQueue))
        {
            return false;
        }

        window = threshold = Math.Max(MinWindow, Math.Min(window, peak) * CutTo);
        peak = InFlight;
        cut = now;
        return true;
    }

    /// <summary>Called when answers are overdue again and again: the link may be a different one (RFC 9002, 7.6).</summary>
    internal virtual void OnSilence(SimTime now)
    {
        window = MinWindow;
        cut = now;
    }

    /// <summary>
    /// Whether to cut the window for a loss: one explained by a queue, or one of too many; once for everything in flight.
    /// </summary>
    internal virtual bool IsCutFor(SimTime sent, bool hasQueue) => (hasQueue || lossShare > BearableLoss) && sent > cut;
}
