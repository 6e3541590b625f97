using System.Collections.Generic;
using LagSim.Events;

namespace LagSim.Rollback;

/// <summary>Who has to be rewound, and to which key, before the event at hand can be processed: its path is known beyond it.</summary>
internal sealed class RewindRequests
{
    private readonly List<(int Slot, EventKey Key)> requests = new();

    /// <summary>Whether nobody has to be.</summary>
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
