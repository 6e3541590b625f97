using LagSim.Time;

namespace LagSim.Events;

/// <summary>When two paths touch: the tick of the event, and how far the unrounded root lies from it.</summary>
/// <remarks>
/// The impact acts at the root and its result is carried to the tick, so that rounding to ticks does not accumulate over many bounces.
/// </remarks>
internal readonly struct ContactTime
{
    private ContactTime(SimTime tick, double residual)
    {
        Tick = tick;
        Residual = residual;
    }

    internal SimTime Tick { get; }

    /// <summary>The root minus the tick, in seconds; at most half a tick either way.</summary>
    internal double Residual { get; }

    /// <summary>
    /// 2^-20 s. A pair that closes a gap of rounding later than that closes at less than 1 nm/s. A slowly closing pair is rechecked only
    /// this much later.
    /// </summary>
    internal static readonly SimDuration Soon = SimDuration.FromTicks(SoonTicks);

    /// <summary><see cref="Soon"/> in ticks.</summary>
    internal const long SoonTicks = 1L << 20;

    /// <summary>Whether it comes so soon after two paths were opened that their gap may have been no more than rounding then.</summary>
    internal bool IsSoonAfter(SimTime opened) => Tick - opened < Soon;

    /// <summary>The contact at a tick itself.</summary>
    internal static ContactTime At(SimTime tick) => new(tick, 0);

    /// <summary>
    /// The contact of a root in seconds after <paramref name="from"/>; none if the root is NaN or after <paramref name="until"/>.
    /// </summary>
    internal static bool TryMake(SimTime from, SimTime until, double root, out ContactTime contact)
    {
        // The span from..until may exceed the range of a long; as an unsigned difference it never does.
        if (!TickConversion.TryFromSeconds(root, out long ticks) || (ulong)ticks > (ulong)until.Ticks - (ulong)from.Ticks)
        {
            contact = default;
            return false;
        }

        contact = new ContactTime(SimTime.FromTicks(from.Ticks + ticks), root - (ticks * TickConversion.SecondsPerTick));
        return true;
    }
}
