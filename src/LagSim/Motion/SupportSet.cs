namespace LagSim.Motion;

/// <summary>
/// The static planes, up to three, that carry a sliding or resting body, by their index in the scene, in ascending order.
/// </summary>
internal readonly struct SupportSet
{
    internal const int Most = 3;

    private readonly int first;
    private readonly int second;
    private readonly int third;

    internal SupportSet(int count, int first, int second, int third)
    {
        Count = count;
        this.first = first;
        this.second = second;
        this.third = third;
    }

    internal int Count { get; }

    internal int this[int i] => i switch { 0 => first, 1 => second, _ => third };

    internal bool Contains(int plane) =>
        (Count > 0 && first == plane) || (Count > 1 && second == plane) || (Count > 2 && third == plane);
}
