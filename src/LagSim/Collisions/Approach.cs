
namespace LagSim.Collisions;

/// <summary>Another that may be touched, and from when on.</summary>
internal readonly struct Approach
{
    internal Approach(int slot, double seconds)
    {
        Slot = slot;
        Seconds = seconds;
    }

    internal int Slot { get; }

    /// <summary>So many seconds after the time that was asked from it is not touched yet.</summary>
    internal double Seconds { get; }
}
