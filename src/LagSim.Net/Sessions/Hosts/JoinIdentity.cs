using LagSim.Net.Protection;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Who a joining client has proved to be: by a key, by a player's pass, by a connect token.</summary>
/// <param name="Key">The key that it proved to know, the session's or a player's; null if it is none of this host's.</param>
/// <param name="Keyed">The number that its key or token gives; 0 for none.</param>
/// <param name="Claimed">The place of the player that it proved to be; null for none.</param>
/// <param name="Admission">What a token says of it, this one or that with which it first came in; null without one.</param>
/// <param name="Fault">What is wrong with its token; null for nothing.</param>
/// <param name="IsByToken">Whether it is this token that lets it in, which is used once.</param>
/// <param name="SecondsOff">How far the token is off its time, in seconds.</param>
internal sealed record JoinIdentity(
    string? Key, byte Keyed, PlayerPlaces.Place? Claimed, PlayerAdmission? Admission = null, RefusalReason? Fault = null,
    bool IsByToken = false, uint SecondsOff = 0)
{
    /// <summary>By what the host knows it again.</summary>
    internal KnownPlayer Known => new(Admission, Keyed, Claimed);
}
