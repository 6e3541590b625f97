using System;
using System.Threading;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>A clock that stands still until it is moved: the true time of a virtual network.</summary>
/// <remarks>May be read from any thread; moved by one.</remarks>
public sealed class VirtualClock : IClock
{
    private long ticks;

    /// <summary>Creates a clock that reads <paramref name="start"/>.</summary>
    public VirtualClock(SimTime start = default) => ticks = start.Ticks;

    /// <summary>The reading of the clock. Setting it moves it forward, or leaves it where it is.</summary>
    /// <exception cref="ArgumentOutOfRangeException">Set to an earlier time.</exception>
    public SimTime Now
    {
        get => SimTime.FromTicks(Volatile.Read(ref ticks));
        set
        {
            if (value < Now)
            {
                throw new ArgumentOutOfRangeException(nameof(value), value.ToShortString(), $"The clock reads {Now.ToShortString()} and only goes forward.");
            }

            Volatile.Write(ref ticks, value.Ticks);
        }
    }
}
