using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>What rules hear of: asks them, for each event that they can hear.</summary>
internal sealed class RuleHearing(Scene scene)
{
    private readonly GameRules rules = (GameRules)scene.Rules!;

    /// <summary>Knows which method of the rules is called; null if nobody looks.</summary>
    internal RunningRuleCall? Running { get; set; }

    /// <summary>Whether they hear a contact of an impact.</summary>
    internal bool Hears(in EventKey impact, in ImpactContact contact)
    {
        Running?.Begin(scene, nameof(GameRules.HearsContact), impact, new RuleTrigger(contact));
        try
        {
            return rules.HearsContact(contact.First, contact.Second, contact.Surface);
        }
        catch (Exception failure)
        {
            throw Failed(nameof(GameRules.HearsContact), impact, new RuleTrigger(contact), failure);
        }
        finally
        {
            Running?.End(); // throws if the call was given up, whatever came of it
        }
    }

    /// <summary>Whether they hear a crossing of a sensor.</summary>
    internal bool Hears(in Crossing crossing)
    {
        Running?.Begin(scene, nameof(GameRules.HearsCrossing), crossing.Key, new RuleTrigger(crossing.Entered));
        try
        {
            return rules.HearsCrossing(crossing.Body, crossing.Sensor);
        }
        catch (Exception failure)
        {
            throw Failed(nameof(GameRules.HearsCrossing), crossing.Key, new RuleTrigger(crossing.Entered), failure);
        }
        finally
        {
            Running?.End(); // throws if the call was given up, whatever came of it
        }
    }

    /// <summary>Whether a call is due for what opened a segment of a body, or ended there: it appears or disappears.</summary>
    internal bool Hears(BodyId body, in EventKey key)
    {
        if (key.Kind is not (EventKind.Spawn or EventKind.Remove or EventKind.Lost) || key.Body != body)
        {
            return false;
        }

        try
        {
            return rules.HearsBodies || rules.BodyBytes > 0;
        }
        catch (Exception failure)
        {
            throw Failed(nameof(GameRules.HearsBodies), key, default, failure);
        }
    }

    private InstantException Failed(string method, in EventKey key, in RuleTrigger trigger, Exception failure) =>
        new(RuleCallText.Failed(scene, method, key, trigger, failure.Message), key.Time, failure);
}
