namespace LagSim.Contacts;

/// <summary>The rules for the solutions of contact steps, and of impacts on islands: each is a rule of docs/CONTACT.md.</summary>
/// <remarks>Immutable. A world has them all; tests leave one out to show what it is for.</remarks>
internal sealed class SolverRules
{
    /// <summary>All of them.</summary>
    internal static readonly SolverRules Usual = new();

    /// <param name="limitsHands">See <see cref="LimitsHands"/>.</param>
    /// <param name="limitsEnergy">See <see cref="LimitsEnergy"/>.</param>
    /// <param name="settlesNormals">See <see cref="SettlesNormals"/>.</param>
    internal SolverRules(bool limitsHands = true, bool limitsEnergy = true, bool settlesNormals = true)
    {
        LimitsHands = limitsHands;
        LimitsEnergy = limitsEnergy;
        SettlesNormals = settlesNormals;
    }

    /// <summary>Whether a hand pushes with a limited force only.</summary>
    internal bool LimitsHands { get; }

    /// <summary>Whether overlap is pushed out, and what is struck rebounds, only as far as that makes no energy.</summary>
    internal bool LimitsEnergy { get; }

    /// <summary>Whether <see cref="NormalsAfterSweeps"/> ends what sweeps alone do not settle.</summary>
    internal bool SettlesNormals { get; }
}
