using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>What rules hear of: asks them, for each event that they can hear.</summary>
internal sealed class RuleHearing(GameRules rules)
{
    /// <summary>The rules.</summary>
    internal GameRules Rules => rules;

    /// <summary>Knows which method of the rules is called; null if nobody looks.</summary>
    internal RunningRuleCall? Running { get; set; }

    /// <summary>Whether they hear a contact of an impact.</summary>
    internal bool Hears(in EventKey impact, in ImpactContact contact)
    {
        Running?.Begin(rules, nameof(GameRules.HearsContact), impact);
        bool hears = false;
        Exception? failure = null;
        try
        {
            hears = rules.HearsContact(contact.First, contact.Second, contact.Surface);
        }
        catch (Exception thrown)
        {
            failure = thrown;
        }

        return Ended(hears, failure, nameof(GameRules.HearsContact), impact);
    }

    /// <summary>Whether they hear a crossing of a sensor.</summary>
    internal bool Hears(in Crossing crossing)
    {
        Running?.Begin(rules, nameof(GameRules.HearsCrossing), crossing.Key);
        bool hears = false;
        Exception? failure = null;
        try
        {
            hears = rules.HearsCrossing(crossing.Body, crossing.Sensor);
        }
        catch (Exception thrown)
        {
            failure = thrown;
        }

        return Ended(hears, failure, nameof(GameRules.HearsCrossing), crossing.Key);
    }

    /// <summary>Whether a call is due for what opened a segment of a body, or ended there: it appears or disappears.</summary>
    internal bool Hears(BodyId body, in EventKey key) =>
        key.Kind is EventKind.Spawn or EventKind.Remove && key.Body == body && (rules.HearsBodies || rules.BodyBytes > 0);

    private bool Ended(bool hears, Exception? failure, string method, in EventKey key)
    {
        Running?.End(); // throws if the call was given up, whatever came of it
        return failure is null ? hears : throw new InstantException(
            $"The rules '{rules}' failed at {key.Time.ToShortString()} in {method} for {key}: {failure.Message}", key.Time, failure);
    }
}
