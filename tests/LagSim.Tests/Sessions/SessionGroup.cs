using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A host and clients in virtual time, with every option at hand, and with the host's log as it was seen on the wire.</summary>
internal sealed class SessionGroup
{
    internal const ulong SessionId = 0x5E55_1017;

    private readonly VirtualSteps steps;
    private readonly List<IDatagramPort> ports = [];
    private readonly Random luck;
    private readonly Func<int, IDatagramPort, IDatagramPort>? wrap;
    private readonly UpdateDatagram tapped = new();
    private SimTime promised = SimTime.MinValue; // the greatest watermark sent: whatever the host logs from then on is not before it
    private uint promisedFrom; // the least place in the log from which on it was promised to anybody

    /// <summary>
    /// Peers that are not connected yet: the host has number 0 in the network, the clients 1 and up. What both sides have counts for a
    /// peer of the other side too.
    /// </summary>
    internal SessionGroup(
        Scene scene,
        int peers,
        LinkProfile link,
        ulong seed = 1,
        Func<int, SessionOptions>? options = null,
        Func<int, Scene>? scenes = null,
        int? expected = null,
        Func<int, IDatagramPort, IDatagramPort>? wrap = null)
    {
        this.wrap = wrap;
        Scene = scene;
        Network = new VirtualNetwork(Clock, seed, link);
        Network.Lose((from, _, datagram) =>
        {
            Tap(from, datagram.Span);
            return false;
        });
        luck = new Random((int)seed);
        steps = new VirtualSteps(Network);
        for (int peer = 0; peer < peers; peer++)
        {
            SessionOptions chosen = options?.Invoke(peer) ?? new HostOptions();
            chosen = peer == 0 ? HostOptions.From(chosen) with { ExpectedClients = expected ?? peers - 1 } : chosen;
            Add(peer, scenes?.Invoke(peer) ?? scene, chosen, seed + (ulong)peer);
        }

        Host.Logged += entry =>
        {
            Log.Add(entry.Index, new UpdateEntry(entry.Verdict, entry.Event));
            if (entry.Verdict is Verdict.Accepted or Verdict.Moved && entry.Event.Time < promised)
            {
                Assert.Fail($"{entry} came after a watermark of {promised}");
            }
        };
    }

    internal Scene Scene { get; }

    internal VirtualClock Clock { get; } = new(SimTime.FromSeconds(10));

    internal VirtualNetwork Network { get; }

    internal IReadOnlyList<IDatagramPort> Ports => ports;

    internal IReadOnlyList<Session> Sessions => steps.Sessions;

    /// <summary>The steps, to stop a peer or put another in its place.</summary>
    internal VirtualSteps Steps => steps;

    internal HostSession Host => (HostSession)Sessions[0];

    /// <summary>What the host said to each event, by place in its log.</summary>
    internal SortedDictionary<uint, UpdateEntry> Log { get; } = [];

    internal IEnumerable<ExternalEvent> Accepted => Log.Values.Where(e => e.Verdict is Verdict.Accepted or Verdict.Moved).Select(e => e.Event);

    /// <summary>Whether what datagrams carry is held against the log; to be turned off where a test itself speaks as the host.</summary>
    internal bool IsTapped { get; set; } = true;

    /// <summary>Called before each step of a peer.</summary>
    internal Action<int>? BeforeStep
    {
        set => steps.BeforeStep = value;
    }

    /// <summary>How long a step takes that leaves a world behind; see <see cref="VirtualSteps.BusyStep"/>.</summary>
    internal double BusyMilliseconds
    {
        set => steps.BusyStep = SimDuration.FromMilliseconds(value);
    }

    internal ClientSession Client(int peer) => (ClientSession)Sessions[peer];

    /// <summary>One more client, which knows nothing of the scene, at an address of its own.</summary>
    internal ClientSession Join(int address, ulong nonce, ClientOptions? options = null, PeerAddress? host = null) =>
        (ClientSession)Add(address, null, options ?? new ClientOptions(), nonce, host);

    /// <summary>Kills the host, and starts one at its address that knows nothing of it.</summary>
    internal HostSession RestartHost(HostOptions options, Scene? scene = null)
    {
        ports[0].Dispose();
        IDatagramPort port = Network.CreatePort(0);
        HostSession session = new(scene ?? Scene, port, new SkewedClock(Clock, 0, SimDuration.FromSeconds(1)), options, SessionId + 1);
        ports[0] = port;
        IsTapped = false; // its log is another one
        steps.Replace(0, session, port);
        return session;
    }

    /// <summary>Takes the peer that came last out of the group, gone or not.</summary>
    internal void DropLast()
    {
        ports[^1].Dispose();
        ports.RemoveAt(ports.Count - 1);
        steps.RemoveLast();
    }

    /// <summary>Lets that much true time pass.</summary>
    internal void Run(double seconds)
    {
        steps.RunFor(SimDuration.FromSeconds(seconds));
    }

    /// <summary>Lets time pass until something is so; false if it was not within that many seconds.</summary>
    internal bool RunUntil(Func<bool> isSo, double seconds = 30)
    {
        SimTime deadline = Clock.Now + SimDuration.FromSeconds(seconds);
        while (!isSo())
        {
            if (Clock.Now >= deadline)
            {
                return false;
            }

            steps.Advance(deadline);
        }

        return true;
    }

    /// <summary>Until all run.</summary>
    internal SessionGroup Connect()
    {
        Assert.True(RunUntil(() => Sessions.All(s => s.State == SessionState.Running)), string.Join(" ", Sessions.Select(s => $"{s.State} {s.EndReason}")));
        return this;
    }

    internal ExternalEvent Do(int peer, PlayerAction action)
    {
        ExternalEvent external = Sessions[peer].Do(action);
        steps.Wake(peer);
        return external;
    }

    /// <summary>Until every client has heard of the whole log, and the host of every event that was done.</summary>
    internal bool Settle(int done, double seconds = 60) => RunUntil(
        () => Host.Counters.EventsAccepted + Host.Counters.EventsRefused == done
            && Sessions.All(s => s.State == SessionState.Ended || s.LogLength == Host.LogLength),
        seconds);

    /// <summary>Loses everything from one peer to another from now on, until <see cref="Restore"/>.</summary>
    internal void Cut(int from, int to) => Network.SetLink(from, to, new LinkLeg(0, lossPercent: 100));

    internal void Restore(int from, int to, double delayMilliseconds = 5) => Network.SetLink(from, to, new LinkLeg(delayMilliseconds));

    /// <summary>The world of one who had all accepted events at once, and no network.</summary>
    internal Simulation Alone(IEnumerable<ExternalEvent>? events = null)
    {
        Simulation simulation = new(Scene, new SimulationOptions(Host.World!.Simulation.Start, SimDuration.MaxValue));
        foreach (ExternalEvent external in events ?? Accepted)
        {
            simulation.Submit(external);
        }

        simulation.AdvanceTo(Host.World.Simulation.SimulatedTo);
        return simulation;
    }

    /// <summary>The first difference between that world and any peer's, at many instants of what all still have; null for none.</summary>
    /// <remarks>
    /// A world at rest steps seldom: one may be simulated up to before another's history begins. All can be read up to their horizon.
    /// </remarks>
    internal string? Difference(Simulation? expected = null)
    {
        expected ??= Alone();
        Simulation[] all = [.. Sessions.Select(s => s.World!.Simulation).Append(expected)];
        SimTime first = SimTime.Max(expected.Start, all.Max(one => one.HistoryEdge));
        SimTime last = SimTime.Min(all.Min(one => one.Horizon), all.Max(one => one.SimulatedTo));
        Assert.True(first <= last, $"nothing that all have: from {first} to {last}");
        const int instants = 40;
        for (int i = 0; i <= instants; i++)
        {
            SimTime time = first + ((last - first) / instants * i);
            for (int peer = 0; peer < Sessions.Count; peer++)
            {
                Simulation actual = Sessions[peer].World!.Simulation;
                if (actual.StateHash(time) != expected.StateHash(time))
                {
                    return $"peer {peer} has another state at {time - expected.Start} after the start";
                }

                if (actual.EventHash(time) != expected.EventHash(time))
                {
                    return $"peer {peer} has other events up to {time - expected.Start} after the start";
                }
            }
        }

        return null;
    }

    private Session Add(int address, Scene? scene, SessionOptions options, ulong nonce, PeerAddress? host = null)
    {
        IDatagramPort port = wrap?.Invoke(address, Network.CreatePort(address)) ?? Network.CreatePort(address);
        SkewedClock own = new(Clock, (luck.NextDouble() * 40) - 20, SimDuration.FromSeconds(luck.NextDouble() * 3600));
        ports.Add(port);
        Session session = Sessions.Count == 0
            ? new HostSession(scene!, port, own, HostOptions.From(options), SessionId)
            : new ClientSession(scene, port, own, ClientOptions.From(options), host ?? PeerAddress.Virtual(0), nonce);
        steps.Add(session, port);
        return session;
    }

    private void Tap(int from, ReadOnlySpan<byte> datagram)
    {
        if (from != 0 || !IsTapped || !tapped.TryDecode(datagram, out _))
        {
            return;
        }

        uint index = tapped.FirstIndex;
        foreach (UpdateEntry entry in tapped.Entries)
        {
            // The host says yes or no once: what stands in the log never changes.
            UpdateEntry logged = Log[index++];
            Assert.Equal((logged.Verdict, logged.Sequence), (entry.Verdict, entry.Sequence));
            Assert.True(entry.IsOwn || entry.Event.Equals(logged.Event));
        }

        promisedFrom = tapped.Watermark > promised ? uint.MaxValue : promisedFrom;
        promised = SimTime.Max(promised, tapped.Watermark);
        uint end = tapped.Watermark == promised ? promisedFrom : uint.MaxValue; // what comes after that was held against this watermark already
        promisedFrom = tapped.Watermark == promised ? Math.Min(promisedFrom, index) : promisedFrom;
        for (; tapped.Watermark != SimTime.MinValue && index < end && Log.TryGetValue(index, out UpdateEntry later); index++)
        {
            if (later.Verdict is Verdict.Accepted or Verdict.Moved && later.Event.Time < tapped.Watermark)
            {
                Assert.Fail($"{later.Event} comes after a watermark of {tapped.Watermark}");
            }
        }
    }
}
