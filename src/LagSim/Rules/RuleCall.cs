using System.Collections.Generic;
using LagSim.Events;

namespace LagSim.Rules;

/// <summary>A call of rules: what it is for and, once it was made, what it read, what it did, and the state before and after.</summary>
internal sealed class RuleCall
{
    /// <summary>The event that it is for; the call comes right after it.</summary>
    internal EventKey Key;

    /// <summary>More about that event.</summary>
    internal RuleTrigger Trigger;

    /// <summary>Whether it was made. What it read and did then counts as long as it would be made with the same again.</summary>
    internal bool IsMade;

    /// <summary>Whether what it is for no longer happens. It stays until the world comes there, since it may happen again.</summary>
    internal bool IsGone;

    /// <summary>Whether what it did was taken back because a call before it acts more or less than it did. What comes after it in its
    /// round was then taken back too.</summary>
    internal bool IsTakenBack;

    /// <summary>What calls before it did at its tick, as it was last looked at.</summary>
    internal RuleTally Before;

    /// <summary>The same when it was made.</summary>
    internal RuleTally MadeAfter;

    /// <summary>Whether rules were not called for it, because there were too many calls in its tick.</summary>
    internal bool IsUnheard;

    /// <summary>How much of what it wanted to do at its own tick had no effect, because its rules had done there what they may.</summary>
    internal int Dropped;

    /// <summary>Whether it caused something at its own tick.</summary>
    internal bool Chains;

    /// <summary>The state that it was made with; null if it was not made.</summary>
    internal StateVersion? StateBefore;

    /// <summary>The state after it; the one before if it changed nothing.</summary>
    internal StateVersion? StateAfter;

    /// <summary>What it read.</summary>
    internal readonly List<RuleRead> Reads = new();

    /// <summary>What it did to bodies.</summary>
    internal List<RuleAct> Acts = new();

    /// <summary>What it told.</summary>
    internal List<RuleNotice> Notices = new();
}
