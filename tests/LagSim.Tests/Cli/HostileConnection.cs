namespace LagSim.Tests.Cli;

/// <summary>What somebody does with a connection who wants to keep others out.</summary>
public enum HostileConnection
{
    /// <summary>Sends nothing.</summary>
    IsSilent,

    /// <summary>Sends the head of a request, a byte at a time, without end (slow loris).</summary>
    DripsAHeader,

    /// <summary>Asks once, reads the answer, and then sends nothing.</summary>
    AsksAndStays,

    /// <summary>Asks for a large file and reads nothing of it.</summary>
    AsksAndReadsNothing,

    /// <summary>Opens a WebSocket and only answers pings.</summary>
    AnswersPings,

    /// <summary>Opens a WebSocket and sends datagrams that are nothing to the session.</summary>
    SendsNonsense,
}
