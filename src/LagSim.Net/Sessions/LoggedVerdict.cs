using LagSim.Events;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions;

/// <summary>One line of the host's log: an event and what the host said to it.</summary>
internal readonly struct LoggedVerdict
{
    internal LoggedVerdict(in ExternalEvent what, Verdict verdict)
    {
        Event = what;
        Verdict = verdict;
    }

    internal ExternalEvent Event { get; }

    internal Verdict Verdict { get; }
}
