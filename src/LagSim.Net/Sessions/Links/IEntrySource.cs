using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Links;

/// <summary>Entries that one peer has for another, numbered in the order in which that one is to have them.</summary>
internal interface IEntrySource
{
    /// <summary>The number of the last one.</summary>
    uint Last { get; }

    /// <summary>An entry that is not acknowledged.</summary>
    UpdateEntry this[uint number] { get; }
}
