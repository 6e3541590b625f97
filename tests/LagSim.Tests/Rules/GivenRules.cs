using System;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Tests.Rules;

/// <summary>Rules of functions.</summary>
internal sealed class GivenRules : GameRules
{
    internal GivenRules(bool bodies = false, bool isSkipping = false)
        : base("given", 1)
    {
        if (isSkipping)
        {
            WithFailedCommandsSkipped();
        }

        WithWorldState<GivenState>();
        if (bodies)
        {
            WithBodyState<GivenState>();
        }
    }

    internal Action<RuleWorld>? Start { get; init; }

    internal Action<RuleWorld, int>? Timer { get; init; }

    internal Action<RuleWorld, byte, GameCommand>? Command { get; init; }

    internal Func<BodyId, BodyId, int, bool>? Hears { get; init; }

    internal Action<RuleWorld, RuleContact>? Contact { get; init; }

    internal Func<BodyId, int, bool>? HearsSensor { get; init; }

    internal Action<RuleWorld, Crossing>? Crossed { get; init; }

    internal Action<RuleWorld, BodyId>? Spawned { get; init; }

    internal Action<RuleWorld, BodyId>? Removed { get; init; }

    internal Action<RuleWorld, PlayerEvent>? Player { get; init; }

    internal bool HearsAll { get; init; }

    internal Func<bool>? AskedForBodies { get; init; }

    public override bool HearsBodies => HearsAll && AskedForBodies?.Invoke() != false;

    public override bool HearsPlayers => Player is not null;

    public override bool HearsContact(BodyId first, BodyId second, int surface) => Hears?.Invoke(first, second, surface) == true;

    public override bool HearsCrossing(BodyId body, int sensor) => HearsSensor?.Invoke(body, sensor) == true;

    public override void OnCrossing(RuleWorld world, in Crossing crossing) => Crossed?.Invoke(world, crossing);

    public override void OnStart(RuleWorld world) => Start?.Invoke(world);

    public override void OnTimer(RuleWorld world, int timer) => Timer?.Invoke(world, timer);

    public override void OnCommand(RuleWorld world, byte player, GameCommand command) => Command?.Invoke(world, player, command);

    public override void OnPlayer(RuleWorld world, PlayerEvent player) => Player?.Invoke(world, player);

    public override void OnContact(RuleWorld world, in RuleContact contact) => Contact?.Invoke(world, contact);

    public override void OnSpawned(RuleWorld world, BodyId body) => Spawned?.Invoke(world, body);

    public override void OnRemoved(RuleWorld world, BodyId body) => Removed?.Invoke(world, body);
}
