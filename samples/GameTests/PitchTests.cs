using LagSim;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Testing.Links;
using Xunit;

/// <summary>The game of Pitch.cs under lag: real sessions, simulated links, virtual time.</summary>
public sealed class PitchTests
{
    public static TheoryData<string> Links => [.. LinkProfiles.Names];

    [Theory]
    [MemberData(nameof(Links))]
    public void Ball_KickedByBothPlayers_IsInTheSamePlaceForAll(string link)
    {
        Scene scene = Pitch.Build();
        BodyId ball = scene.BodyNamed("ball");
        SessionTestResult result = new SessionTest(scene)
            .WithOptions(player => Pitch.Options())
            .WithClients(2, link)
            .At(1.0, player: 1, PlayerAction.Impulse(ball, new Vector3D(2, 1, 0)))
            .At(1.1, player: 2, PlayerAction.Impulse(ball, new Vector3D(-1, 1, 1)))
            .Run(seconds: 4, TestContext.Current.CancellationToken);
        Assert.Equal(2, result.EventsAccepted);
        Assert.InRange(result.StateOf(ball).Position.X, -5, 5);
    }

    [Fact]
    public void Bots_ThatPlayForAMinute_Agree()
    {
        Scene scene = Pitch.Build();
        BodyId ball = scene.BodyNamed("ball");
        SessionTestResult result = new SessionTest(scene)
            .WithOptions(player => Pitch.Options())
            .WithClients(1, "wifi-busy")
            .WithLateClient(seconds: 20, "4g")
            .Every(0.5, player: 1, me => PushTo(me, ball, new Vector3D(4, 0, 0)))
            .Every(0.5, player: 2, me => PushTo(me, ball, new Vector3D(-4, 0, 0)))
            .Run(seconds: 60, TestContext.Current.CancellationToken);
        Assert.True(result.LateEvents > 200, result.ToString());
        Assert.True(result.BytesSent < 1_000_000, result.ToString());
    }

    [Fact]
    public void Ball_OverALinkOfOurOwn_IsInTheSamePlaceForAll()
    {
        Scene scene = Pitch.Build();
        LinkProfile hotel = new("hotel", new LinkLeg(delayMilliseconds: 60, jitterMilliseconds: 20, lossPercent: 3, meanBurstLength: 4));
        new SessionTest(scene)
            .WithClients(1, hotel)
            .At(1.0, player: 1, PlayerAction.Impulse(scene.BodyNamed("ball"), new Vector3D(2, 1, 0)))
            .Run(seconds: 3, TestContext.Current.CancellationToken);
    }

    [Fact]
    public void Wind_ThatIsNotTheSameForAll_IsCaught()
    {
        Scene scene = new SceneBuilder("leaf")
            .AddForce(Force.Supplied(new Wind(1.0)), out ForceSet wind)
            .AddBody("leaf", new BodySpec(radius: 0.1, mass: 0.1, restitution: 0.5, forces: wind), position: new Vector3D(0, 5, 0))
            .Build();
        SessionTest test = new SessionTest(scene)
            .WithOptions(player => new ClientOptions { Accelerations = [new Wind(player == 1 ? 1.0001 : 1.0)] })
            .WithClients(1, "lan");
        WorldsDifferException thrown =
            Assert.Throws<WorldsDifferException>(() => test.Run(seconds: 3, TestContext.Current.CancellationToken));
        Assert.Contains("body 'leaf'", thrown.Message);
    }

    private static void PushTo(TestPlayer me, BodyId ball, Vector3D goal)
    {
        if (me.TryRead(ball, out BodyState seen))
        {
            me.Do(PlayerAction.Impulse(ball, (goal - seen.Position) * 0.2));
        }
    }

    private sealed class Wind(double strength) : IAcceleration
    {
        public string Name => "wind";

        public int Version => 1;

        public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => new(strength, 0, 0);
    }
}
