using System;
using System.Diagnostics;
using System.Linq;
using System.Net;
using System.Threading;
using LagSim.Events;
using LagSim.Harness.Relays;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>
/// A group of peers in real time over real sockets on this machine. Each has its own thread, port and clock; the calling thread samples
/// them.
/// </summary>
public sealed class RealPeers : PeerGroup
{
    private const int PollMilliseconds = 1;

    /// <summary>Processor time over a shorter span is mostly chance, and includes JIT compilation in the background.</summary>
    private const double MinQuietSeconds = 0.9;

    private static readonly SimDuration ConnectDeadline = SimDuration.FromSeconds(15);
    private static readonly SimDuration AnswerDeadline = SimDuration.FromSeconds(5);

    /// <summary>A sample taken later than this after its instant counts as missed.</summary>
    private static readonly SimDuration Timeout = SimDuration.FromMilliseconds(4);

    private readonly PeerGroupOptions options;
    private readonly StopwatchClock trueTime = new();
    private readonly CountingPort[] ports;
    private readonly DelayedPort[] delayed;
    private readonly PeerThread[] threads;
    private readonly HostIdentity? identity; // null in sessions without protection
    private volatile Exception? handlerFailure;
    private bool finished;

    /// <summary>Creates the peers and binds their carriers to free ports of the loopback interface, without connecting them.</summary>
    public RealPeers(Scene scene, PeerGroupOptions options)
        : base(scene, options)
    {
        this.options = options;
        identity = options.Carrier.IsProtected ? HostIdentity.Draw() : null;
        ports = new CountingPort[PeerCount];
        delayed = new DelayedPort[PeerCount];
        threads = new PeerThread[PeerCount];
        SeededRandom random = new SeededRandom(options.Seed).Fork(0xC10C);
        for (int peer = 0; peer < PeerCount; peer++)
        {
            // The clocks of machines that started at different times agree only on the length of a second.
            SimDuration apart = SimDuration.FromSeconds(random.NextDouble() * 3600);
            SkewedClock own = new(trueTime, 0, peer == 0 ? apart : apart + options.Link.ReceiverClockOffset);
            CountingPort counting = new(options.Carrier.Open(new IPEndPoint(IPAddress.Loopback, 0)));
            ports[peer] = counting;
            int receiver = peer;
            DelayedPort port = delayed[peer] = new DelayedPort(counting, trueTime, from => LinkTo(receiver, from));
            (HostOptions hosting, ClientOptions joining) = ProtectedOptions.Of(options.ToHostOptions(), identity);
            ulong number = (ulong)Stopwatch.GetTimestamp();
            threads[peer] = new PeerThread(
                peer == 0
                    ? new HostSession(scene, port, own, hosting, number)
                    : new ClientSession(scene, port, own, joining, ports[0].LocalAddress, number),
                port,
                $"LagSim peer {peer}");
            threads[peer].Session.HandlerFailed += failure => handlerFailure ??= failure;
        }
    }

    /// <inheritdoc/>
    public override Session Session(int peer) => threads[peer].Session;

    /// <inheritdoc/>
    public override PortTraffic Traffic(int peer) => ports[peer].Traffic;

    /// <inheritdoc/>
    public override void Connect()
    {
        foreach (PeerThread thread in threads)
        {
            thread.Start();
        }

        long deadline = Stopwatch.GetTimestamp() + (long)(ConnectDeadline.ToSeconds() * Stopwatch.Frequency);
        while (threads.Any(t => t.Session.World is null))
        {
            PeerThread? ended = threads.FirstOrDefault(t => t.State == SessionState.Ended);
            if (ended is not null || Stopwatch.GetTimestamp() > deadline)
            {
                throw new PeerGroupException(ended?.Session.EndReason ?? $"Not all peers were connected after {ConnectDeadline.ToSeconds()} s.");
            }

            Thread.Sleep(PollMilliseconds);
        }

        Start = threads[0].Session.World!.Simulation.Start;
        PrepareSamples(options.Length, PeerGroupOptions.SampleInterval);
    }

    /// <inheritdoc/>
    public override void RunUntil(SimDuration sinceStart, Action<SimDuration>? progress) =>
        Run(Start + sinceStart, [threads[0].Session], progress);

    /// <inheritdoc/>
    public override void RunQuietlyUntil(SimDuration sinceStart, Action<SimDuration>? progress)
    {
        SimTime end = Start + sinceStart;
        Run(end - QuietTime, [threads[0].Session], progress);
        while (!AllRest() && threads[0].Session.SharedTime.Now < end)
        {
            Sample();
            Thread.Sleep(PollMilliseconds);
        }

        // Bodies at rest need no samples: the frame shows afterwards what it showed throughout.
        double left = (end - threads[0].Session.SharedTime.Now).ToSeconds();
        if (AllRest() && left >= MinQuietSeconds)
        {
            MeasureAtRest(left);
        }

        Run(end, Array.ConvertAll(threads, t => t.Session), progress);
        AwaitWorlds(end);
    }

    /// <inheritdoc/>
    public override ExternalEvent Do(int peer, PlayerAction action)
    {
        System.Threading.Tasks.Task<ExternalEvent> done = threads[peer].Do(action).AsTask();
        try
        {
            return done.Wait((int)AnswerDeadline.ToMilliseconds())
                ? done.Result
                : throw new PeerGroupException($"Peer {peer} did not answer within {AnswerDeadline.ToSeconds()} s.");
        }
        catch (AggregateException failure)
        {
            throw new PeerGroupException($"Peer {peer} could not do what it was to do. {failure.InnerException!.Message}", failure.InnerException);
        }
    }

    /// <inheritdoc/>
    public override void Finish()
    {
        if (finished)
        {
            return;
        }

        finished = true;
        foreach (PeerThread thread in threads)
        {
            thread.Dispose();
        }

        CollectSettled();
    }

    /// <inheritdoc/>
    public override void Dispose()
    {
        Finish();
        foreach (DelayedPort port in delayed)
        {
            port.Dispose();
        }

        identity?.Dispose();
    }

    /// <summary>
    /// The link from one peer to another. Both directions share a clock and a path, so that a disturbance affects both at once.
    /// </summary>
    private LinkModel LinkTo(int receiver, PeerAddress from)
    {
        int client = receiver == 0 ? Array.FindIndex(ports, port => port?.LocalAddress == from) : receiver;
        SeededRandom luck = new SeededRandom(options.Seed).Fork((ulong)client);
        if (receiver == 0)
        {
            return new LinkModel(options.Link.ToHost, luck.Fork(0), luck.Fork(2));
        }

        LinkModel down = new(options.Link.FromHost, luck.Fork(1), luck.Fork(2));
        if (options.Link.HasBulkTransfer)
        {
            // The upstream belongs to another thread. So acknowledgements have their own queue, with a twentieth of its rate, which the
            // session does not share.
            LinkModel acks = new(options.Link.ToHost, luck.Fork(4), luck.Fork(2));
            _ = new BulkTransfer(new LinkModel(options.Link.FromHost, luck.Fork(3), luck.Fork(2), down.Queue), acks, trueTime.Now);
        }

        return down;
    }

    private void Run(SimTime end, Session[] clocks, Action<SimDuration>? progress)
    {
        while (LeftUntil(end, clocks) > SimDuration.Zero)
        {
            if (handlerFailure is Exception failure)
            {
                throw new PeerGroupException($"What watches the peers failed. {failure.Message}", failure);
            }

            Sample();
            for (int peer = 0; peer < PeerCount; peer++)
            {
                ThrowIfEnded(peer, threads[peer].State, threads[peer].Session);
            }

            progress?.Invoke(threads[0].Session.SharedTime.Now - Start);
            Thread.Sleep(PollMilliseconds);
        }

        Sample();
    }

    /// <summary>
    /// A thread that the machine kept waiting may be behind its clock. Waits for its settled state, within reason.
    /// </summary>
    private void AwaitWorlds(SimTime end)
    {
        long deadline = Stopwatch.GetTimestamp() + (long)(AnswerDeadline.ToSeconds() * Stopwatch.Frequency);
        while (!Array.TrueForAll(threads, t => t.Latest()!.To >= end) && Stopwatch.GetTimestamp() < deadline)
        {
            Thread.Sleep(PollMilliseconds);
        }
    }

    private bool AllRest() => Array.TrueForAll(threads, t => t.Latest()!.To == SimTime.MaxValue);

    private void MeasureAtRest(double seconds)
    {
        Sample();
        long[] snapshots = Array.ConvertAll(threads, t => t.Latest()!.Number);
        TimeSpan before = Environment.CpuUsage.TotalTime;
        long began = Stopwatch.GetTimestamp();
        Thread.Sleep(TimeSpan.FromSeconds(seconds));
        double used = (Environment.CpuUsage.TotalTime - before).TotalSeconds / Stopwatch.GetElapsedTime(began).TotalSeconds;
        CpuCoresAtRest = Array.TrueForAll(threads, t => t.Latest()!.Number == snapshots[Array.IndexOf(threads, t)]) ? used : null;
    }

    private void Sample()
    {
        for (int peer = 0; peer < PeerCount; peer++)
        {
            SamplePeer(peer);
        }
    }

    private void SamplePeer(int peer)
    {
        Session session = threads[peer].Session;
        int before = Seen[peer].Next;
        Seen[peer].Take(threads[peer].Latest(), session.SharedTime.Now, Timeout);
        if (peer == 0 && Seen[0].Next > before)
        {
            SampleTrueTime(before, Seen[0].Next);
        }
    }

    /// <summary>One true instant stands for all instants of the grid that passed since the last sample.</summary>
    private void SampleTrueTime(int first, int end)
    {
        // The clocks are read one after the other; the difference, some hundred nanoseconds, is in the figure.
        SimTime[] readings = Array.ConvertAll(threads, t => t.Session.SharedTime.Now);
        for (int n = first; n < end; n++)
        {
            for (int peer = 0; peer < PeerCount; peer++)
            {
                SeenTrueTime[peer].TakeAt(n, threads[peer].Latest(), readings[peer]);
                ClockErrorMilliseconds[n] = Math.Max(
                    ClockErrorMilliseconds[n], Math.Abs((readings[peer] - readings[0]).ToMilliseconds()));
            }
        }
    }
}
