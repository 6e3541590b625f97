using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Decides when the next update of a link is due; flushed updates keep an average distance.</summary>
internal sealed class SendPacer
{
    /// <summary>The least average distance between full updates, however often the other end sends.</summary>
    internal static readonly SimDuration MinDistance = SimDuration.FromMilliseconds(1);

    /// <summary>
    /// The least average distance between updates that are not full: what comes up meanwhile travels together. A display shows no more
    /// often what is new, and half of it is what an event waits at most in the median.
    /// </summary>
    internal static readonly SimDuration Together = SimDuration.FromSeconds(1 / 60.0);

    /// <summary>
    /// How many distances flushed updates may be ahead: after a pause three go out at once, so that one player's event need not wait
    /// because another's was just acknowledged.
    /// </summary>
    private const int MaxAhead = 2;

    private SimTime paced = SimTime.MinValue; // when the next update would be due if all kept their distance
    private SimDuration distance = MinDistance; // of the last update
    private SimTime latest = SimTime.MinValue; // when the last update was sent
    private int atOnce; // how many were sent at that time

    private readonly double bytesPerSecond;

    /// <param name="now">The time by the local clock.</param>
    /// <param name="bytesPerSecond">The most bytes a second that go, UDP and IP headers included, in the mean.</param>
    internal SendPacer(SimTime now, double bytesPerSecond = double.PositiveInfinity)
    {
        Due = now;
        this.bytesPerSecond = bytesPerSecond;
    }

    /// <summary>Whether more is asked for than may go: then nothing goes twice that need not.</summary>
    internal bool IsPressed(SimTime now) => !double.IsPositiveInfinity(bytesPerSecond) && paced > now + Together;

    /// <summary>When the next update is due, by the local clock.</summary>
    internal SimTime Due { get; private set; }

    /// <summary>
    /// Sends the next update no later than this, unless so many went out just now that the average distance would fall below the least.
    /// </summary>
    internal void Flush(SimTime by) =>
        Due = SimTime.Min(Due, SimTime.Max(by, paced == SimTime.MinValue ? by : paced - (distance * MaxAhead)));

    /// <summary>Records that an update was sent; the next is due after a rest.</summary>
    /// <param name="now">When it was sent.</param>
    /// <param name="apart">The average distance to the next one.</param>
    /// <param name="bytes">Its length, UDP and IP headers included.</param>
    internal void NoteSent(SimTime now, SimDuration apart, int bytes = 0)
    {
        SimDuration allowed = SimDuration.FromSeconds(bytes / bytesPerSecond);
        apart = apart > allowed ? apart : allowed;
        distance = apart;
        // Updates of one instant count as one, where there is room.
        paced = now == latest && apart == MinDistance ? paced : SimTime.Max(paced, now) + apart;
        atOnce = now == latest ? atOnce + 1 : 1;
        latest = now;
    }

    /// <summary>Called when nothing is left to send: the next update is due after a rest.</summary>
    internal void Rest(SimTime now, SimDuration rest) => Due = now + (rest > MinDistance ? rest : MinDistance);

    /// <summary>Called when more is to be sent: the next update is due as soon as its distance allows.</summary>
    internal void GoOn(SimTime now) => Due = distance > MinDistance ? SimTime.Max(now, paced - (distance * MaxAhead))
        : atOnce < SendWindow.MaxDatagramsAtOnce ? now
        : now + MinDistance;
}
