using LagSim.Net.Protection;
using LagSim.Net.Sessions;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>The options of a host and its clients, protected by an identity or, without one, not at all.</summary>
internal static class ProtectedOptions
{
    /// <summary>Returns both.</summary>
    /// <param name="options">The host's options; clients take what applies to them.</param>
    /// <param name="identity">The host's identity; null for no protection.</param>
    internal static (HostOptions Host, ClientOptions Client) Of(HostOptions options, HostIdentity? identity) => identity is null
        ? (options, ClientOptions.From(options))
        : (options with { Protection = new SecureHost(identity) },
            ClientOptions.From(options) with { Protection = new SecureClient(identity.Fingerprint) });
}
