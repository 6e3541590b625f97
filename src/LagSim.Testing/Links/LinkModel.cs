using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>One direction of one link at work: decides for each datagram whether and when it arrives.</summary>
/// <remarks>
/// <para>First comes the leg's <see cref="Bottleneck"/>, if it has one: a datagram may be lost in its queue, and waits there. All else
/// befalls it from when it leaves, as if it were sent then. A queue of drop-tail says at once when that is; one of CoDel only later
/// (<see cref="DecidesAtOnce"/>).</para>
/// <para>Delay: normal about the leg's mean, never below 0, so never before it was sent; or with a <see cref="LongTail"/>. Loss: Gilbert
/// and Elliott's two states, one that loses everything and one that loses nothing, stepped once per datagram; bursts are geometric with the
/// leg's mean.</para>
/// <para>What comes in periods, a <see cref="DelayStep"/> or a <see cref="PeriodicOutage"/>, goes by that time alone, whatever is sent.
/// Where a period begins, and which of them have an outage, is luck of the path, which both directions share; periods of one length begin
/// together.</para>
/// <para>Order: jitter alone never reorders, since a path that is one queue does not; a datagram that would overtake another arrives with
/// it. So where datagrams are sent closer together than the jitter, the mean delay is above the leg's and its spread below. Only the share
/// that the leg says is held back, by half to one and a half of its hold, and later ones pass it (if any are sent that soon).</para>
/// <para>Duplication: the copy has a delay of its own, never arrives before the first, and may arrive after datagrams sent later.</para>
/// <para>Deterministic: the same leg, seed and send times give the same bits. Each concern draws from its own stream, always, so two runs
/// that differ in one property of the leg, or in what else is lost, see the same luck in all others. Not thread-safe.</para>
/// </remarks>
internal sealed class LinkModel
{
    private readonly SeededRandom lossLuck;
    private readonly SeededRandom delayLuck;
    private readonly SeededRandom reorderLuck;
    private readonly SeededRandom holdLuck;
    private readonly SeededRandom duplicateLuck;
    private readonly SeededRandom copyLuck;
    private readonly SeededRandom outageLuck;
    private readonly SeededRandom periodLuck;
    private readonly Cadence steps;
    private readonly Cadence outages;
    private readonly double logDeviation;
    private readonly double lossShare;
    private readonly double enterLoss;
    private readonly double leaveLoss;
    private SimTime lastSent = SimTime.MinValue;
    private SimTime lastInOrder = SimTime.MinValue;
    private bool started;
    private bool losing;
    private long periodAsked = long.MinValue;
    private bool periodHasOutage;

    /// <summary>A link direction in its long-run state.</summary>
    /// <param name="leg">What it does.</param>
    /// <param name="random">Its luck; only <see cref="SeededRandom.Fork"/> is called on it.</param>
    /// <param name="path">The luck of both directions together, equal for the two; likewise. Default: this direction's own.</param>
    /// <param name="queue">
    /// A queue that it shares with other directions, in place of one of its own. All of them must send in the order of time.
    /// </param>
    public LinkModel(LinkLeg leg, SeededRandom random, SeededRandom? path = null, LinkQueue? queue = null)
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
        outageLuck = random.Fork(7);
        path ??= random;
        periodLuck = path.Fork(8);
        double phase = Phase(path);
        Queue = queue ?? (leg.Bottleneck is Bottleneck own ? new LinkQueue(own, phase) : null);
        steps = leg.Step is DelayStep step ? new Cadence(step.Period, phase) : default;
        outages = leg.Outage is PeriodicOutage outage ? new Cadence(outage.Period, phase) : default;
        logDeviation = leg.Tail?.LogDeviation(leg.DelayMilliseconds) ?? 0;

        // In the long run enter / (enter + leave) of the datagrams are lost, in bursts of 1 / leave.
        bool always = leg.LossPercent >= 100;
        lossShare = leg.LossPercent / 100;
        leaveLoss = always ? 0 : 1 / leg.MeanBurstLength;
        enterLoss = always ? 1 : leaveLoss * lossShare / (1 - lossShare);
    }

    /// <summary>What this direction does.</summary>
    public LinkLeg Leg { get; }

    /// <summary>The queue that datagrams go through first; null if there is none.</summary>
    public LinkQueue? Queue { get; }

    /// <summary>
    /// Whether <see cref="Send(SimTime, int)"/> can say what becomes of a datagram: all links but those with a queue of CoDel.
    /// </summary>
    public bool DecidesAtOnce => Queue is null || Queue.DecidesAtOnce;

    /// <summary>When the datagram that is sent now arrives.</summary>
    /// <param name="at">The true time it is sent; never earlier than that of the call before.</param>
    /// <param name="bytes">
    /// Its own bytes, 1 to 65,507; <see cref="Bottleneck.OverheadBytes"/> come on top where there is a bottleneck.
    /// </param>
    /// <exception cref="ArgumentOutOfRangeException">
    /// <paramref name="at"/> is earlier than that of the call before, or <paramref name="bytes"/> out of range.
    /// </exception>
    /// <exception cref="InvalidOperationException">Not <see cref="DecidesAtOnce"/>.</exception>
    public LinkDeliveries Send(SimTime at, int bytes)
    {
        if (!DecidesAtOnce)
        {
            throw new InvalidOperationException("What a queue of CoDel does with a datagram is not known when it is sent; give an action that is told when it is.");
        }

        Begin(at, bytes);
        Luck luck = Draw();
        return Queue is null ? Arrive(at, luck) : Queue.TryPass(at, bytes, out SimTime leaves) ? Arrive(leaves, luck) : default;
    }

    /// <summary>
    /// Sends a datagram, and tells when it arrives as soon as that is decided: before this returns, or while
    /// <see cref="LinkQueue.DecideUntil"/> of the <see cref="Queue"/> is called, or another datagram sent through it.
    /// </summary>
    /// <param name="at">As for <see cref="Send(SimTime, int)"/>.</param>
    /// <param name="bytes">Likewise.</param>
    /// <param name="decided">Called once, in the order of sending. It must not send.</param>
    /// <exception cref="ArgumentOutOfRangeException">As for <see cref="Send(SimTime, int)"/>.</exception>
    public void Send(SimTime at, int bytes, Action<LinkDeliveries> decided)
    {
        ArgumentNullException.ThrowIfNull(decided);
        if (DecidesAtOnce)
        {
            decided(Send(at, bytes));
            return;
        }

        Begin(at, bytes);
        Luck luck = Draw();
        Queue!.Pass(at, bytes, leaves => decided(leaves is SimTime then ? Arrive(then, luck) : default));
    }

    /// <summary>How much of period 0 has gone by at time zero, of everything periodic on a path.</summary>
    internal static double Phase(SeededRandom path) => path.Fork(9).NextDouble();

    private void Begin(SimTime at, int bytes)
    {
        if (at < lastSent)
        {
            throw new ArgumentOutOfRangeException(nameof(at), at.ToShortString(), $"A datagram was already sent at {lastSent.ToShortString()}; time only"
                + " goes forward.");
        }

        if (bytes is < 1 or > LinkQueue.MaxBytes)
        {
            throw new ArgumentOutOfRangeException(nameof(bytes), bytes, $"A datagram has 1 to {LinkQueue.MaxBytes} bytes.");
        }

        lastSent = at;
    }

    /// <summary>Every draw is made for every datagram, whatever becomes of it: see the remarks.</summary>
    private Luck Draw() => new(
        NextIsLost(),
        outageLuck.NextDouble() * 100,
        delayLuck.NextGaussian(),
        reorderLuck.NextDouble() * 100 < Leg.ReorderPercent,
        holdLuck.NextDouble(0.5, 1.5),
        duplicateLuck.NextDouble() * 100 < Leg.DuplicatePercent,
        copyLuck.NextGaussian());

    /// <summary>What becomes of a datagram that is past the queue, or has none to pass.</summary>
    private LinkDeliveries Arrive(SimTime at, in Luck luck)
    {
        if (luck.IsLost | IsInOutage(at, luck.Outage))
        {
            return default;
        }

        double usual = UsualDelay(at);
        SimTime arrival = SimTime.Max(at + Delay(usual, luck.Delay), lastInOrder);
        if (luck.IsHeldBack)
        {
            // And the mark stays, so that those sent later may arrive before it.
            arrival += SimDuration.FromMilliseconds(luck.Hold * Leg.ReorderHoldMilliseconds);
        }
        else
        {
            lastInOrder = arrival;
        }

        return luck.IsTwice ? new LinkDeliveries(arrival, SimTime.Max(arrival, at + Delay(usual, luck.Copy))) : new LinkDeliveries(arrival);
    }

    private bool NextIsLost()
    {
        double luck = lossLuck.NextDouble();
        losing = !started ? luck < lossShare : losing ? luck >= leaveLoss : luck < enterLoss;
        started = true;
        return losing;
    }

    private bool IsInOutage(SimTime at, double luck)
    {
        if (Leg.Outage is not PeriodicOutage outage)
        {
            return false;
        }

        long period = outages.At(at, out SimDuration into);
        return into < outage.Length && luck < outage.LossPercent && HasOutage(outage, period);
    }

    /// <summary>Of each period by itself, so that silence, or another start, changes nothing for those that follow.</summary>
    private bool HasOutage(PeriodicOutage outage, long period)
    {
        if (period != periodAsked)
        {
            periodAsked = period;
            periodHasOutage = periodLuck.Fork((ulong)period).NextDouble() * 100 < outage.PeriodPercent;
        }

        return periodHasOutage;
    }

    private double UsualDelay(SimTime at)
    {
        if (Leg.Step is not DelayStep step)
        {
            return Leg.DelayMilliseconds;
        }

        bool isUp = (steps.At(at, out _) & 1) != 0;
        return Leg.DelayMilliseconds + (isUp ? step.Milliseconds / 2 : -step.Milliseconds / 2);
    }

    private SimDuration Delay(double usual, double deviations)
    {
        double milliseconds = Leg.Tail is null
            ? Math.Max(0, usual + (Leg.JitterMilliseconds * deviations))
            : Math.Min(LongTail.MostMilliseconds, usual * SeededRandom.Exp(logDeviation * deviations));
        return SimDuration.FromMilliseconds(milliseconds);
    }

    /// <summary>One datagram's luck: in the leg's states and shares, in standard deviations, in parts of the hold.</summary>
    private readonly record struct Luck(bool IsLost, double Outage, double Delay, bool IsHeldBack, double Hold, bool IsTwice, double Copy);
}
