namespace LagSim.Testing.Links;

/// <summary>What a queue does with datagrams that come faster than they can leave.</summary>
public enum QueueDiscipline
{
    /// <summary>
    /// Takes what there is room for and loses the rest as it comes; what is in gets out. What most modems and routers do.
    /// </summary>
    DropTail,

    /// <summary>
    /// Controlled delay, RFC 8289: also loses at the head, the more often the longer every datagram has had to wait for more than 5 ms.
    /// </summary>
    CoDel,
}
