using LagSim.Events;
using LagSim.Motion;
using LagSim.Time;

namespace LagSim.Handlers;

/// <summary>A world of the scene's static geometry and forces, in which a body is alone.</summary>
internal interface ISingleBodyWorld
{
    /// <summary>The segment that a body is on at a time, after all that happens then.</summary>
    /// <param name="spawn">The event that puts it there; any state, also one that no player may give.</param>
    /// <param name="time">Not before the event.</param>
    (MotionSegment Segment, DenseOutput Dense, Spin Spin) Follow(in ExternalEvent spawn, SimTime time);
}
