using System;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>A world that asks for more than the machine can do falls behind; the session it is in does not.</summary>
public sealed class OverloadTests
{
    [Fact]
    public void Step_WorldFarBehind_StillServesThePort()
    {
        SessionGroup group = new SessionGroup(Gap(), 3, LinkProfiles.PureDelay(5), 1, _ => Options()).Connect();
        group.BusyMilliseconds = 250;
        group.Do(1, PlayerAction.SetVelocity(First, V(1_000)));
        group.Run(20); // twice the time-out
        Assert.All(group.Sessions, s =>
        {
            Assert.Equal(SessionState.Running, s.State);
            Assert.True(s.World!.IsBehind);
            Assert.True(s.SharedTime.Now - s.World.Simulation.SimulatedTo > SimDuration.FromSeconds(15));
            Assert.True(s.World.RenderSnapshots.Latest().To < s.SharedTime.Now);
            Assert.True(s.World.LateSteps > 50);
        });

        // a connect request is answered, what is done is validated, and heard by the others.
        SimTime asked = group.Clock.Now;
        ClientSession late = group.Join(7, 77, ClientOptions.From(Options()));
        Assert.True(group.RunUntil(() => late.Scene is not null, 3), $"{group.Clock.Now - asked}");
        ExternalEvent action = group.Do(2, PlayerAction.SetVelocity(Second, V(0, 0, 1)));
        Assert.True(group.RunUntil(() => group.Accepted.Contains(action) && group.Sessions[1].LogLength == group.Host.LogLength, 1));
    }

    [Fact]
    public void Step_WorldThatFellBehindForAWhile_AgreesOnceItIsThereAgain()
    {
        SessionGroup group = new SessionGroup(Gap(), 3, LinkProfiles.PureDelay(5), 1, _ => Options(0.1)).Connect();
        group.Run(0.5);
        group.BusyMilliseconds = 10;
        Assert.All(group.Sessions, Weaken);
        group.Do(1, PlayerAction.SetVelocity(First, V(100)));
        group.Run(0.2);
        Assert.All(group.Sessions, s => Assert.True(s.World!.IsBehind));
        group.Do(2, PlayerAction.Impulse(Second, V(0, 0, 3)));
        ClientSession late = group.Join(7, 77, ClientOptions.From(Options(0.1)));
        late.Begun += () => Weaken(late);
        Assert.True(group.RunUntil(() => late.World is not null, 3));
        group.Do(0, PlayerAction.SetVelocity(First, V(0)));
        Assert.True(group.RunUntil(() => group.Sessions.All(s => !s.World!.IsBehind && s.State == SessionState.Running), 20));
        Assert.True(group.Settle(3));
        group.Run(2.5);
        Assert.Null(group.Difference());
        Assert.All(group.Sessions, s => Assert.Equal((0, 0), (s.Counters.EventsLost, s.Counters.StatesDiffered)));
        Assert.All(group.Sessions.Skip(1), s => Assert.True(s.Counters.StatesAgreed > 0));
        Assert.NotNull(group.Difference(group.Alone(group.Accepted.Take(2)))); // the last event would have shown
    }

    [Fact]
    public void Start_LongAgoWithoutAState_EndsTheClientWithASentence()
    {
        SessionGroup group = Forged(SimDuration.FromSeconds(10 * 86_400));
        group.Run(0.1);
        Assert.Equal(SessionState.Ended, group.Sessions[1].State);
        Assert.StartsWith("The host says that the session began 864000 s ago and sent no state of it", group.Sessions[1].EndReason, StringComparison.Ordinal);
        Assert.Null(group.Sessions[1].World);
    }

    [Fact]
    public void Start_AsLongAgoAsItMayBe_IsSimulatedAndNothingIsForgottenWithoutAWatermark()
    {
        // Silent from then on: whatever happened meanwhile may still be told.
        SessionGroup group = Forged(SimDuration.FromSeconds(9), Gap(900));
        group.BusyMilliseconds = 250;
        Assert.True(group.RunUntil(() => group.Sessions[1].World is not null, 0.1));
        Simulation world = group.Sessions[1].World!.Simulation;
        group.Run(4);
        Assert.True(group.Sessions[1].World!.IsBehind);
        group.Run(4);
        Assert.Equal(SessionState.Running, group.Sessions[1].State);
        Assert.True(world.SimulatedTo > world.Start + SimDuration.FromSeconds(0.001));
        Assert.Equal(world.Start, world.HistoryEdge);
        Assert.NotEqual(SubmitResult.TooOld, world.Submit(ExternalEvent.Remove(world.Start, 0, 1, Second)));
    }

    /// <summary>A client that waits for the start and is told, in the host's name, that it was that long ago; the host says no more.</summary>
    private static SessionGroup Forged(SimDuration ago, Scene? scene = null)
    {
        SessionGroup group = new(scene ?? Gap(), 2, LinkProfiles.PureDelay(5), 3, _ => Options(), expected: 2) { IsTapped = false };
        UpdateDatagram heard = new();
        ulong session = 0;
        SimTime sent = default;
        bool speaks = false;
        group.Network.Lose((from, to, datagram) =>
        {
            if (from == 0 && !speaks && heard.TryDecode(datagram.Span, out _))
            {
                (session, sent) = (heard.SessionId, heard.Sent);
            }

            return from == 0 && speaks && datagram.Span[4 + 8 + 1] != 0xFF;
        });
        Assert.True(group.RunUntil(() => group.Sessions[1].State == SessionState.Waiting, 5));
        speaks = true;
        UpdateDatagram forged = new() { SessionId = session, Number = 0xFF, Sent = sent, Start = sent - ago };
        byte[] bytes = new byte[WireFormat.MaxBytes];
        group.Ports[0].Send(bytes.AsSpan(0, forged.Encode(bytes)), PeerAddress.Virtual(1));
        return group;
    }

    /// <summary>So little a step that the tests need not simulate much to fall behind: 200 events.</summary>
    private static void Weaken(Session session) => session.World!.Effort = 10 * 200;

    private static HostOptions Options(double interval = 1) => new()
    {
        CommitInterval = SimDuration.FromSeconds(interval),
        ExtraHistory = interval < 1 ? SimDuration.FromSeconds(30) : SimDuration.Zero,
    };

    /// <summary>A ball in a gap of 2 mm, which at 1,000 m/s asks for 500,000 impacts a second, and another beside it.</summary>
    private static Scene Gap(double speed = 0) => new SceneBuilder("gap").WithGravity(Vector3D.Zero)
        .AddPlane("west", V(1), V(-0.501), 1).AddPlane("east", V(-1), V(0.501), 1)
        .AddBody("rattler", Ball(), V(0), V(speed)).AddBody("other", Ball(), V(0, 5), V(0, 0.1)).Build();
}
