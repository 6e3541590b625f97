using System;
using System.Net;
using LagSim.Net.Carriers;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>A carrier of datagrams between peers in real time.</summary>
/// <param name="Name">Its name on the command line and in results.</param>
/// <param name="Open">Opens a port at an endpoint; port 0 is any free one.</param>
public sealed record Carrier(string Name, Func<IPEndPoint, IDatagramPort> Open)
{
    /// <summary>Plain UDP sockets.</summary>
    public static readonly Carrier Udp = new("udp", bind => new UdpPort(bind));

    /// <summary>Whether the sessions over it are protected; default true.</summary>
    public bool IsProtected { get; init; } = true;

    /// <summary>Its name, and whether it is protected, for titles.</summary>
    public override string ToString() => Name + (IsProtected ? ", protected" : ", NOT PROTECTED");
}
