using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Which events happen later than they are stamped, rather than not at all, when they come too late.</summary>
/// <remarks>
/// <para>Those that say what is to be from then on, or how much is added: a velocity, an impulse, a release, a removal, a filter, a command of
/// the game. Without them a thrust would stay on, or a ball be held for ever. What says where something is at an instant does not move:
/// a spawn, a teleport, a grab, a keyframe. The world has gone on meanwhile, and the place may be taken.</para>
/// <para>A player's events keep their order. Only where it stamps ahead of time can a later one have happened already: then an earlier one
/// of the same kind on the same body, or a command of the same number, says what is no longer so.</para>
/// </remarks>
internal static class LateActions
{
    /// <summary>Whether an event that is too late may happen at a later time.</summary>
    /// <param name="external">The event, as it is stamped.</param>
    /// <param name="stamps">When its player's events happened.</param>
    /// <param name="recent">The newest events of the log.</param>
    internal static bool MayMove(in ExternalEvent external, ClientStamps stamps, RecentEvents recent) => external.Kind switch
    {
        EventKind.Impulse => true, // a sum knows no order
        EventKind.SetVelocity or EventKind.Release or EventKind.Remove or EventKind.SetFilter or EventKind.Command =>
            stamps.Latest <= external.Time || !IsSuperseded(external, recent),
        _ => false,
    };

    private static bool IsSuperseded(in ExternalEvent external, RecentEvents recent)
    {
        foreach (LogEntry entry in recent.Accepted(external.Peer))
        {
            ExternalEvent other = entry.Event;
            bool isAlike = other.Kind == external.Kind
                && (external.Command is null ? other.Body == external.Body : other.Command!.Number == external.Command.Number);
            if (isAlike && entry.Verdict == Verdict.Accepted && other.Time > external.Time)
            {
                return true;
            }
        }

        return false;
    }
}
