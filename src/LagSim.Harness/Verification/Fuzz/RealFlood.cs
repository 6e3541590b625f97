using System;
using System.Diagnostics;
using System.Net;
using System.Threading;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Fuzz;

/// <summary>
/// A flood at full speed against a host and a client over real UDP sockets: a stranger sends garbage to both, their own datagrams are
/// replayed, machines that are there join with garbage; and an honest client joins meanwhile.
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

    /// <summary>How long a client may take to join while the flood lasts: ten times what it takes.</summary>
    private const double MaxJoinSeconds = 2;

    /// <summary>Floods until either limit is reached.</summary>
    /// <param name="seconds">The longest duration, in seconds, above zero.</param>
    /// <param name="packets">The most datagrams, at least 1.</param>
    /// <param name="seed">The seed of the garbage.</param>
    /// <param name="isProtected">Whether the session is protected.</param>
    /// <param name="progress">Called from time to time with the seconds passed; may be null.</param>
    /// <param name="cancellation">Ends it.</param>
    public static FloodReport Run(
        double seconds, long packets, ulong seed, bool isProtected, Action<double>? progress, CancellationToken cancellation) =>
        Run(seconds, packets, seed, isProtected, progress, static port => port, cancellation);

    /// <summary>The same, with a wrapper between each session and its port.</summary>
    internal static FloodReport Run(
        double seconds, long packets, ulong seed, bool isProtected, Action<double>? progress, Func<IDatagramPort, IDatagramPort> between,
        CancellationToken cancellation)
    {
        ArgumentOutOfRangeException.ThrowIfLessThanOrEqual(seconds, 0);
        ArgumentOutOfRangeException.ThrowIfLessThan(packets, 1);
        using FloodedSession flooded = new(seed, isProtected, between);
        if (flooded.Start() is string apart)
        {
            return new FloodReport { Failure = apart };
        }

        using UdpPort stranger = new(new IPEndPoint(IPAddress.Loopback, 0));
        using JoinFlood joins = new(flooded.HostPort.LocalAddress, new SeededRandom(seed + 2));
        HostileDatagrams hostile = new(new SeededRandom(seed));
        long began = Stopwatch.GetTimestamp(), garbage = 0, replays = 0, joinsSent = 0, memory = 0;
        double nextAction = 0, nextLook = 0;
        double Elapsed() => Stopwatch.GetElapsedTime(began).TotalSeconds;
        double Done() => Math.Max(Elapsed() / seconds, (double)(garbage + replays + joinsSent) / packets);
        while (Done() < 1)
        {
            cancellation.ThrowIfCancellationRequested();
            for (int burst = 0; burst < 64 && Done() < 1; burst++)
            {
                stranger.Send(hostile.Next(), (burst % 4 < 2 ? flooded.HostPort : flooded.ClientPort).LocalAddress);
                garbage++;
                replays += flooded.HostPort.SendAgain() ? 1 : 0;
                replays += flooded.ClientPort.SendAgain() ? 1 : 0;
                joins.Send();
                joinsSent++;
            }

            if (Elapsed() >= nextAction)
            {
                flooded.Act();
                nextAction += 0.25;
            }

            if (Done() > 0.1)
            {
                flooded.TendNewcomer();
            }

            if (memory == 0 && Done() > 0.2)
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
        double joinTook = Math.Max(flooded.JoinSeconds ?? 0, flooded.WaitedSeconds);
        long grown = memory == 0 ? 0 : LiveMemory.Read() - memory;
        string? failure = flooded.Settle();
        failure ??= joinTook > MaxJoinSeconds
            ? FormattableString.Invariant(
                $"A client that joined during the flood was not in within {MaxJoinSeconds:0} s, but {joinTook:0.0} s.")
            : null;
        failure ??= grown > MaxGrowth ? $"Memory grew by {grown} bytes during the flood." : null;
        (SessionCounters host, SessionCounters client) = flooded.Counters();
        return new FloodReport
        {
            Seconds = lasted,
            GarbageSent = garbage,
            ReplaysSent = replays,
            JoinsSent = joinsSent,
            Received = host.DatagramsReceived + client.DatagramsReceived,
            Malformed = host.DatagramsMalformed + client.DatagramsMalformed,
            Ignored = host.DatagramsIgnored + client.DatagramsIgnored,
            Forged = host.DatagramsForged + client.DatagramsForged,
            EventsDone = flooded.EventsDone,
            EventsAgreed = Math.Min(host.EventsAccepted, client.EventsAccepted),
            JoinSeconds = flooded.JoinSeconds,
            RetainedBytes = grown,
            MaxLatenessMilliseconds = flooded.MaxLatenessMilliseconds,
            Failure = failure,
        };
    }
}
