using LagSim.Events;

namespace LagSim.Rules;

/// <summary>What rules do to a body, and its place in the canonical order: the round after the call.</summary>
internal readonly struct RuleAct
{
    internal RuleAct(in EventKey key, in ExternalEvent what)
    {
        Key = key;
        What = what;
    }

    internal EventKey Key { get; }

    internal ExternalEvent What { get; }

    /// <summary>Whether it is the same, to the bit.</summary>
    internal bool IsSameAs(in RuleAct other) => Key == other.Key && What.Equals(other.What);
}
