using System;
using LagSim.Time;

namespace LagSim.Harness.Links;

/// <summary>One direction of one link at work: decides for each datagram whether and when it arrives.</summary>
/// <remarks>
/// <para>Delay: normal about the leg's mean, never below 0, so never before it was sent. Loss: Gilbert and Elliott's two states, one that
/// loses everything and one that loses nothing, stepped once per datagram; bursts are geometric with the leg's mean.</para>
/// <para>Order: jitter alone never reorders, since a path that is one queue does not; a datagram that would overtake another arrives with
/// it. So where datagrams are sent closer together than the jitter, the mean delay is above the leg's and its spread below.
/// Only the share that the leg says is held back, by half to one and a half of its hold, and later ones pass it (if any are sent that soon).</para>
/// <para>Duplication: the copy has a delay of its own, never arrives before the first, and may arrive after datagrams sent later.</para>
/// <para>Deterministic: the same leg, seed and send times give the same bits. Each concern draws from its own stream, always, so two runs
/// that differ in one property of the leg, or in what else is lost, see the same luck in all others. Not thread-safe.</para>
/// </remarks>
public sealed class LinkModel
{
    private readonly SeededRandom lossLuck;
    private readonly SeededRandom delayLuck;
    private readonly SeededRandom reorderLuck;
    private readonly SeededRandom holdLuck;
    private readonly SeededRandom duplicateLuck;
    private readonly SeededRandom copyLuck;
    private readonly double lossShare;
    private readonly double enterLoss;
    private readonly double leaveLoss;
    private SimTime lastSent = SimTime.MinValue;
    private SimTime lastInOrder = SimTime.MinValue;
    private bool started;
    private bool losing;

    /// <summary>A link direction in its long-run state.</summary>
    /// <param name="leg">What it does.</param>
    /// <param name="random">Its luck; only <see cref="SeededRandom.Fork"/> is called on it.</param>
    public LinkModel(LinkLeg leg, SeededRandom random)
    {
        ArgumentNullException.ThrowIfNull(leg);
        ArgumentNullException.ThrowIfNull(random);
        Leg = leg;
        lossLuck = random.Fork(1);
        delayLuck = random.Fork(2);
        reorderLuck = random.Fork(3);
        holdLuck = random.Fork(4);
        duplicateLuck = random.Fork(5);
        copyLuck = random.Fork(6);

        // In the long run enter / (enter + leave) of the datagrams are lost, in bursts of 1 / leave.
        bool always = leg.LossPercent >= 100;
        lossShare = leg.LossPercent / 100;
        leaveLoss = always ? 0 : 1 / leg.MeanBurstLength;
        enterLoss = always ? 1 : leaveLoss * lossShare / (1 - lossShare);
    }

    /// <summary>What this direction does.</summary>
    public LinkLeg Leg { get; }

    /// <summary>When the datagram that is sent now arrives.</summary>
    /// <param name="at">The true time it is sent; never earlier than that of the call before.</param>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="at"/> is earlier than that of the call before.</exception>
    public LinkDeliveries Send(SimTime at)
    {
        if (at < lastSent)
        {
            throw new ArgumentOutOfRangeException(nameof(at), at, $"A datagram was already sent at {lastSent}; time only goes forward.");
        }

        lastSent = at;

        // Every draw is made for every datagram, whatever becomes of it: see the remarks.
        bool lost = NextIsLost();
        SimTime arrival = at + NextDelay(delayLuck);
        bool heldBack = reorderLuck.NextDouble() * 100 < Leg.ReorderPercent;
        SimDuration hold = SimDuration.FromMilliseconds(holdLuck.NextDouble(0.5, 1.5) * Leg.ReorderHoldMilliseconds);
        bool twice = duplicateLuck.NextDouble() * 100 < Leg.DuplicatePercent;
        SimTime copy = at + NextDelay(copyLuck);
        if (lost)
        {
            return default;
        }

        arrival = SimTime.Max(arrival, lastInOrder);
        if (heldBack)
        {
            arrival += hold; // and the mark stays, so that those sent later may arrive before it
        }
        else
        {
            lastInOrder = arrival;
        }

        return twice ? new LinkDeliveries(arrival, SimTime.Max(arrival, copy)) : new LinkDeliveries(arrival);
    }

    private bool NextIsLost()
    {
        double luck = lossLuck.NextDouble();
        losing = !started ? luck < lossShare : losing ? luck >= leaveLoss : luck < enterLoss;
        started = true;
        return losing;
    }

    private SimDuration NextDelay(SeededRandom luck) =>
        SimDuration.FromMilliseconds(Math.Max(0, Leg.DelayMilliseconds + (Leg.JitterMilliseconds * luck.NextGaussian())));
}
