using System;
using System.Diagnostics;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Verification.Fuzz;

/// <summary>
/// A flood at full speed against a host and a client over real UDP sockets: a stranger sends garbage to both, and their own datagrams are
/// replayed.
/// </summary>
public static class RealFlood
{
    /// <summary>
    /// The allowed growth of the memory in use from the flood's first fifth to its end. The two sessions keep six seconds of a world of one
    /// ball. The contents of carriers and memory just released by their threads vary by up to 4 MB between measurements. Keeping 200 bytes
    /// for each of the 100,000 datagrams that ten seconds bring in on a slow machine would take 16 MB, and so would 1 kB for each of
    /// 20,000.
    /// </summary>
    private const long MaxGrowth = 12_000_000;

    private static readonly TimeSpan Timeout = TimeSpan.FromSeconds(20);

    /// <summary>Floods until either limit is reached.</summary>
    /// <param name="seconds">The longest duration, in seconds, above zero.</param>
    /// <param name="packets">The most datagrams, at least 1.</param>
    /// <param name="seed">The seed of the garbage.</param>
    /// <param name="progress">Called from time to time with the seconds passed; may be null.</param>
    /// <param name="cancellation">Ends it.</param>
    public static FloodReport Run(double seconds, long packets, ulong seed, Action<double>? progress, CancellationToken cancellation) =>
        Run(seconds, packets, seed, progress, static port => port, cancellation);

    /// <summary>The same, with a wrapper between each session and its port.</summary>
    internal static FloodReport Run(
        double seconds, long packets, ulong seed, Action<double>? progress, Func<IDatagramPort, IDatagramPort> between, CancellationToken cancellation)
    {
        ArgumentOutOfRangeException.ThrowIfLessThanOrEqual(seconds, 0);
        ArgumentOutOfRangeException.ThrowIfLessThan(packets, 1);
        Scene scene = new SceneBuilder("flood").WithSmallestRadius(0.25)
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0.9)
            .AddBody("ball", new BodySpec(0.3, 1, 0.9), new Vector3D(0, 3, 0))
            .Build();
        using TappedPort hostPort = new(between(new UdpPort(new IPEndPoint(IPAddress.Loopback, 0))), seed);
        using TappedPort clientPort = new(between(new UdpPort(new IPEndPoint(IPAddress.Loopback, 0))), seed + 1);
        using UdpPort stranger = new(new IPEndPoint(IPAddress.Loopback, 0));
        HostOptions options = new() { ConnectKey = "flood", PlayerBudget = null, ExtraHistory = SimDuration.FromSeconds(5) };
        ulong number = (ulong)Stopwatch.GetTimestamp();
        using PeerThread host = new(new HostSession(scene, hostPort, new StopwatchClock(), options, number), hostPort, "LagSim flooded host");
        using PeerThread client = new(
            new ClientSession(null, clientPort, new StopwatchClock(), ClientOptions.From(options), hostPort.LocalAddress, number),
            clientPort,
            "LagSim flooded client");
        host.Start();
        client.Start();
        if (!host.WaitUntilRunning(Timeout) || !client.WaitUntilRunning(Timeout))
        {
            return new FloodReport(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, client.Session.EndReason ?? "The two did not come together.");
        }

        HostileDatagrams hostile = new(new SeededRandom(seed));
        long began = Stopwatch.GetTimestamp(), garbage = 0, replays = 0, done = 0, memory = 0;
        double nextAction = 0, nextLook = 0;
        double Elapsed() => Stopwatch.GetElapsedTime(began).TotalSeconds;
        while (Elapsed() < seconds && garbage + replays < packets)
        {
            cancellation.ThrowIfCancellationRequested();
            for (int burst = 0; burst < 64 && garbage + replays < packets; burst++)
            {
                stranger.Send(hostile.Next(), (burst % 4 < 2 ? hostPort : clientPort).LocalAddress);
                garbage++;
                replays += hostPort.SendAgain() ? 1 : 0;
                replays += clientPort.SendAgain() ? 1 : 0;
            }

            if (Elapsed() >= nextAction)
            {
                _ = (done % 2 == 0 ? host : client).Do(PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 0.5, 0)));
                done++;
                nextAction += 0.25;
            }

            if (memory == 0 && (Elapsed() > seconds / 5 || garbage + replays > packets / 5))
            {
                memory = LiveMemory.Read();
            }

            if (Elapsed() >= nextLook)
            {
                progress?.Invoke(Elapsed());
                nextLook += 0.1;
            }
        }

        double lasted = Elapsed();
        long grown = memory == 0 ? 0 : LiveMemory.Read() - memory;
        string? failure = Settle(host, client, done);
        failure ??= grown > MaxGrowth ? $"Memory grew by {grown} bytes during the flood." : null;
        SessionCounters a = Ask(host, s => s.Counters.Copy()), b = Ask(client, s => s.Counters.Copy());
        return new FloodReport(
            lasted, garbage, replays, a.DatagramsReceived + b.DatagramsReceived, a.DatagramsMalformed + b.DatagramsMalformed,
            a.DatagramsIgnored + b.DatagramsIgnored, done, Math.Min(a.EventsAccepted, b.EventsAccepted), grown,
            Math.Max(host.Session.World!.MaxLateness.ToMilliseconds(), client.Session.World!.MaxLateness.ToMilliseconds()), failure);
    }

    /// <summary>Waits until both have everything, and compares their worlds. Returns a sentence for a failure.</summary>
    private static string? Settle(PeerThread host, PeerThread client, long done)
    {
        long deadline = Stopwatch.GetTimestamp() + (long)(Timeout.TotalSeconds * Stopwatch.Frequency);
        while (Ask(host, s => s.Counters.EventsAccepted) < done || Ask(client, s => s.Counters.EventsAccepted) < done)
        {
            if (host.State == SessionState.Ended || client.State == SessionState.Ended || Stopwatch.GetTimestamp() > deadline)
            {
                return $"After the flood the host is {host.State} and the client {client.State}: {host.Session.EndReason} {client.Session.EndReason}";
            }

            Thread.Sleep(10);
        }

        SimTime then = SimTime.Max(host.Session.World!.Simulation.Start, host.Session.SharedTime.Now - SimDuration.FromMilliseconds(500));
        return Ask(host, s => s.World!.Simulation.EventHash(then)) == Ask(client, s => s.World!.Simulation.EventHash(then))
            ? null
            : "After the flood the two worlds differ.";
    }

    private static T Ask<T>(PeerThread peer, Func<Session, T> question)
    {
        Task<T> answer = peer.Ask(question);
        return answer.Wait(Timeout) ? answer.Result : throw new Experiments.Peers.PeerGroupException($"A peer did not answer within {Timeout.TotalSeconds} s.");
    }
}
