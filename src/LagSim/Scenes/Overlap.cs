namespace LagSim.Scenes;

/// <summary>
/// Two bodies that overlap, by their places in the scene, the one that was added first as the first; and how deep in metres.
/// </summary>
internal readonly struct Overlap
{
    internal Overlap(int first, int second, double depth)
    {
        First = first;
        Second = second;
        Depth = depth;
    }

    internal int First { get; }

    internal int Second { get; }

    internal double Depth { get; }
}
