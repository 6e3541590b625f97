using System.Net;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;

namespace LagSim.Tests.Docs;

/// <summary>The code of the page of LagSim.Net.LiteNetLib, compiled.</summary>
internal static class LiteNetLibSnippets
{
    internal static void Share(Scene scene)
    {
        using PeerThread host = PeerThread.Host(scene, new LiteNetLibPort(new IPEndPoint(IPAddress.Any, 5000)), new HostOptions { Unprotected = true });

        // on another machine
        PeerAddress there = PeerAddress.From(new IPEndPoint(IPAddress.Parse("192.0.2.1"), 5000));
        using PeerThread client = PeerThread.Join(new LiteNetLibPort(new IPEndPoint(IPAddress.Any, 0)), there);
    }
}
