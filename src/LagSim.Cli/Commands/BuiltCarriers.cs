using LagSim.Cli.Output;
using LagSim.Harness.Experiments.Peers;
#if WITH_LITENETLIB
using LagSim.Net.Carriers;
#endif

namespace LagSim.Cli.Commands;

/// <summary>The carriers that can be asked for by name.</summary>
internal static class BuiltCarriers
{
    internal const string LiteNetLib = "litenetlib";

    internal static readonly string[] Names = [Carrier.Udp.Name, LiteNetLib];

    /// <summary>The carrier of one of <see cref="Names"/>.</summary>
    /// <exception cref="UsageException">This build does not have it.</exception>
    internal static Carrier Of(string name) => name == LiteNetLib ? OverLiteNetLib() : Carrier.Udp;

#if WITH_LITENETLIB
    private static Carrier OverLiteNetLib() => new(LiteNetLib, bind => new LiteNetLibPort(bind));
#else
    private static Carrier OverLiteNetLib() => throw new UsageException(
        "--transport litenetlib is not in this build. Build with -p:WithLiteNetLib=true to have it: that adds LagSim.Net.LiteNetLib and needs the package"
            + " LiteNetLib.");
#endif
}
