namespace LagSim.Contacts;

/// <summary>What the solutions of contact steps, and of impacts on islands, are held to: each is a rule of docs/CONTACT.md.</summary>
/// <remarks>Immutable. A world has them all; a negative control hands in a derived class that lacks one.</remarks>
internal class SolverRules
{
    /// <summary>All of them.</summary>
    internal static readonly SolverRules Usual = new();

    /// <summary>Whether a hand pushes only as hard as what gives way needs.</summary>
    internal virtual bool LimitsHands => true;

    /// <summary>Whether a hand has a greatest force and power of its own, and what it touches gains no more energy than it gives.</summary>
    internal virtual bool BoundsHands => true;

    /// <summary>Whether overlap is pushed out, and what is struck rebounds, only as far as that makes no energy.</summary>
    internal virtual bool LimitsEnergy => true;

    /// <summary>Whether a contact that would rebound, but is solved without since that makes energy, lasts.</summary>
    internal virtual bool KeepsWhatDoesNotRebound => true;

    /// <summary>Whether what two give each other acts on both, also where one of them leaves.</summary>
    internal virtual bool KeepsMomentum => true;

    /// <summary>Whether a step that is cut short before its middle takes back what forces gave for the time after the cut.</summary>
    internal virtual bool TakesBackForces => true;

    /// <summary>Whether what forces owe for a step is given at its velocity, where the next is shorter.</summary>
    internal virtual bool GivesWhatForcesOwe => true;

    /// <summary>Whether a body leaves an island for the planes that alone hold it only once it touches them.</summary>
    internal virtual bool LeavesWhereItTouches => true;

    /// <summary>Whether <see cref="NormalRefinement"/> solves the normals where sweeps alone do not converge.</summary>
    internal virtual bool RefinesNormals => true;

    /// <summary>
    /// Whether bodies that lie inside one another cost no more than as many that lie side by side: each keeps its deepest contacts, in steps
    /// and in impacts.
    /// </summary>
    internal virtual bool LimitsCrowds => true;
}
