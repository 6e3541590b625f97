using System;
using System.Diagnostics.CodeAnalysis;
using System.Reflection;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>Finds rules with a method that nothing calls, since they do not say that they hear what it is for.</summary>
/// <remarks>A method that trimming or stripping took away counts as not overridden, so such a program loses the sentence and nothing else.</remarks>
internal static class UnheardRules
{
    private static readonly Type[] OfContact = [typeof(BodyId), typeof(BodyId), typeof(int)];
    private static readonly Type[] OfCrossing = [typeof(BodyId), typeof(int)];
    private static readonly Type[] OfBody = [typeof(RuleWorld), typeof(BodyId)];
    private static readonly Type[] OfPlayer = [typeof(RuleWorld), typeof(PlayerEvent)];
    private static readonly Type[] OfLoss = [typeof(RuleWorld), typeof(BodyId), typeof(LossReason)];

    /// <summary>What is wrong with rules of a type, as the rest of a sentence; null if nothing is.</summary>
    internal static string? Problem([DynamicallyAccessedMembers(DynamicallyAccessedMemberTypes.PublicMethods)] Type rules)
    {
        bool hearsBodies = Overrides(rules, "get_" + nameof(GameRules.HearsBodies), Type.EmptyTypes);
        return Lacks(
                nameof(GameRules.OnContact), [typeof(RuleWorld), typeof(RuleContact).MakeByRefType()],
                nameof(GameRules.HearsContact), Overrides(rules, nameof(GameRules.HearsContact), OfContact))
            ?? Lacks(
                nameof(GameRules.OnCrossing), [typeof(RuleWorld), typeof(Crossing).MakeByRefType()],
                nameof(GameRules.HearsCrossing), Overrides(rules, nameof(GameRules.HearsCrossing), OfCrossing))
            ?? Lacks(nameof(GameRules.OnSpawned), OfBody, nameof(GameRules.HearsBodies), hearsBodies)
            ?? Lacks(nameof(GameRules.OnRemoved), OfBody, nameof(GameRules.HearsBodies), hearsBodies)
            ?? Lacks(nameof(GameRules.OnLost), OfLoss, nameof(GameRules.HearsBodies), hearsBodies)
            ?? Lacks(
                nameof(GameRules.OnPlayer), OfPlayer, nameof(SceneRules.HearsPlayers),
                Overrides(rules, "get_" + nameof(SceneRules.HearsPlayers), Type.EmptyTypes));

        string? Lacks(string called, Type[] parameters, string asked, bool hears) =>
            !hears && Overrides(rules, called, parameters) ? $"override {called} but not {asked}, so it would never be called: override {asked} too" : null;
    }

    // A method of the same name that hides the base's is none: the world calls the base's.
    private static bool Overrides([DynamicallyAccessedMembers(DynamicallyAccessedMemberTypes.PublicMethods)] Type rules, string method, Type[] parameters) =>
        rules.GetMethod(method, parameters) is MethodInfo found
            && !IsBase(found.DeclaringType) && IsBase(found.GetBaseDefinition().DeclaringType);

    private static bool IsBase(Type? type) => type == typeof(GameRules) || type == typeof(SceneRules);
}
