using System;
using System.Threading;
using LagSim.Hosting;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>An instant with many calls of rules costs what they do, and can be stopped within.</summary>
public sealed class RuleInstantTests
{
    private const int Timers = 200;

    /// <summary>Of two hundred timers that are due at one tick, the fiftieth asks for the end: no other is called.</summary>
    [Theory]
    [InlineData(50)]
    [InlineData(int.MaxValue)] // the control: nobody asks, and all are called
    public void AdvanceTo_CancelledWithinAnInstant_StopsThere(int which)
    {
        using CancellationTokenSource stop = new();
        int calls = 0;
        Scene scene = AtOnce(() =>
        {
            if (++calls == which)
            {
                stop.Cancel();
            }
        });
        Simulation world = new(scene, new SimulationOptions(default, SimDuration.MaxValue, cancellation: stop.Token));
        if (which > Timers)
        {
            world.AdvanceTo(At(1));
            Assert.Equal(Timers, calls);
            return;
        }

        Assert.Throws<OperationCanceledException>(() => world.AdvanceTo(At(1)));
        Assert.Equal(which, calls);
        Assert.Equal(At(0.25) - SimDuration.OneTick, world.SimulatedTo);
        Assert.Equal(Run(AtOnce(() => { }), 1).StateHash(world.SimulatedTo), world.StateHash(world.SimulatedTo));
        Assert.Throws<OperationCanceledException>(() => world.AdvanceTo(At(1))); // and not: it has faulted
    }

    /// <summary>The first instant is one of the world's making, which then is not made.</summary>
    [Fact]
    public void Simulation_CancelledWithinItsFirstInstant_IsNotMade()
    {
        using CancellationTokenSource stop = new();
        GivenRules rules = new() { Start = w => w.SetTimer(1, SimDuration.Zero), Timer = (_, _) => stop.Cancel() };
        Scene scene = new SceneBuilder("first").AddBody("ball", Ball(), V(0, 5)).WithRules(new GivenRules
        {
            Start = w =>
            {
                w.SetTimer(1, SimDuration.Zero);
                w.SetTimer(2, SimDuration.Zero);
            },
            Timer = rules.Timer,
        }).Build();
        Assert.Throws<OperationCanceledException>(() => new Simulation(scene, new SimulationOptions(cancellation: stop.Token)));
    }

    /// <summary>A step of a session's world that has done enough stops between two calls of one instant, and the next goes on.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Step_OfASessionsWorld_StopsWithinAnInstantOfCalls(bool waits)
    {
        int calls = 0;
        LiveWorld world = new(AtOnce(() => calls++), new SimulationOptions(history: SimDuration.FromSeconds(5)))
        {
            WaitsForLateEvents = waits,
            Work = new WorkLedger { MaxWorkPerStep = 300 },
        };
        int most = 0, steps = 0;
        do
        {
            int before = calls;
            world.Step(At(0.5));
            most = Math.Max(most, calls - before);
        }
        while (world.IsBehind && ++steps < 100);

        Assert.Equal(Timers, calls);
        Assert.Equal(waits ? 60 : Timers, most); // of 5 each
        Assert.Equal(Run(AtOnce(() => { }), 1).StateHash(At(0.5)), world.Simulation.StateHash(At(0.5)));
    }

    /// <summary>Rules that hear an instant with more impacts than they may be called for in one tick hear the first of them, and change nothing of
    /// how it ends.</summary>
    [Fact]
    public void Contacts_OfAnInstantWithMoreThanMayBeHeard_AreHeardUpToThatNumber()
    {
        int calls = 0;
        GivenRules hears = new() { Hears = (_, _, _) => true, Contact = (_, _) => calls++ };
        Assert.Equal(End(null), End(hears));
        Assert.InRange(calls, 1, RuleTally.MaxCalls);

        static string? End(GivenRules? rules)
        {
            SceneBuilder builder = new SceneBuilder("squeeze").WithGravity(Vector3D.Zero).AddPlane("wall", V(1), 0.0)
                .AddBody("light", new BodySpec(0.5, 1, 1), V(0.5)).AddBody("heavy", new BodySpec(0.5, 1e30, 1), V(4), V(-1));
            return Record.Exception(() => Run((rules is null ? builder : builder.WithRules(rules)).Build(), 3.1))?.Message;
        }
    }

    /// <summary>A heal in which an early call of a tick with many acts one more time takes each later call back once.</summary>
    [Fact]
    public void Heal_OfATickWithManyCalls_MakesEachAgainOnce()
    {
        Scene scene = new SceneBuilder("many").WithGravity(Floating).AddBody("ball", Ball(), V(0)).WithRules(new GivenRules
        {
            Start = w =>
            {
                for (int n = 0; n < Timers; n++)
                {
                    w.SetTimer(n, SimDuration.FromSeconds(0.25));
                }
            },
            Timer = (w, timer) =>
            {
                for (int n = 0; n < 1 + (timer == 0 ? w.State<GivenState>().Count : 0); n++)
                {
                    w.Impulse(First, V(1));
                }
            },
            Command = (w, _, _) => w.State<GivenState>().Count++,
        }).Build();
        Simulation late = Run(scene, 1);
        long before = late.Engine.Caller!.Made;
        late.Submit(Events.PlayerAction.Command(new Events.GameCommand(1)).Stamp(At(0.1), 1, 1));
        late.AdvanceTo(At(1));
        Assert.Equal(Timers + 1, late.Engine.Caller.Made - before);
        Assert.Equal(V(Timers + 1), Read(late, First, 1).Velocity);
    }

    private static Scene AtOnce(Action call) => new SceneBuilder("at once").WithGravity(Floating).AddBody("ball", Ball(), V(0)).WithRules(new GivenRules
    {
        Start = w =>
        {
            for (int n = 0; n < Timers; n++)
            {
                w.SetTimer(n, SimDuration.FromSeconds(0.25));
            }
        },
        Timer = (w, _) =>
        {
            call();
            w.State<GivenState>().Count++;
        },
    }).Build();
}
