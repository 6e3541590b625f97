namespace LagSim.Contacts;

/// <summary>
/// The work done for the current event, counted by what takes the time: tests of paths for contact, and sweeps of contact solvers. In units
/// of about a microsecond on a core of the 2020s.
/// </summary>
/// <remarks>
/// The costs were measured together, by <c>LagSim.Bench -- counted</c>. docs/BUDGETS.md says how accurate they are.
/// </remarks>
internal sealed class EventWork
{
    /// <summary>The cost of visiting a contact in a sweep; most visits find that nothing has changed.</summary>
    private const double WorkPerVisit = 0.03;

    /// <summary>The cost of looking at a candidate; most are seen to be apart at once.</summary>
    private const double WorkPerCandidate = 0.03;

    /// <summary>The cost of searching two paths for a contact.</summary>
    private const double WorkPerTest = 0.25;

    /// <summary>The work since it was last cleared.</summary>
    internal double Done { get; private set; }

    /// <summary>The part of it that contact solvers did.</summary>
    internal double Solved { get; private set; }

    /// <summary>Begins another event.</summary>
    internal void Clear()
    {
        Done = 0;
        Solved = 0;
    }

    /// <summary>Counts sweeps over contacts.</summary>
    internal void CountSweeps(int sweeps, int contacts)
    {
        Solved += WorkPerVisit * sweeps * contacts;
        Done += WorkPerVisit * sweeps * contacts;
    }

    /// <summary>Counts bodies that were looked at, since they may be near.</summary>
    internal void CountCandidates(int bodies) => Done += WorkPerCandidate * bodies;

    /// <summary>Counts a search of two paths for a contact.</summary>
    internal void CountTest() => Done += WorkPerTest;
}
