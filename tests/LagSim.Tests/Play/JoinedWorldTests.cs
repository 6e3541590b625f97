using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Play;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Play;

/// <summary>Peers of a host's air hockey as their pages have them, in virtual time: who comes back under another number, or to another
/// session.</summary>
public sealed class JoinedWorldTests
{
    private const double Frame = 1 / 60.0;

    private readonly VirtualRun run = new(7200, 1, CancellationToken.None);
    private readonly List<JoinedWorld> peers = [];
    private readonly HashSet<int> cutOff = []; // addresses from and to which everything is lost

    public JoinedWorldTests() => run.Network.Lose((from, to, _) => cutOff.Contains(from) || cutOff.Contains(to));

    [Fact]
    public void Draw_AfterItsPlaceWasTaken_SteersTheMalletOfItsNewNumber()
    {
        OpenHost();
        JoinedWorld ann = Join();
        RunUntil(() => ann.Player is not null);
        Assert.Equal((1, 0), (ann.Peer, ann.Player!.Number));
        SimTime start = ann.Session.World!.Simulation.Start;
        int version = ann.BodiesVersion;

        cutOff.Add(1);
        Run(4); // longer than the host's time-out
        JoinedWorld bob = Join();
        RunUntil(() => bob.Player is not null);
        Assert.Equal((1, 0), (bob.Peer, bob.Player!.Number)); // whose place is free
        cutOff.Clear();
        RunUntil(() => ann.Session is { State: SessionState.Running, Peer: 2 });
        Run(0.5);
        Assert.Equal(start, ann.Session.World!.Simulation.Start); // the control: it is the same session
        Assert.Equal((2, 1), (ann.Peer, ann.Player!.Number));
        Assert.NotEqual(version, ann.BodiesVersion); // which has the page describe it again

        (double X, double Y)[] before = Mallets(bob);
        ann.Player.Steer(0, 1);
        Run(0.3);
        ann.Player.Steer(0, 0);
        Run(1);
        (double X, double Y)[] after = Mallets(bob);
        Assert.True(after[1].Y > before[1].Y + 0.2, $"Its own mallet went from {before[1]} to {after[1]}.");
        Assert.Equal(before[0].Y, after[0].Y, 1e-3);
    }

    /// <summary>The control: who comes back as the same player goes on with what it had.</summary>
    [Fact]
    public void Draw_AfterAFreshCopyUnderTheSameNumber_KeepsItsPlayer()
    {
        OpenHost();
        JoinedWorld ann = Join();
        RunUntil(() => ann.Player is not null);
        AirHockeyPlayer player = ann.Player!;
        cutOff.Add(1);
        Run(4);
        cutOff.Clear();
        RunUntil(() => ann.Session.State == SessionState.Running);
        Run(0.5);
        Assert.Equal(1, ann.Session.Counters.Renewals);
        Assert.Same(player, ann.Player);
    }

    [Fact]
    public void TryTakeCommit_OfAFormerSession_IsDatedByItsOwnStart()
    {
        IDatagramPort port = OpenHost();
        JoinedWorld ann = Join();
        RunUntil(() => ann.Player is not null);
        Run(8);
        SimTime start = ann.Session.World!.Simulation.Start;
        port.Dispose();
        IDatagramPort again = run.Network.CreatePort(0);
        run.Steps.Replace(0, NewHost(again, 2), again);
        RunUntil(() => ann.Session.State == SessionState.Running && ann.Session.World!.Simulation.Start != start);
        Run(6);
        List<double> seconds = [];
        while (ann.TryTakeCommit(out double at, out _))
        {
            seconds.Add(at);
        }

        int second = seconds.FindIndex(1, at => at <= seconds[0]);
        Assert.True(second > 2, string.Join(", ", seconds)); // two sessions, of which each has states
        Assert.All([seconds[..second], seconds[second..]], of => Assert.Equal(of.Select((_, n) => of[0] + n), of));
        Assert.All(seconds, at => Assert.InRange(at, 0, 20));
    }

    [Fact]
    public void IsKeyWrong_OfOtherRefusals_IsFalse()
    {
        OpenHost(new HostOptions { ConnectKey = "right", SpectatorPlaces = 0, ExpectedClients = 1 });
        JoinedWorld wrong = Join(new ClientOptions { ConnectKey = "wrong" }), first = Join(new ClientOptions { ConnectKey = "right" });
        Assert.False(wrong.IsKeyWrong);
        RunUntil(() => wrong.HasEnded && first.Player is not null);
        JoinedWorld second = Join(new ClientOptions { ConnectKey = "right", Role = PeerRole.Spectator }); // for whom there is no place
        RunUntil(() => second.HasEnded);
        Assert.Equal((true, RefusalReason.WrongKey), (wrong.IsKeyWrong, wrong.Session.RefusedFor));
        Assert.Equal((false, RefusalReason.Full), (second.IsKeyWrong, second.Session.RefusedFor));
        Assert.Equal((false, null), (first.IsKeyWrong, first.Session.RefusedFor));
        Assert.All([wrong, second], refused => Assert.Equal(SessionEnd.Refused, refused.Session.EndedBy));
    }

    [Fact]
    public void Step_ThatThrows_EndsItWithTheReason()
    {
        OpenHost();
        JoinedWorld ann = Join();
        RunUntil(() => ann.Player is not null);
        Assert.Equal((false, null, null), (ann.HasEnded, ann.EndReason, ann.Failure));
        ann.Session.StateCommitted += _ => throw new NotSupportedException("Not so.");
        for (int n = 0; n < 600 && !ann.HasEnded; n++)
        {
            run.Network.DeliverUntil(run.Clock.Now + SimDuration.FromSeconds(Frame)); // a page steps its peer itself
            run.Steps.Sessions[0].Step();
            ann.Step();
        }

        Assert.True(ann.HasEnded);
        Assert.IsType<NotSupportedException>(ann.Failure);
        Assert.Equal("This peer cannot go on, by a mistake in its code. Not so.", ann.EndReason);
        Assert.Equal(SimDuration.FromSeconds(1), ann.Step());
    }

    [Fact]
    public void PresenceOf_WhoHasNeverBeenThere_IsNotAway()
    {
        OpenHost();
        JoinedWorld ann = Join();
        RunUntil(() => ann.Player is not null && ann.Session.Roster.Count == 2);
        Assert.Equal((PlayerPresence.Here, PlayerPresence.NotYet), Presences(ann));
        JoinedWorld bob = Join();
        RunUntil(() => bob.Player is not null && ann.Session.Roster.Count == 3);
        Assert.Equal((PlayerPresence.Here, PlayerPresence.Here), Presences(ann));
        bob.Dispose();
        RunUntil(() => ann.Session.Roster.Count == 2);
        Assert.Equal((PlayerPresence.Here, PlayerPresence.Away), Presences(ann));
    }

    private static (PlayerPresence First, PlayerPresence Second) Presences(JoinedWorld of) => (of.Board!.PresenceOf(0), of.Board.PresenceOf(1));

    private static (double X, double Y)[] Mallets(JoinedWorld of) => [of.Bodies[1].Place, of.Bodies[2].Place];

    private IDatagramPort OpenHost(HostOptions? options = null)
    {
        IDatagramPort opened = null!;
        run.Open(0, null, 0, SimDuration.Zero, (port, _) => NewHost(opened = port, 1, options));
        return opened;
    }

    /// <summary>Nobody plays at it, one is enough to begin, and it keeps no place for who falls silent.</summary>
    private HostSession NewHost(IDatagramPort port, ulong number, HostOptions? options = null)
    {
        options = (options ?? new HostOptions { ExpectedClients = 1 }) with
        {
            Warmup = false,
            Timeout = SimDuration.FromSeconds(2),
            RejoinTime = SimDuration.Zero,
        };
        return new HostSession(AirHockeyGame.Build(2, 1, isDedicated: true), port, run.Clock, options, number);
    }

    private JoinedWorld Join(ClientOptions? asked = null)
    {
        ClientOptions options = (asked ?? new ClientOptions()) with
        {
            Warmup = false,
            Timeout = SimDuration.FromSeconds(2),
            RejoinTime = SimDuration.FromSeconds(60),
        };
        run.Open(peers.Count + 1, LinkProfiles.PureDelay(40), 0, SimDuration.Zero, (port, clock) =>
        {
            peers.Add(new JoinedWorld(port, VirtualRun.HostAddress, options, clock));
            return peers[^1].Session;
        });
        return peers[^1];
    }

    private void Run(double seconds)
    {
        for (int n = 0; n < seconds * 60; n++)
        {
            Advance();
        }
    }

    private void RunUntil(Func<bool> isMet)
    {
        for (int n = 0; n < 60 * 60 && !isMet(); n++)
        {
            Advance();
        }

        Assert.True(isMet(), string.Join("; ", peers.Select(peer => $"peer {peer.Session.Peer} is {peer.Session.State}. {peer.Session.EndReason}")));
    }

    private void Advance()
    {
        run.AdvanceTo(run.Clock.Now + SimDuration.FromSeconds(Frame));
        peers.ForEach(peer => peer.Draw(Frame));
    }
}
