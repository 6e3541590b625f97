namespace LagSim.Net.Wire;

/// <summary>What verdicts have in common.</summary>
internal static class Verdicts
{
    /// <summary>The last verdict there is.</summary>
    internal const Verdict Last = Verdict.Moved;

    /// <summary>Whether the event happened, on every peer.</summary>
    internal static bool IsAcceptance(this Verdict verdict) => verdict is Verdict.Accepted or Verdict.Moved;
}
