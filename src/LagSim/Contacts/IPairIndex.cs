using System;
using LagSim.Motion;

namespace LagSim.Contacts;

/// <summary>Which bodies another body's newest motion could touch, or come as near to as a hop is high. An index may name too many, never too few, and its order decides nothing.</summary>
internal interface IPairIndex
{
    /// <summary>A body's newest motion is this; an absent one is taken out.</summary>
    void Place(int slot, in MotionSegment segment);

    /// <summary>The slots of bodies that the newest motion of <paramref name="slot"/> may touch; may contain the slot itself. Valid until the next call.</summary>
    Span<int> Candidates(int slot);
}
