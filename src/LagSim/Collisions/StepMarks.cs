using System;

namespace LagSim.Collisions;

/// <summary>
/// The bodies that the current contact step has opened and that strike no other body of it: pairs of them need no test.
/// </summary>
/// <remarks>Cost: O(1), also of clearing. Allocates only when there are more bodies than ever before.</remarks>
internal sealed class StepMarks
{
    private int[] stepOf = Array.Empty<int>(); // by slot: the last step that it was marked in
    private int step = 1;

    /// <summary>Marks a body.</summary>
    /// <param name="slot">Its slot.</param>
    /// <param name="room">All slots are below this.</param>
    internal void Add(int slot, int room)
    {
        if (stepOf.Length < room)
        {
            Array.Resize(ref stepOf, room);
        }

        stepOf[slot] = step;
    }

    /// <summary>Whether a body is marked.</summary>
    internal bool Has(int slot) => slot < stepOf.Length && stepOf[slot] == step;

    /// <summary>No body is marked any more.</summary>
    internal void Clear() => step++;
}
