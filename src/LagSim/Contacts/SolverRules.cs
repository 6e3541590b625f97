namespace LagSim.Contacts;

/// <summary>What the solutions of contact steps, and of impacts on islands, are held to: each is a rule of docs/CONTACT.md.</summary>
/// <remarks>Immutable. A world has them all; what each is for is seen in one that lacks it.</remarks>
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
