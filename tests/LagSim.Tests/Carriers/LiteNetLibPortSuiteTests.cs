using System.Net;
using LagSim.Net.Carriers;
using Xunit;

namespace LagSim.Tests.Carriers;

/// <summary>The suite over LiteNetLib.</summary>
[Trait("Time", "real")]
public sealed class LiteNetLibPortSuiteTests : DatagramPortSuite
{
    /// <inheritdoc/>
    protected override int RingSlots => LiteNetLibPort.RingSlots;

    /// <inheritdoc/>
    protected override IDatagramPort Open(IPEndPoint bind) => new LiteNetLibPort(bind);

    /// <inheritdoc/>
    protected override long Dropped(IDatagramPort port) => ((LiteNetLibPort)port).Dropped;
}
