using System;
using LagSim.Net.Protection;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>The join that brings a cookie back, ready to be sent until it is answered, and the handshake that it begins.</summary>
internal sealed class PreparedJoin : IDisposable
{
    /// <summary>The age at which an unsuccessful cookie is stale, and another is requested.</summary>
    private static readonly SimDuration CookieAge = SimDuration.FromSeconds(20);

    private readonly byte[] bytes;

    /// <param name="cookie">The cookie.</param>
    /// <param name="bytes">The join.</param>
    /// <param name="handshake">The handshake; null in a session without protection.</param>
    /// <param name="now">The time by the local clock.</param>
    internal PreparedJoin(Token128 cookie, byte[] bytes, IClientHandshake? handshake, SimTime now)
    {
        this.bytes = bytes;
        Cookie = cookie;
        Handshake = handshake;
        Made = now;
    }

    internal Token128 Cookie { get; }

    /// <summary>The handshake that it begins; null in a session without protection.</summary>
    internal IClientHandshake? Handshake { get; }

    /// <summary>When the cookie arrived.</summary>
    internal SimTime Made { get; }

    internal ReadOnlySpan<byte> Bytes => bytes;

    /// <summary>Whether the cookie may still be good.</summary>
    internal bool IsFresh(SimTime now) => now - Made <= CookieAge;

    /// <summary>Wipes the keys of the handshake.</summary>
    public void Dispose() => Handshake?.Dispose();
}
