using LagSim.Contacts;

namespace LagSim.Tests.Faults;

/// <summary>Rules of the contact solution of which some are missing.</summary>
internal sealed class FaultySolverRules : SolverRules
{
    /// <summary>A hand pushes as hard as it takes.</summary>
    internal bool HasTirelessHands { get; init; }

    /// <summary>A hand has no greatest force and power of its own, and what it touches gains what it likes.</summary>
    internal bool HasUnboundedHands { get; init; }

    /// <summary>Overlap is pushed out, and what is struck rebounds, whatever energy that makes.</summary>
    internal bool GainsEnergy { get; init; }

    /// <summary>What is solved without its rebound counts as if it had rebounded.</summary>
    internal bool DropsWhatDoesNotRebound { get; init; }

    /// <summary>What leaves keeps pushes that the other does not feel, and does not feel what slows the other down.</summary>
    internal bool LosesMomentum { get; init; }

    /// <summary>Forces act backwards on what is cut short in its step.</summary>
    internal bool ActsBackwards { get; init; }

    /// <summary>What forces owe for a long step, they give at the velocity of a short one.</summary>
    internal bool GivesForcesLate { get; init; }

    /// <summary>What planes alone hold leaves for them where it is, above them or in them.</summary>
    internal bool LeavesInTheAir { get; init; }

    /// <summary>What sweeps do not settle stays unsettled.</summary>
    internal bool SweepsAlone { get; init; }

    /// <summary>Bodies inside one another are solved with all their pairs.</summary>
    internal bool SolvesCrowds { get; init; }

    internal override bool LimitsHands => !HasTirelessHands;

    internal override bool BoundsHands => !HasUnboundedHands;

    internal override bool LimitsEnergy => !GainsEnergy;

    internal override bool KeepsWhatDoesNotRebound => !DropsWhatDoesNotRebound;

    internal override bool KeepsMomentum => !LosesMomentum;

    internal override bool TakesBackForces => !ActsBackwards;

    internal override bool GivesWhatForcesOwe => !GivesForcesLate;

    internal override bool LeavesWhereItTouches => !LeavesInTheAir;

    internal override bool RefinesNormals => !SweepsAlone;

    internal override bool LimitsCrowds => !SolvesCrowds;
}
