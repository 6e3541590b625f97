using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Decides whether a client may join: by key, who is shut out, version, scene, token and place.</summary>
/// <remarks>
/// The key comes first, so that a wrong one is told and counted as wrong whatever else is so: otherwise who is shut out for a while would
/// guess keys, each of which lets in who is proven by it, unseen and as fast as he likes.
/// </remarks>
internal sealed class JoinRules(ulong sceneHash, BanList shutOuts, Seating seating)
{
    /// <summary>Returns why a client may not join; null if it may.</summary>
    /// <param name="join">The join.</param>
    /// <param name="who">Who it proved to be.</param>
    /// <param name="from">Its address.</param>
    /// <param name="now">The time by the local clock.</param>
    internal RefusalReason? WhyNot(in JoinDatagram join, JoinIdentity who, PeerAddress from, SimTime now) =>
        who.Key is null ? RefusalReason.WrongKey
            : shutOuts.IsShutOut(who.Known, from.Machine, now) ? RefusalReason.Banned
            : join.FoldVersion != (uint)Simulation.FoldVersion ? RefusalReason.FoldDiffers
            : join.SceneHash != 0 && join.SceneHash != sceneHash ? RefusalReason.SceneDiffers
            : who.Fault ?? seating.WhyNone(who, from, now, join.Role == (byte)PeerRole.Spectator);
}
