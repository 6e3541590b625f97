using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>One direction of a link in operation: decides for each datagram whether and when it arrives.</summary>
/// <remarks>
/// <para>The leg's <see cref="Bottleneck"/>, if there is one, comes first: a datagram may be dropped in its queue, and waits there.
/// Everything else applies from when it leaves, as if it were sent then. A drop-tail queue decides that time at once, a CoDel queue only
/// later (<see cref="DecidesAtOnce"/>).</para>
/// <para>Delay: normal about the leg's mean, but never negative; or with a <see cref="LongTail"/>. Loss: the two states of Gilbert and
/// Elliott, one that loses everything and one that loses nothing, stepped once per datagram; bursts are geometric with the leg's
/// mean.</para>
/// <para>Periodic effects, a <see cref="DelayStep"/> or a <see cref="PeriodicOutage"/>, depend on that time alone, whatever is sent. Where
/// a period begins, and which periods have an outage, is drawn per path and shared by both directions; periods of equal length begin
/// together.</para>
/// <para>Order: jitter alone never reorders, since a path that is one queue does not; a datagram that would overtake another arrives with
/// it. So if datagrams are sent closer together than the jitter, the mean delay is above the leg's and its spread below. Only the leg's
/// reorder percentage is held back, by half to one and a half of its hold, and later datagrams pass it (if any are sent that soon).</para>
/// <para>Duplication: the copy has a delay of its own, never arrives before the first, and may arrive after datagrams sent later.</para>
/// <para>Deterministic: the same leg, seed and send times give the same bits. Each concern always draws from its own stream, so two runs
/// that differ in one property of the leg, or in what else is lost, get the same draws for all others. Not thread-safe.</para>
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

    /// <summary>Creates a link direction in its long-run state.</summary>
    /// <param name="leg">The properties of the direction.</param>
    /// <param name="random">Its random generator; only <see cref="SeededRandom.Fork"/> is called on it.</param>
    /// <param name="path">The random generator shared by both directions; likewise. Default: this direction's own.</param>
    /// <param name="queue">A queue shared with other directions, in place of its own. All of them must send in the order of time.</param>
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

    /// <summary>The properties of this direction.</summary>
    public LinkLeg Leg { get; }

    /// <summary>The queue that datagrams go through first; null if there is none.</summary>
    public LinkQueue? Queue { get; }

    /// <summary>
    /// Whether <see cref="Send(SimTime, int)"/> can return a datagram's fate: true for all links but those with a CoDel queue.
    /// </summary>
    public bool DecidesAtOnce => Queue is null || Queue.DecidesAtOnce;

    /// <summary>Returns when a datagram sent now arrives.</summary>
    /// <param name="at">The true time it is sent; never earlier than in the previous call.</param>
    /// <param name="bytes">Its own bytes, 1 to 65,507; with a bottleneck, <see cref="Bottleneck.OverheadBytes"/> are added.</param>
    /// <exception cref="ArgumentOutOfRangeException">
    /// <paramref name="at"/> is earlier than in the previous call, or <paramref name="bytes"/> out of range.
    /// </exception>
    /// <exception cref="InvalidOperationException"><see cref="DecidesAtOnce"/> is false.</exception>
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
    /// Sends a datagram, and reports when it arrives as soon as that is decided: before this returns, or while
    /// <see cref="LinkQueue.DecideUntil"/> of the <see cref="Queue"/> is called, or another datagram is sent through it.
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

    /// <summary>The fraction of period 0 that has elapsed at time zero, for everything periodic on a path.</summary>
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

    /// <summary>Makes every draw for every datagram, whatever its fate: see the remarks.</summary>
    private Luck Draw() => new(
        NextIsLost(),
        outageLuck.NextDouble() * 100,
        delayLuck.NextGaussian(),
        reorderLuck.NextDouble() * 100 < Leg.ReorderPercent,
        holdLuck.NextDouble(0.5, 1.5),
        duplicateLuck.NextDouble() * 100 < Leg.DuplicatePercent,
        copyLuck.NextGaussian());

    /// <summary>Decides the fate of a datagram that has passed the queue, or has none to pass.</summary>
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
            // The mark stays, so that datagrams sent later may arrive before it.
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

    /// <summary>Depends on the period alone, so that a silence or another start changes nothing for later periods.</summary>
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
            : Math.Min(LongTail.MaxMilliseconds, usual * SeededRandom.Exp(logDeviation * deviations));
        return SimDuration.FromMilliseconds(milliseconds);
    }

    /// <summary>One datagram's random draws: in the leg's states and shares, in standard deviations, in parts of the hold.</summary>
    private readonly record struct Luck(bool IsLost, double Outage, double Delay, bool IsHeldBack, double Hold, bool IsTwice, double Copy);
}
