using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>A refused action of which nobody has heard so far: no handler, and no code that asked for its answer.</summary>
/// <param name="line">What to say if it stays so.</param>
/// <param name="at">When it was refused, by the session's clock.</param>
internal sealed class UnheardRefusal(string line, SimTime at)
{
    private volatile bool isHeard;

    internal string Line { get; } = line;

    internal SimTime At { get; } = at;

    internal bool IsHeard => isHeard;

    /// <summary>Somebody has asked for the answer. From any thread.</summary>
    internal void Hear() => isHeard = true;
}
