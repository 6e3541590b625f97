using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Decides whether a client may join: by machine, key, version, scene and place.</summary>
internal sealed class JoinRules(HostOptions options, ulong sceneHash, BanList shutOuts, Seating seating)
{
    /// <summary>The number that a player's key gives; 0 for another key.</summary>
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

    /// <summary>The key of a number that a key gave; the session's for 0.</summary>
    internal string KeyOf(byte keyed) => keyed > 0 ? options.PlayerKeys[keyed] : options.ConnectKey;

    /// <summary>Returns why a client may not join; null if it may.</summary>
    /// <param name="join">The join.</param>
    /// <param name="keyed">The number that its key gives; 0 for none.</param>
    /// <param name="claimed">The place of the player that it proved to be; null for none.</param>
    /// <param name="from">Its address.</param>
    /// <param name="now">The time by the local clock.</param>
    internal RefusalReason? WhyNot(in JoinDatagram join, byte keyed, PlayerPlaces.Place? claimed, PeerAddress from, SimTime now) =>
        shutOuts.IsShutOut(from.Machine, now) ? RefusalReason.Banned
            : keyed == 0 && !JoinCookies.IsProof(options.ConnectKey, join) ? RefusalReason.WrongKey
            : join.FoldVersion != (uint)Simulation.FoldVersion ? RefusalReason.FoldDiffers
            : join.SceneHash != 0 && join.SceneHash != sceneHash ? RefusalReason.SceneDiffers
            : seating.WhyNone(keyed, claimed, from, now);
}
