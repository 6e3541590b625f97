using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Trajectories;

/// <summary>Takes a body out of the world that cannot be followed further, in place of opening its next segment.</summary>
/// <remarks>
/// What it opens is a segment that lasts no time. <see cref="EventKind.Lost"/> follows at the same tick, wakes what sleeps on the body,
/// and tells rules and games. So a loss is healed as any other event is.
/// </remarks>
internal sealed class BodyLoss(BodyTable bodies, TimelineStore timelines, StateLimits limits)
{
    /// <summary>Whether a body may be in a state; if not, it is lost.</summary>
    internal bool TryAllow(int slot, in EventKey key, in Vector3D position, in Vector3D velocity)
    {
        bool isAllowed = limits.Allow(position, velocity);
        if (!isAllowed)
        {
            Lose(slot, key, position, velocity, position.IsFinite && !double.IsNaN(velocity.Length) ? LossReason.TooFast : LossReason.NotFinite);
        }

        return isAllowed;
    }

    /// <summary>The body can be followed no further than to a state; its spin counts where forces on it do.</summary>
    internal void Lose(int slot, in EventKey key, in Vector3D position, in Vector3D velocity, LossReason why, in Vector3D spin = default) =>
        timelines.Append(slot, bodies.Id(slot), key, MotionSegment.Lost(key.Time, position, velocity, why), default, spin: new Spin(spin));
}
