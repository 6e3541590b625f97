using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Display;

/// <summary>The newest samples of a hand, oldest first, in a ring of fixed size.</summary>
internal sealed class HandHistory
{
    private readonly Sample[] ring;
    private int oldest;

    internal HandHistory(int capacity) => ring = new Sample[capacity];

    internal int Count { get; private set; }

    internal ref Sample this[int n] => ref ring[(oldest + n) % ring.Length];

    internal ref Sample Newest => ref this[Count - 1];

    internal void Add(SimTime time, in Vector3D position, in Vector3D velocity)
    {
        if (Count == ring.Length)
        {
            oldest = (oldest + 1) % ring.Length;
            Count--;
        }

        Count++;
        Newest = new Sample(time, position, velocity);
    }

    /// <summary>The seconds from one instant to a later one, however far apart.</summary>
    internal static double Seconds(SimTime from, SimTime to)
    {
        long span = unchecked(to.Ticks - from.Ticks);
        return (span < 0 ? (double)to.Ticks - from.Ticks : span) / SimDuration.TicksPerSecond;
    }

    /// <summary>The index of the last sample at or before an instant; -1 if there is none.</summary>
    internal int LastAt(SimTime time)
    {
        int low = 0;
        int high = Count;
        while (low < high)
        {
            int middle = (low + high) >> 1;
            if (this[middle].Time <= time)
            {
                low = middle + 1;
            }
            else
            {
                high = middle;
            }
        }

        return low - 1;
    }

    /// <summary>
    /// Interpolates the hand's position at an instant between the oldest and the newest sample, on the straight line between the two around
    /// it.
    /// </summary>
    internal bool TryPositionAt(SimTime time, out Vector3D position)
    {
        int before = LastAt(time);
        if (before < 0 || (before == Count - 1 && time > Newest.Time))
        {
            position = default;
            return false;
        }

        ref readonly Sample a = ref this[before];
        if (time == a.Time)
        {
            position = a.Position;
            return true;
        }

        ref readonly Sample b = ref this[before + 1];
        double part = Seconds(a.Time, time) / Seconds(a.Time, b.Time);
        position = a.Position + ((b.Position - a.Position) * part);
        return true;
    }

    internal struct Sample
    {
        internal Sample(SimTime time, in Vector3D position, in Vector3D velocity)
        {
            Time = time;
            Position = position;
            Velocity = velocity;
            Learned = default;
        }

        internal SimTime Time { get; }

        internal Vector3D Position { get; }

        internal Vector3D Velocity { get; }

        /// <summary>The mean velocity over the horizon that the least squares predicted when this sample was the newest; m/s.</summary>
        internal Vector3D Learned { get; set; }
    }
}
