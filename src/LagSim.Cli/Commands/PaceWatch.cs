using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary>
/// Finds out, once, that a machine cannot simulate a world as fast as time passes. One that has come late, or has slept, and catches up, is
/// not that.
/// </summary>
internal sealed class PaceWatch
{
    /// <summary>How far a world may be behind, and for how long it may then come no nearer.</summary>
    private static readonly SimDuration Timeout = SimDuration.FromSeconds(2);

    private bool isBehind;
    private bool hasFound;
    private SimTime since;
    private SimDuration least;

    /// <summary>
    /// Looks; true the first time that the world has been behind by more than two seconds, and has not caught up by anything, for two
    /// seconds.
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
