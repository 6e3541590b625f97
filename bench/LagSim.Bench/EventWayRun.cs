using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Net;
using System.Runtime;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>One process of <see cref="EventWayTable"/>: a host and a client over loopback UDP, a player at each who does every kind of event at random gaps.</summary>
/// <remarks>Times are taken on the sessions' own threads, so that no reader takes a core from them: what is compared is the stamp of an event, when it comes into the
/// other's world, and when that world was published with it.</remarks>
internal sealed class EventWayRun
{
    private static readonly EventKind[] Kinds =
    {
        EventKind.Spawn, EventKind.Impulse, EventKind.SetVelocity, EventKind.Teleport, EventKind.Grab, EventKind.HoldKeyframe, EventKind.Release, EventKind.Remove,
    };

    private readonly int rounds;
    private readonly int seed;
    private readonly Side host;
    private readonly Side client;

    private int compiled;
    private double compiledMilliseconds;
    private int collections;

    private EventWayRun(PeerThread host, PeerThread client, int rounds, int seed)
    {
        this.rounds = rounds;
        this.seed = seed;
        this.host = new Side(host, 0);
        this.client = new Side(client, 1);
    }

    /// <summary>A line for each event: who did it, its kind, and from its stamp to the other's world and to its being published, from its being asked for to its stamp, in ms;
    /// and then one of the process.</summary>
    internal static void Print(HostOptions options, int rounds, int seed)
    {
        GCSettings.LatencyMode = GCLatencyMode.Interactive; // the default, told: a game has it
        Scene scene = new SceneBuilder("way")
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("host's", new BodySpec(0.5, 1, 0.5), new Vector3D(-3, 0.5, 0))
            .AddBody("client's", new BodySpec(0.5, 1, 0.5), new Vector3D(3, 0.5, 0))
            .Build();
        long began = Stopwatch.GetTimestamp();
        using PeerThread host = PeerThread.Host(scene, options: options, bind: IPAddress.Loopback);
        double calling = Stopwatch.GetElapsedTime(began).TotalMilliseconds;
        using PeerThread client = PeerThread.Join(new IPEndPoint(IPAddress.Loopback, host.LocalAddress.ToEndPoint().Port), ClientOptions.From(options));
        TimeSpan timeout = TimeSpan.FromSeconds(20);
        if (!host.WaitUntilRunning(timeout) || !client.WaitUntilRunning(timeout))
        {
            throw new InvalidOperationException($"The session does not run: {client.Session.EndReason}");
        }

        double running = Stopwatch.GetElapsedTime(began).TotalMilliseconds;
        EventWayRun run = new(host, client, rounds, seed);
        run.Play();
        double atRest = AtRest();
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"process {calling:R} {running:R} {atRest:R} {run.compiled} {run.compiledMilliseconds:R} {run.collections}"));
    }

    private void Play()
    {
        host.Watch(client);
        client.Watch(host);
        Side.Practise(client, host); // what measures is compiled before it measures
        Thread[] players = { new(() => Play(host)), new(() => Play(client)) };
        int before = (int)JitInfo.GetCompiledMethodCount();
        TimeSpan spent = JitInfo.GetCompilationTime();
        int collected = GC.CollectionCount(0);
        Array.ForEach(players, p => p.Start());
        Array.ForEach(players, p => p.Join());
        Thread.Sleep(50);
        host.Show();
        client.Show();
        compiled = (int)JitInfo.GetCompiledMethodCount() - before;
        compiledMilliseconds = (JitInfo.GetCompilationTime() - spent).TotalMilliseconds;
        collections = GC.CollectionCount(0) - collected;
        host.Tell("host");
        client.Tell("client");
    }

    /// <summary>Every kind in turn, each on the same body, so that it is where the next kind needs it.</summary>
    private void Play(Side side)
    {
        Random random = new((seed * 2) + side.Number);
        Vector3D home = new(side.Number == 0 ? -3 : 3, 0.5, 0);
        BodyId own = BodyId.OfScene(side.Number);
        BodyId spawned = default;
        for (int round = 0; round < rounds; round++)
        {
            foreach (EventKind kind in Kinds)
            {
                Thread.Sleep(5 + random.Next(46));
                ExternalEvent done = side.Do(kind switch
                {
                    EventKind.Spawn => PlayerAction.Spawn(new BodySpec(0.5, 1, 0.5), home + new Vector3D(0, 0, 3), new Vector3D(0, 3, 0)),
                    EventKind.Impulse => PlayerAction.Impulse(own, new Vector3D(0.3, 3, 0)),
                    EventKind.SetVelocity => PlayerAction.SetVelocity(own, new Vector3D(-0.3, 2, 0)),
                    EventKind.Teleport => PlayerAction.Teleport(own, home + new Vector3D(0, 1, 0)),
                    EventKind.Grab => PlayerAction.Grab(own),
                    EventKind.HoldKeyframe => PlayerAction.HoldKeyframe(own, home + new Vector3D(0, 1.2, 0), new Vector3D(0, 1, 0)),
                    EventKind.Release => PlayerAction.Release(own, new Vector3D(0, 1, 0)),
                    _ => PlayerAction.Remove(spawned),
                });
                spawned = kind == EventKind.Spawn ? done.Body : spawned;
            }
        }
    }

    /// <summary>The part of a core that the two take once all is at rest.</summary>
    private static double AtRest()
    {
        Thread.Sleep(4000);
        using Process self = Process.GetCurrentProcess();
        TimeSpan used = self.TotalProcessorTime;
        long began = Stopwatch.GetTimestamp();
        Thread.Sleep(6000);
        self.Refresh();
        return (self.TotalProcessorTime - used) / Stopwatch.GetElapsedTime(began);
    }

    /// <summary>One peer: what is asked of it, and what it shows of the other.</summary>
    private sealed class Side
    {
        private readonly PeerThread peer;
        private readonly List<(EventKind Kind, uint Sequence, double Asked, double Stamped)> done = new(4096);
        private readonly List<(uint Sequence, double Applied, double Shown)> seen = new(4096);
        private readonly List<(uint Sequence, double Applied, SimTime Shared)> unshown = new(64);
        private Side? other;

        internal Side(PeerThread peer, byte number)
        {
            this.peer = peer;
            Number = number;
        }

        internal byte Number { get; }

        internal static void Practise(params Side[] sides)
        {
            foreach (Side side in sides)
            {
                side.Hear(side.peer.Session, new LogEntry(1, Net.Wire.Verdict.Accepted, ExternalEvent.Remove(SimTime.Zero, (byte)(1 - side.Number), 0, BodyId.OfScene(0))));
                side.Note(side.peer.Session, SimTime.MaxValue);
                side.seen.Clear();
                side.unshown.Clear();
                side.Stamped(SimTime.Zero);
            }
        }

        internal void Watch(Side of)
        {
            other = of;
            peer.Ask(session =>
            {
                session.Logged += entry => Hear(session, entry);
                return true;
            }).Wait();
        }

        /// <summary>As <see cref="PeerThread.Do"/> does it, but that what was shown before is noted before.</summary>
        internal ExternalEvent Do(PlayerAction action)
        {
            double asked = Milliseconds();
            Task<ExternalEvent> answer = peer.Ask(session =>
            {
                Note(session, session.Counters.LastShown);
                return session.Do(action);
            });
            answer.Wait();
            done.Add((action.Kind, answer.Result.Sequence, asked, Stamped(answer.Result.Time)));
            return answer.Result;
        }

        internal void Show() => peer.Ask(session =>
        {
            Note(session, session.Counters.LastShown);
            return true;
        }).Wait();

        internal void Tell(string name)
        {
            int at = 0;
            foreach ((EventKind kind, uint sequence, double asked, double stamped) in done)
            {
                (uint shownSequence, double applied, double shown) = other!.seen[at++];
                if (shownSequence != sequence)
                {
                    throw new InvalidOperationException($"Event {sequence} of the {name} was not seen; {shownSequence} was.");
                }

                Console.WriteLine(string.Create(
                    CultureInfo.InvariantCulture, $"{name} {kind} {applied - stamped:R} {shown - stamped:R} {stamped - asked:R}"));
            }
        }

        private static double Milliseconds() => Stopwatch.GetTimestamp() * 1000.0 / Stopwatch.Frequency;

        // The shared time runs at most 5 % fast or slow while it is bent, so an instant a moment ago is told exactly enough.
        private double Stamped(SimTime stamp) => Milliseconds() - (peer.Session.SharedTime.Now - stamp).ToMilliseconds();

        private void Hear(Session session, in LogEntry entry)
        {
            Note(session, session.Counters.LastShown);
            if (entry.Event.Peer != Number)
            {
                unshown.Add((entry.Event.Sequence, Milliseconds(), session.SharedTime.Now));
            }
        }

        /// <summary>Notes what was published since.</summary>
        private void Note(Session session, SimTime lastShown)
        {
            foreach ((uint sequence, double applied, SimTime shared) in unshown)
            {
                if (lastShown < shared)
                {
                    return; // comes first with the next step
                }

                seen.Add((sequence, applied, applied + (lastShown - shared).ToMilliseconds()));
            }

            unshown.Clear();
        }
    }
}
