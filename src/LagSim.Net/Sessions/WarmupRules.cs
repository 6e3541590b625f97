using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>The rules of the scene that <see cref="SessionWarmup"/> plays in: a command sets a timer, which pushes a ball, and
/// the rules are told who joins and who leaves.</summary>
internal sealed class WarmupRules : GameRules
{
    internal WarmupRules()
        : base("warm-up", 1) => WithWorldState<int>();

    /// <inheritdoc/>
    public override bool HearsContact(BodyId first, BodyId second, int surface) => surface == 0;

    /// <inheritdoc/>
    public override void OnContact(RuleWorld world, in RuleContact contact) => world.State<int>()++;

    /// <inheritdoc/>
    public override bool HearsPlayers => true;

    /// <inheritdoc/>
    public override void OnPlayer(RuleWorld world, PlayerEvent player) => world.State<int>()++;

    /// <inheritdoc/>
    public override void OnCommand(RuleWorld world, byte player, GameCommand command) => world.SetTimer(1, SimDuration.FromMilliseconds(10));

    /// <inheritdoc/>
    public override void OnTimer(RuleWorld world, int timer)
    {
        BodyId beside = BodyId.OfScene(WarmupScene.HostsBody + 2);
        world.Tell(timer);
        if (world.TryRead(beside, out BodyState state) && state.Velocity.Length < 1)
        {
            world.Impulse(beside, new Vector3D(0, world.RandomFraction(), 0));
        }
    }
}
