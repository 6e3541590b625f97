using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>Calls of rules in words, by the names of the scene: for the sentence that says which of them failed.</summary>
internal static class RuleCallText
{
    /// <summary>The method that rules are called by for an event of a kind.</summary>
    internal static string Method(EventKind kind) => kind switch
    {
        EventKind.Start => nameof(GameRules.OnStart),
        EventKind.Command => nameof(GameRules.OnCommand),
        EventKind.Player => nameof(GameRules.OnPlayer),
        EventKind.Timer => nameof(GameRules.OnTimer),
        EventKind.Impact => nameof(GameRules.OnContact),
        EventKind.Crossing => nameof(GameRules.OnCrossing),
        EventKind.Spawn => nameof(GameRules.OnSpawned),
        EventKind.Lost => nameof(GameRules.OnLost),
        _ => nameof(GameRules.OnRemoved),
    };

    /// <summary>A sentence of rules that failed: which, when, in which method, what it was called for and why.</summary>
    internal static string Failed(Scene scene, string method, in EventKey key, in RuleTrigger trigger, string why) => FormattableString.Invariant(
        $"The rules '{scene.Rules}' failed at {key.Time.ToShortString()}, round {key.Round}, in {method}{What(scene, key, trigger)}: {why}{(why.EndsWith('.') ? "" : ".")}");

    /// <summary>The same of rules that did not fail.</summary>
    internal static string Of(Scene scene, string method, in EventKey key, in RuleTrigger trigger) => FormattableString.Invariant(
        $"At {key.Time.ToShortString()}, round {key.Round}, the rules '{scene.Rules}' in {method}{What(scene, key, trigger)}");

    private static string What(Scene scene, in EventKey key, in RuleTrigger trigger) => key.Kind switch
    {
        EventKind.Start => "",
        EventKind.Command => $" for command {trigger.Command!.Number} of peer {key.Peer}",
        EventKind.Player => $" for {trigger.Player}",
        EventKind.Timer => $" for timer {unchecked((int)key.Sequence)}",
        EventKind.Impact => $" for {scene.Describe(trigger.Contact.First)} and {Other(scene, trigger.Contact)}",
        EventKind.Crossing =>
            $" for {scene.Describe(key.Body)}, which {(trigger.Entered ? "enters" : "leaves")}"
                + $" '{scene.SensorArray[unchecked((int)key.Sequence)].Name}'",
        _ => $" for {scene.Describe(key.Body)}",
    };

    private static string Other(Scene scene, in ImpactContact contact) => contact.Surface switch
    {
        ImpactContact.NoSurface => scene.Describe(contact.Second),
        int n when scene.Surfaces.IsPlane(n) => $"plane '{scene.Surfaces.Plane(n).Name}'",
        int n => $"static sphere '{scene.Surfaces.Sphere(n).Name}'",
    };
}
