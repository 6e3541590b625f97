using System;
using LagSim.Motion;

namespace LagSim.Contacts;

/// <summary>Which bodies another body's newest motion could touch, or come as near to as a hop is high: what they do, did inside the window, or are to do. An index may name too many, never too few, and its order decides nothing.</summary>
internal interface IPairIndex
{
    /// <summary>A body's newest motion is this, which may be that it is not there.</summary>
    void Place(int slot, in MotionSegment segment);

    /// <summary>A body is gone for good.</summary>
    void Forget(int slot);

    /// <summary>The slots of bodies that the newest motion of <paramref name="slot"/> may touch; may contain the slot itself. Valid until the next call.</summary>
    Span<int> Candidates(int slot);
}
