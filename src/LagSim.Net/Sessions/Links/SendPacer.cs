using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>When the next update of a link is due: what is hurried keeps a distance from the one before, in the mean.</summary>
internal sealed class SendPacer
{
    /// <summary>Who writes more often is not answered more often than this, in the mean.</summary>
    internal static readonly SimDuration LeastDistance = SimDuration.FromMilliseconds(1);

    /// <summary>
    /// By so many of its distances may what is flushed be ahead: after a pause three go out at once. What one player does then does not
    /// wait because an answer to what
    /// another did has just gone.
    /// </summary>
    private const int MostAhead = 2;

    private SimTime paced = SimTime.MinValue; // when the next update would be due if all kept their distance
    private SimDuration distance = LeastDistance; // of the last
    private SimTime latest = SimTime.MinValue; // when the last update was sent
    private int atOnce; // how many were sent then

    internal SendPacer(SimTime now) => Due = now;

    /// <summary>When the next update is due, by the own clock.</summary>
    internal SimTime Due { get; private set; }

    /// <summary>
    /// Has the next update sent no later than this, unless so many went out just now that the least distance would not be kept in the mean.
    /// </summary>
    internal void Flush(SimTime by) =>
        Due = SimTime.Min(Due, SimTime.Max(by, paced == SimTime.MinValue ? by : paced - (distance * MostAhead)));

    /// <summary>Notes that an update was sent; the next is due after a rest.</summary>
    /// <param name="now">When it was sent.</param>
    /// <param name="apart">How far from the next one it is to be in the mean.</param>
    internal void NoteSent(SimTime now, SimDuration apart)
    {
        distance = apart;
        // Those of one moment count as one, where there is room.
        paced = now == latest && apart == LeastDistance ? paced : SimTime.Max(paced, now) + apart;
        atOnce = now == latest ? atOnce + 1 : 1;
        latest = now;
    }

    /// <summary>There is nothing more to say: the next update is due after a rest.</summary>
    internal void Rest(SimTime now, SimDuration rest) => Due = now + (rest > LeastDistance ? rest : LeastDistance);

    /// <summary>There is more to say: the next update is due as soon as its distance lets.</summary>
    internal void GoOn(SimTime now) => Due = distance > LeastDistance ? SimTime.Max(now, paced - (distance * MostAhead))
        : atOnce < SendWindow.MaxDatagramsAtOnce ? now
        : now + LeastDistance;
}
