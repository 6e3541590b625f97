using System;
using System.Diagnostics;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Harness.Experiments.Peers;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Verification.Fuzz;

/// <summary>
/// A host and a client over real UDP sockets that can be flooded while they act, and a second client, the newcomer, that joins meanwhile.
/// </summary>
internal sealed class FloodedSession : IDisposable
{
    private static readonly TimeSpan Timeout = TimeSpan.FromSeconds(20);

    private readonly HostIdentity? identity; // null in a session without protection
    private readonly UdpPort newcomerPort = Open();
    private readonly ClientOptions joining;
    private readonly PeerThread host;
    private readonly PeerThread client;
    private PeerThread? newcomer;
    private long joinBegan;

    /// <param name="seed">The seed of what the ports replay.</param>
    /// <param name="isProtected">Whether the session is protected.</param>
    /// <param name="between">Makes a wrapper between a session and its port.</param>
    internal FloodedSession(ulong seed, bool isProtected, Func<IDatagramPort, IDatagramPort> between)
    {
        HostPort = new TappedPort(between(Open()), seed);
        ClientPort = new TappedPort(between(Open()), seed + 1);
        Scene scene = new SceneBuilder("flood").WithSmallestRadius(0.25)
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0.9)
            .AddBody("ball", new BodySpec(0.3, 1, 0.9), new Vector3D(0, 3, 0))
            .Build();
        identity = isProtected ? HostIdentity.Draw() : null;
        HostOptions options = new()
        {
            ConnectKey = "flood",
            PlayerBudget = null,
            ExtraHistory = SimDuration.FromSeconds(5),
            MaxClientsPerAddress = 2,
        };
        (HostOptions hosting, joining) = ProtectedOptions.Of(options, identity);
        HostSession session = new(scene, HostPort, new StopwatchClock(), hosting, (ulong)Stopwatch.GetTimestamp());
        host = new PeerThread(session, HostPort, "LagSim flooded host");
        client = Client(ClientPort, "LagSim flooded client");
    }

    internal TappedPort HostPort { get; }

    internal TappedPort ClientPort { get; }

    /// <summary>The number of events that the two made.</summary>
    internal long EventsDone { get; private set; }

    /// <summary>How long the newcomer took to join, in seconds; null while it is not in.</summary>
    internal double? JoinSeconds { get; private set; }

    /// <summary>The furthest that shared time ran ahead of a world, in milliseconds.</summary>
    internal double MaxLatenessMilliseconds =>
        Math.Max(host.Session.World!.MaxLateness.ToMilliseconds(), client.Session.World!.MaxLateness.ToMilliseconds());

    /// <inheritdoc/>
    public void Dispose()
    {
        newcomer?.Dispose();
        client.Dispose();
        host.Dispose();
        newcomerPort.Dispose();
        ClientPort.Dispose();
        HostPort.Dispose();
        identity?.Dispose();
    }

    /// <summary>Starts host and client. Returns a sentence if they do not come together.</summary>
    internal string? Start()
    {
        host.Start();
        client.Start();
        return host.WaitUntilRunning(Timeout) && client.WaitUntilRunning(Timeout)
            ? null
            : client.Session.EndReason ?? "The two did not come together.";
    }

    /// <summary>Host and client act in turns.</summary>
    internal void Act()
    {
        _ = (EventsDone++ % 2 == 0 ? host : client).Do(PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 0.5, 0)));
    }

    /// <summary>Starts the newcomer the first time, and then looks whether it is in.</summary>
    internal void TendNewcomer()
    {
        if (newcomer is null)
        {
            newcomer = Client(newcomerPort, "LagSim client in a flood");
            joinBegan = Stopwatch.GetTimestamp();
            newcomer.Start();
        }
        else if (JoinSeconds is null && newcomer.State == SessionState.Running)
        {
            JoinSeconds = Stopwatch.GetElapsedTime(joinBegan).TotalSeconds;
        }
    }

    /// <summary>How long the newcomer has waited, in seconds; 0 if it is in, or has not begun.</summary>
    internal double WaitedSeconds =>
        newcomer is null || JoinSeconds is not null ? 0 : Stopwatch.GetElapsedTime(joinBegan).TotalSeconds;

    /// <summary>Waits until all are in and have the same world. Returns a sentence for a failure.</summary>
    internal string? Settle()
    {
        for (long began = Stopwatch.GetTimestamp(); Stopwatch.GetElapsedTime(began) < Timeout; Thread.Sleep(10))
        {
            TendNewcomer();
            PeerThread[] peers = [host, client, newcomer!];
            if (Array.Exists(peers, peer => peer.State == SessionState.Ended))
            {
                break;
            }

            bool haveAll = Array.TrueForAll([host, client], peer => Ask(peer, s => s.Counters.EventsAccepted) == EventsDone);
            if (haveAll && JoinSeconds is not null && HaveTheSameWorld(peers))
            {
                return null;
            }
        }

        return $"After the flood host, client and newcomer are not in one world: {Words(host)}, {Words(client)}, {Words(newcomer!)}.";
    }

    /// <summary>The counters of host and client.</summary>
    internal (SessionCounters Host, SessionCounters Client) Counters() =>
        (Ask(host, s => s.Counters.Copy()), Ask(client, s => s.Counters.Copy()));

    private static bool HaveTheSameWorld(PeerThread[] peers)
    {
        SimTime then = peers[0].Session.SharedTime.Now - SimDuration.FromMilliseconds(500);
        foreach (PeerThread peer in peers)
        {
            then = SimTime.Max(then, peer.Session.World!.Simulation.Start);
        }

        ulong[] hashes = Array.ConvertAll(peers, peer => Ask(peer, s => s.World!.Simulation.StateHash(then)));
        return Array.TrueForAll(hashes, hash => hash == hashes[0]);
    }

    private static string Words(PeerThread peer) =>
        peer.Session.EndReason is string reason ? $"{peer.State} ({reason})" : peer.State.ToString();

    private static UdpPort Open() => new(new IPEndPoint(IPAddress.Loopback, 0));

    private static T Ask<T>(PeerThread peer, Func<Session, T> question)
    {
        Task<T> answer = peer.Ask(question);
        return answer.Wait(Timeout)
            ? answer.Result
            : throw new PeerGroupException($"A peer did not answer within {Timeout.TotalSeconds} s.");
    }

    private PeerThread Client(IDatagramPort port, string name)
    {
        ClientSession session = new(null, port, new StopwatchClock(), joining, HostPort.LocalAddress, (ulong)Stopwatch.GetTimestamp());
        return new PeerThread(session, port, name);
    }
}
