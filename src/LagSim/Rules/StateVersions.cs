using System;
using System.Collections.Generic;

namespace LagSim.Rules;

/// <summary>Lends versions of the state, and takes back those that nobody keeps any more, so that no memory is asked for after a
/// while.</summary>
internal sealed class StateVersions
{
    private readonly Stack<StateVersion> free = new();
    private long lastSerial;

    /// <summary>How many bytes the versions have that somebody keeps.</summary>
    internal long Bytes { get; private set; }

    /// <summary>A version of this state, kept once.</summary>
    internal StateVersion Add(ReadOnlySpan<byte> state)
    {
        StateVersion version = free.Count > 0 ? free.Pop() : new StateVersion();
        version.Set(state, ++lastSerial);
        version.Uses = 1;
        Bytes += state.Length;
        return version;
    }

    /// <summary>Keeps a version in place of another that was kept, or of none.</summary>
    internal void Replace(ref StateVersion? kept, StateVersion? by)
    {
        if (by is not null)
        {
            by.Uses++;
        }

        if (kept is not null && --kept.Uses == 0)
        {
            Bytes -= kept.Bytes.Length;
            free.Push(kept);
        }

        kept = by;
    }
}
