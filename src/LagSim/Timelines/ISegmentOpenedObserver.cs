using LagSim.Events;

namespace LagSim.Timelines;

/// <summary>Notified of segments, as they are opened.</summary>
internal interface ISegmentOpenedObserver
{
    /// <summary>A body's next segment is about to be opened at a key.</summary>
    void OnOpened(int slot, in EventKey key);
}
