using System.Collections.Generic;
using LagSim.Events;

namespace LagSim.Rollback;

/// <summary>
/// The bodies that have to be rewound, and to which key, before the current event can be processed: their paths are known beyond it.
/// </summary>
internal sealed class RewindRequests
{
    private readonly List<(int Slot, EventKey Key)> requests = new();

    /// <summary>Whether no body has to be rewound.</summary>
    internal bool AreNone => requests.Count == 0;

    /// <summary>Asks for a body to be rewound.</summary>
    internal void Add(int slot, in EventKey key) => requests.Add((slot, key));

    /// <summary>Asks for nothing.</summary>
    internal void Clear() => requests.Clear();

    /// <summary>Takes out the newest request; false if there is none.</summary>
    internal bool TryTake(out int slot, out EventKey key)
    {
        bool any = requests.Count > 0;
        (slot, key) = any ? requests[requests.Count - 1] : default;
        if (any)
        {
            requests.RemoveAt(requests.Count - 1);
        }

        return any;
    }
}
