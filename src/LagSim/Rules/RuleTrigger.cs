using LagSim.Events;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>What rules are called for, besides its key: the kind of the key tells which of these counts.</summary>
internal readonly struct RuleTrigger
{
    private readonly object? told;

    internal RuleTrigger(in ImpactContact contact) => Contact = contact;

    internal RuleTrigger(in ExternalEvent external) => told = (object?)external.Command ?? external.PlayerEvent;

    internal RuleTrigger(bool entered) => Entered = entered;

    /// <summary>The contact, for an impact.</summary>
    internal ImpactContact Contact { get; }

    /// <summary>What a player told.</summary>
    internal GameCommand? Command => told as GameCommand;

    /// <summary>What the host says of a player.</summary>
    internal PlayerEvent? Player => told as PlayerEvent;

    /// <summary>Whether a body enters a sensor, for a crossing.</summary>
    internal bool Entered { get; }

    /// <summary>The order of triggers of one key: contacts of one impact, by bodies and surface.</summary>
    internal static int Compare(in RuleTrigger a, in RuleTrigger b)
    {
        int byFirst = a.Contact.First.CompareTo(b.Contact.First);
        int bySecond = byFirst != 0 ? byFirst : a.Contact.Second.CompareTo(b.Contact.Second);
        return bySecond != 0 ? bySecond : a.Contact.Surface.CompareTo(b.Contact.Surface);
    }

    /// <summary>Whether two triggers of one place in the order say the same, to the bit.</summary>
    internal bool IsSameAs(in RuleTrigger other) =>
        Entered == other.Entered && Contact.Position.Equals(other.Contact.Position) && Contact.ClosingSpeed.Equals(other.Contact.ClosingSpeed)
        && Equals(told, other.told);
}
