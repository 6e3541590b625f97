using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary>
/// Detects, once, that a machine cannot simulate a world in real time. A world that joined late, or whose machine slept, and is catching up
/// does not count.
/// </summary>
internal sealed class PaceWatch
{
    /// <summary>How far the world may be behind, and for how long without catching up.</summary>
    private static readonly SimDuration Timeout = SimDuration.FromSeconds(2);

    private bool isBehind;
    private bool hasFound;
    private SimTime since;
    private SimDuration least;

    /// <summary>
    /// Returns true the first time the world has been more than two seconds behind, without catching up at all, for two seconds.
    /// </summary>
    internal bool Finds(SimTime now, SimDuration behind)
    {
        bool wasBehind = isBehind;
        isBehind = behind > Timeout;
        if (!wasBehind || behind < least)
        {
            since = now;
            least = behind;
        }

        bool finds = isBehind && !hasFound && now - since > Timeout;
        hasFound |= finds;
        return finds;
    }
}
