using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions;

namespace LagSim.Harness.Peers;

/// <summary>Counts the accepted events that stand in the host's log and came to a joiner neither by the log nor in a copy of the world.</summary>
/// <remarks>It looks at what both sessions told of their logs, not at what a session counts as lost. To be made before the joiner's session is stepped.</remarks>
public sealed class LogCoverage
{
    private readonly Session session;
    private readonly HashSet<uint> heard = [];
    private uint copied;

    /// <summary>Listens to a joiner's session.</summary>
    public LogCoverage(Session session)
    {
        this.session = session;
        session.Logged += entry => heard.Add(entry.Index);
        session.Begun += () => copied = session.LogStart;
        session.Renewed += _ => copied = session.LogStart;
    }

    /// <summary>How many of the host's accepted entries the joiner lacks, though it says that it has the log up to there.</summary>
    /// <param name="accepted">The numbers of the entries in the host's log that are accepted events.</param>
    public long CountLost(IEnumerable<uint> accepted) => accepted.Count(index => index > copied && index <= session.LogLength && !heard.Contains(index));
}
