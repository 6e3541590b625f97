using System;

namespace LagSim.Net.Protection;

/// <summary>A key that a host had before: it still proves the host to clients that know no newer one, and vouches for the one it has now.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class FormerHostKey
{
    internal FormerHostKey(Curve25519KeyPair keys, DateTimeOffset until)
    {
        Keys = keys;
        Until = until;
        Fingerprint = HostFingerprint.OfPublicKey(keys.PublicKey);
    }

    /// <summary>What clients knew the host by.</summary>
    public HostFingerprint Fingerprint { get; }

    /// <summary>From this instant on, by its own clock, the host has no use for the key any more. Whole seconds.</summary>
    public DateTimeOffset Until { get; }

    internal Curve25519KeyPair Keys { get; }

    /// <summary>Fingerprint and end; never the secret.</summary>
    public override string ToString() => FormattableString.Invariant($"{Fingerprint} until {Until.UtcDateTime:yyyy-MM-dd HH:mm:ss}Z");
}
