using System;

namespace LagSim.Contacts;

/// <summary>The planes that a body touches, each once, in the scene's order.</summary>
/// <remarks>Filled and cleared again and again: it allocates only when a body touches more planes than any before.</remarks>
internal sealed class PlaneSet
{
    private int[] planes = Array.Empty<int>();
    private int count;

    internal Span<int> Planes => planes.AsSpan(0, count);

    internal void Clear() => count = 0;

    internal void Add(int plane)
    {
        int at = Array.BinarySearch(planes, 0, count, plane);
        if (at >= 0)
        {
            return;
        }

        if (count == planes.Length)
        {
            Array.Resize(ref planes, Math.Max(4, count * 2));
        }

        Array.Copy(planes, ~at, planes, ~at + 1, count - ~at);
        planes[~at] = plane;
        count++;
    }
}
