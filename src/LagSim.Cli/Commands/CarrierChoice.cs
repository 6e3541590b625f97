using LagSim.Harness.Experiments.Peers;
using LagSim.Net.Carriers;

namespace LagSim.Cli.Commands;

/// <summary>The carriers that can be asked for by name.</summary>
internal static class CarrierChoice
{
    private const string LiteNetLib = "litenetlib";

    internal static readonly string[] Names = [Carrier.Udp.Name, LiteNetLib];

    /// <summary>The carrier of one of <see cref="Names"/>.</summary>
    internal static Carrier Of(string name) => name == LiteNetLib ? new Carrier(LiteNetLib, bind => new LiteNetLibPort(bind)) : Carrier.Udp;
}
