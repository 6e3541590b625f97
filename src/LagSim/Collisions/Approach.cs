
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

    /// <summary>The seconds after the queried time during which there is no touch yet.</summary>
    internal double Seconds { get; }
}
