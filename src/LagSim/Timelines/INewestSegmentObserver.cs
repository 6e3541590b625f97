using LagSim.Motion;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>Notified of each body's newest segment, as segments are opened and cut.</summary>
internal interface INewestSegmentObserver
{
    /// <summary>This is now the newest segment of a body.</summary>
    /// <param name="slot">The body.</param>
    /// <param name="segment">The segment.</param>
    /// <param name="opened">When it was opened.</param>
    void Set(int slot, in MotionSegment segment, SimTime opened);

    /// <summary>A body has no segment any more.</summary>
    void Clear(int slot);
}
