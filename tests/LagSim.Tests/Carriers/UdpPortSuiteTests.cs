using System.Net;
using LagSim.Net.Carriers;
using Xunit;

namespace LagSim.Tests.Carriers;

/// <summary>The suite over UDP sockets.</summary>
[Trait("Time", "real")]
public sealed class UdpPortSuiteTests : DatagramPortSuite
{
    /// <inheritdoc/>
    protected override int RingSlots => UdpPort.RingSlots;

    /// <inheritdoc/>
    protected override IDatagramPort Open(IPEndPoint bind) => new UdpPort(bind);

    /// <inheritdoc/>
    protected override long Dropped(IDatagramPort port) => ((UdpPort)port).Dropped;
}
