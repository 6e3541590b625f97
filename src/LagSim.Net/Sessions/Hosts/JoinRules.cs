using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Who may come in at all: by machine, key, version, scene and place.</summary>
internal sealed class JoinRules(HostOptions options, ulong sceneHash, ShutOuts shutOuts, Seating seating)
{
    /// <summary>The number that a player's key gives; 0 if it is none.</summary>
    internal byte NumberByKey(in JoinDatagram join)
    {
        foreach (KeyValuePair<byte, string> player in options.PlayerKeys)
        {
            if (JoinCookies.IsProof(player.Value, join))
            {
                return player.Key;
            }
        }

        return 0;
    }

    /// <summary>Why somebody may not come in; null if it may.</summary>
    /// <param name="join">How it asks.</param>
    /// <param name="keyed">The number that its key gives; 0 for none.</param>
    /// <param name="claimed">The place of the player that it shows it was; null for none.</param>
    /// <param name="from">Where it is.</param>
    /// <param name="now">By the own clock.</param>
    internal RefusalReason? WhyNot(in JoinDatagram join, byte keyed, PlayerPlaces.Place? claimed, PeerAddress from, SimTime now) =>
        shutOuts.IsShutOut(from.Machine, now) ? RefusalReason.Banned
            : keyed == 0 && !JoinCookies.IsProof(options.ConnectKey, join) ? RefusalReason.WrongKey
            : join.FoldVersion != (uint)Simulation.FoldVersion ? RefusalReason.FoldDiffers
            : join.SceneHash != 0 && join.SceneHash != sceneHash ? RefusalReason.SceneDiffers
            : seating.WhyNone(keyed, claimed, from, now);
}
