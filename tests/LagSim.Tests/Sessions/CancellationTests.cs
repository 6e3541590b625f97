using System;
using System.Threading;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>A session that is asked to stop does, in the middle of a world that would keep it for hours.</summary>
public sealed class CancellationTests
{
    /// <summary>A ball that rattles in a gap of a millimetre at 1e6 m/s: 1e9 impacts a second.</summary>
    private static readonly Scene Rattle = new SceneBuilder("rattle").WithGravity(Floating)
        .AddPlane("floor", V(0, 1), V(0), 1).AddPlane("ceiling", V(0, -1), V(0, 1.001), 1).AddBody("ball", Ball(), V(0, 0.5005), V(0, 1e6)).Build();

    [Fact]
    public void Step_AskedToStopInTheMiddleOfALongSimulation_EndsBetweenTwoInstants()
    {
        using CancellationTokenSource stop = new();
        SessionGroup group = new(Rattle, 1, LinkProfiles.PureDelay(0), options: _ => new HostOptions { Cancellation = stop.Token, MaxGivenSpeed = double.PositiveInfinity });
        StopAt limit = new(100_000, stop);
        group.Host.Begun += () => group.Host.World!.Simulation.Engine.Reconvergence.Observer = limit;
        Assert.Throws<OperationCanceledException>(() => group.Run(10));
        Assert.Equal(100_000, limit.Contacts);
        Assert.True(group.Host.World!.Simulation.SimulatedTo < group.Host.World.Simulation.Start + LagSim.Time.SimDuration.FromMilliseconds(1));

        // It does not go on by itself, and says goodbye when told to.
        Assert.NotEqual(SessionState.Ended, group.Host.State);
        Assert.Throws<OperationCanceledException>(() => group.Host.Step());
        Assert.Equal(100_000, limit.Contacts);
        group.Host.Leave();
        Assert.Equal((SessionState.Ended, SessionEnd.Left), (group.Host.State, group.Host.EndedBy));
        group.Host.Step();
    }

    [Fact]
    public void Rattle_LeftAlone_HasNoEnd()
    {
        // The control: what was stopped above would have gone on, a thousand times as long for a tenth of a second.
        long events = 100_000;
        Simulation alone = new(Rattle, new SimulationOptions());
        Assert.False(alone.TryAdvanceTo(At(10), ref events));
        Assert.True(alone.SimulatedTo < At(0.001), alone.SimulatedTo.ToShortString());
    }

    [Fact]
    public void Step_AskedToStopWhileNothingMoves_StopsToo_AndAnotherGoesOn()
    {
        using CancellationTokenSource stop = new();
        Scene still = new SceneBuilder("still").WithGravity(Floating).AddBody("ball", Ball(), V(0)).Build();
        SessionGroup group = new(still, 2, LinkProfiles.PureDelay(20), options: peer => new HostOptions { Cancellation = peer == 1 ? stop.Token : default });
        group.Connect();
        stop.Cancel();
        group.Host.Step();
        Assert.Throws<OperationCanceledException>(() => group.Client(1).Step());
        group.Client(1).Leave();
        group.Run(1);
        Assert.Equal((SessionState.Running, SessionState.Ended), (group.Host.State, group.Client(1).State));
    }

    private sealed class StopAt(int last, CancellationTokenSource stop) : IImpactObserver
    {
        internal int Contacts { get; private set; }

        public void OnContact(in EventKey impact, in ImpactContact contact)
        {
            if (++Contacts == last)
            {
                stop.Cancel();
            }
        }

        public void OnCut(in EventKey impact)
        {
        }
    }
}
