using LagSim.Events;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Timelines;

namespace LagSim.Handlers;

/// <summary>Handles the loss of a body that cannot be followed: it leaves the world, and what sleeps on it wakes.</summary>
internal sealed class LossHandler(BodyTable bodies, TimelineStore timelines, SleepWaker waker)
{
    /// <summary>The contact graph then has the bodies whose segments follow. False if one that sleeps on it has to be rewound first.</summary>
    internal bool TryHandle(int slot, in EventKey key)
    {
        if (!waker.TryFind(slot, key))
        {
            return false;
        }

        timelines.Append(slot, bodies.Id(slot), key, MotionSegment.Nothing(key.Time), default);
        waker.Wake(slot, key);
        return true;
    }
}
