using System;
using LagSim.Time;

namespace LagSim.Net.Clocks;

/// <summary>
/// The session's time, derived from the local clock: set at the start of a world, and from then on slewed gently towards each newer
/// estimate.
/// </summary>
/// <remarks>
/// <para>During a world it never steps and never goes back, as long as the local clock does not. When a session continues from a fresh
/// snapshot (<see cref="Sessions.Session.Renewed"/>), it steps once, forwards or back, to the host's time. It runs with the drift of the
/// newest estimate, so that it stays right between two of them; on top of that at most 0.5 % fast or slow, or 5 % while it is more than
/// <see cref="FastAbove"/> off.</para>
/// <para>How it runs does not depend on how often it is read, except for one tick per reading. Integers only; may be used from any
/// thread.</para>
/// </remarks>
public sealed class SharedClock : IClock
{
    /// <summary>The error above which the clock is slewed by 5 % rather than 0.5 %.</summary>
    public static readonly SimDuration FastAbove = SimDuration.FromMilliseconds(10);

    private const long SlowShare = 200; // 0.5 %
    private const long FastShare = 20; // 5 %
    private const long MaxOffset = 1L << 62; // so that the difference of two offsets cannot overflow

    private readonly object gate = new();
    private readonly IClock own;
    private ClockEstimate target;
    private SimTime read; // local clock, when the remainder was last updated
    private SimDuration remaining; // target minus offset
    private bool set;
    private bool restarts; // the next estimate is applied at once

    /// <summary>Creates a clock that is not set yet.</summary>
    /// <param name="own">This machine's clock, which is never adjusted.</param>
    /// <exception cref="ArgumentNullException"><paramref name="own"/> is null.</exception>
    internal SharedClock(IClock own) => this.own = own ?? throw new ArgumentNullException(nameof(own));

    /// <summary>Whether there is a shared time to read.</summary>
    public bool IsSet
    {
        get
        {
            lock (gate)
            {
                return set;
            }
        }
    }

    /// <summary>The shared time now.</summary>
    /// <exception cref="InvalidOperationException">The clock was never set.</exception>
    public SimTime Now
    {
        get
        {
            lock (gate)
            {
                if (!set)
                {
                    throw new InvalidOperationException("There is no shared time yet: the clock was never set.");
                }

                Advance();
                return read + CurrentOffset;
            }
        }
    }

    /// <summary>Shared time minus local time, as of the last reading or adjustment; zero before the clock is set.</summary>
    public SimDuration Offset
    {
        get
        {
            lock (gate)
            {
                return set ? CurrentOffset : SimDuration.Zero;
            }
        }
    }

    /// <summary>
    /// The part of the newest estimate still to be slewed, as of the last reading or adjustment; positive if the clock is behind.
    /// </summary>
    public SimDuration Remaining
    {
        get
        {
            lock (gate)
            {
                return remaining;
            }
        }
    }

    private SimDuration CurrentOffset => target.OffsetAt(read) - remaining;

    /// <summary>
    /// Gives the clock the newest estimate. The first sets it at once, as does the first after <see cref="Restart"/>; later ones are
    /// approached.
    /// </summary>
    /// <param name="estimate">Shared time minus local time, within 48 days of zero, with its drift.</param>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="estimate"/> is further from zero by now.</exception>
    internal void Adjust(in ClockEstimate estimate)
    {
        lock (gate)
        {
            // If the local clock goes back despite its contract, this one only stands still.
            SimTime now = set ? SimTime.Max(own.Now, read) : own.Now;
            SimDuration offset = estimate.OffsetAt(now);
            if (offset.Ticks is < -MaxOffset or >= MaxOffset)
            {
                throw new ArgumentOutOfRangeException(nameof(estimate), offset.ToShortString(), "Two clocks of a session are at most 48 days apart.");
            }

            if (set)
            {
                AdvanceTo(now); // the time until now belongs to the estimate before this one
                remaining = restarts ? SimDuration.Zero : offset - CurrentOffset;
            }

            set = true;
            restarts = false;
            read = now;
            target = estimate;
        }
    }

    /// <summary>Makes the next estimate set the clock at once, for a world that begins again. Until then it runs on.</summary>
    internal void Restart()
    {
        lock (gate)
        {
            restarts = true;
        }
    }

    /// <summary>Gives the clock an estimate without drift.</summary>
    /// <param name="offset">Shared time minus local time, within 48 days of zero.</param>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="offset"/> is further from zero.</exception>
    internal void Adjust(SimDuration offset) => Adjust(new ClockEstimate(SimTime.Zero, offset));

    private void Advance() => AdvanceTo(SimTime.Max(own.Now, read));

    private void AdvanceTo(SimTime now)
    {
        remaining -= Slew(remaining, now - read);
        read = now;
    }

    /// <summary>Returns how much the offset moves towards the target in that much local time, never past it.</summary>
    private static SimDuration Slew(SimDuration error, SimDuration elapsed)
    {
        SimDuration size = error < SimDuration.Zero ? -error : error;
        SimDuration excess = size > FastAbove ? size - FastAbove : SimDuration.Zero;
        SimDuration fast = Lesser(excess, elapsed / FastShare);
        SimDuration slow = fast == excess ? Lesser(size - excess, (elapsed - (fast * FastShare)) / SlowShare) : SimDuration.Zero;
        return error < SimDuration.Zero ? -(fast + slow) : fast + slow;
    }

    private static SimDuration Lesser(SimDuration a, SimDuration b) => a < b ? a : b;
}
