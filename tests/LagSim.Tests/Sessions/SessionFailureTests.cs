using System;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Rules;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>A session that a game's own code ends has its exception, with the stack; one that ends for another reason has none.</summary>
public sealed class SessionFailureTests
{
    [Fact]
    public void Failure_OfRulesThatThrow_HasTheirStack()
    {
        SessionGroup group = Begun(w => w.SetTimer(1, SimDuration.FromSeconds(1)));
        Assert.Null(group.Host.Failure);
        group.Run(8); // the world waits for late events first
        Assert.Equal((SessionState.Ended, SessionEnd.Failed), (group.Host.State, group.Host.EndedBy));
        InvalidOperationException thrown = Assert.IsType<InvalidOperationException>(group.Host.Failure!.GetBaseException());
        Assert.Contains(nameof(ThrowOfTheGame), thrown.StackTrace, StringComparison.Ordinal);
        Assert.EndsWith(group.Host.Failure.Message, group.Host.EndReason, StringComparison.Ordinal);
    }

    [Fact]
    public void Failure_OfASessionThatIsStopped_IsNone()
    {
        SessionGroup group = Begun(_ => { });
        group.Run(1);
        group.Host.Leave();
        Assert.Equal(SessionState.Ended, group.Host.State);
        Assert.Null(group.Host.Failure);
    }

    private static SessionGroup Begun(Action<LagSim.Rules.RuleWorld> start)
    {
        GivenRules rules = new() { Start = start, Timer = (_, _) => ThrowOfTheGame() };
        Scene scene = new SceneBuilder("thrown").AddPlane("floor", Vector3D.Up, V(0)).AddBody("ball", Ball(), V(0, 3)).WithRules(rules).Build();
        SessionGroup group = new(scene, 2, LinkProfiles.Lan, options: _ => new ClientOptions { Rules = [rules] });
        group.Connect();
        return group;
    }

    private static void ThrowOfTheGame() => throw new InvalidOperationException("broken");
}
