using System;
using System.Net;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A session that others can reach and nothing protects is hosted only by who writes so.</summary>
[Trait("Time", "real")]
public sealed class UnprotectedHostTests
{
    [Fact]
    public void Host_WithoutProtectionForTheNetwork_IsRefusedWithWhatToWrite()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Any, 0)); // its LocalAddress is a loopback address, too
        Assert.Equal(IPAddress.Loopback, port.LocalAddress.ToIPAddress());
        foreach (Action hosts in new Action[]
        {
            () => PeerThread.Host(BuiltInScenes.Pair()).Dispose(),
            () => PeerThread.Host(BuiltInScenes.Pair(), options: new HostOptions { ConnectKey = "a key" }).Dispose(),
            () => PeerThread.Host(BuiltInScenes.Pair(), port).Dispose(),
        })
        {
            ArgumentException refused = Assert.Throws<ArgumentException>(hosts);
            Assert.Equal("Protection", refused.ParamName);
            Assert.Contains("Set Protection (the package LagSim.Net.Secure has it: SecureHost), or Unprotected = true", refused.Message, StringComparison.Ordinal);
        }

        Assert.Throws<ObjectDisposedException>(() => port.Send([1], PeerAddress.From(new IPEndPoint(IPAddress.Loopback, 9)))); // the carrier is not left open
    }

    [Fact]
    public void Host_WithTheWordOrAProtectionOrForThisMachineAlone_IsThere()
    {
        using HostIdentity identity = HostIdentity.Draw();
        VirtualNetwork network = new(new VirtualClock(SimTime.Zero), 1, LinkProfiles.Loopback);
        foreach ((Func<PeerThread> host, bool isProtected) in new (Func<PeerThread>, bool)[]
        {
            (() => PeerThread.Host(BuiltInScenes.Pair(), options: new HostOptions { Unprotected = true }), false),
            (() => PeerThread.Host(BuiltInScenes.Pair(), options: new HostOptions { Protection = new SecureHost(identity) }), true),
            (() => PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Loopback), false),
            (() => PeerThread.Host(BuiltInScenes.Pair(), network.CreatePort(0)), false),
            (() => PeerThread.Host(BuiltInScenes.Pair(), new UdpPort(new IPEndPoint(IPAddress.Loopback, 0))), false),
            (() => PeerThread.Host(BuiltInScenes.Pair(), new UdpPort(new IPEndPoint(IPAddress.Parse("127.0.0.2"), 0))), false),
        })
        {
            using PeerThread thread = host();
            Assert.Equal(isProtected, thread.Session.IsProtected);
        }
    }

    [Fact]
    public void Host_WithTheWordAndAProtection_IsAContradiction()
    {
        using HostIdentity identity = HostIdentity.Draw();
        ArgumentException refused = Assert.Throws<ArgumentException>(
            () => PeerThread.Host(BuiltInScenes.Pair(), options: new HostOptions { Protection = new SecureHost(identity), Unprotected = true }));
        Assert.Equal("Unprotected", refused.ParamName);
    }
}
