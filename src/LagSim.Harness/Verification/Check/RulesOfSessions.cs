namespace LagSim.Harness.Verification.Check;

/// <summary>Which sessions of a check have rules.</summary>
public enum RulesOfSessions
{
    /// <summary>Fifteen of a hundred.</summary>
    Some,

    /// <summary>Every session.</summary>
    All,

    /// <summary>None.</summary>
    None,
}
