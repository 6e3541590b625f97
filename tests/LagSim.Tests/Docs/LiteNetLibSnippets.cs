using System.Net;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;

namespace LagSim.Tests.Docs;

/// <summary>The code of the page of LagSim.Net.LiteNetLib, compiled.</summary>
internal static class LiteNetLibSnippets
{
    internal static void Host(Scene scene, ulong sessionId)
    {
        // sessionId: a random number; a client is a ClientSession in place of the HostSession
        using LiteNetLibPort port = new(new IPEndPoint(IPAddress.Any, 5000));
        using PeerThread host = new(new HostSession(scene, port, new StopwatchClock(), new SessionOptions(), sessionId), port, "host");
        host.Start();
    }
}
