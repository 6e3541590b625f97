namespace LagSim.Contacts;

/// <summary>The work of the contact solvers for the current event, in units of about a microsecond on a core of the 2020s.</summary>
internal sealed class SolverWork
{
    /// <summary>The cost of visiting a contact in a sweep; most visits find that nothing has changed.</summary>
    private const double WorkPerVisit = 0.03;

    /// <summary>The work since it was last cleared.</summary>
    internal double Done { get; private set; }

    /// <summary>Begins another event.</summary>
    internal void Clear() => Done = 0;

    /// <summary>Counts sweeps over contacts.</summary>
    internal void Count(int sweeps, int contacts) => Done += WorkPerVisit * sweeps * contacts;
}
