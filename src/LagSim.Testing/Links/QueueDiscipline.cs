namespace LagSim.Testing.Links;

/// <summary>What a queue does with datagrams that arrive faster than they can leave.</summary>
public enum QueueDiscipline
{
    /// <summary>Accepts what fits and drops the rest on arrival; what is in gets out. Most modems and routers do this.</summary>
    DropTail,

    /// <summary>
    /// Controlled delay, RFC 8289: also drops at the head, the more often the longer every datagram has had to wait for more than 5 ms.
    /// </summary>
    CoDel,
}
