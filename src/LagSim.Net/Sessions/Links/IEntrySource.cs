using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Links;

/// <summary>The entries that one peer sends another, numbered in order.</summary>
internal interface IEntrySource
{
    /// <summary>The number of the last entry.</summary>
    uint Last { get; }

    /// <summary>Returns an entry that is not acknowledged.</summary>
    UpdateEntry this[uint number] { get; }
}
