using System;
using BenchmarkDotNet.Attributes;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>What one datagram costs a host, from its port to the answer: noise, an old one, a keep-alive, and one with an event that is validated and put into the world.</summary>
[MemoryDiagnoser]
public class SessionBenchmark
{
    private readonly VirtualClock clock = new(SimTime.FromSeconds(10));
    private readonly UpdateDatagram update = new();
    private readonly byte[] noise = new byte[100];
    private readonly byte[] old = new byte[WireFormat.MaxBytes];
    private FeedPort port = null!;
    private HostSession host = null!;
    private int oldLength;
    private uint number;
    private uint sequence;

    [GlobalSetup]
    public void Join()
    {
        Scene scene = new SceneBuilder("bench").AddPlane("floor", Vector3D.Up, Vector3D.Zero).AddBody("ball", new BodySpec(0.5, 1, 0.5), new Vector3D(0, 0.5, 0)).Build();
        port = new FeedPort();
        host = new HostSession(scene, port, clock, new HostOptions { MaxEventsPerSecond = 100_000, StartLead = SimDuration.Zero }, 99);
        byte[] bytes = new byte[WireFormat.MaxBytes];
        Feed(bytes.AsSpan(0, new ConnectRequestDatagram(1).Encode(bytes)));
        ChallengeDatagram.TryDecode(port.LastSent, out ChallengeDatagram challenge, out _);
        Feed(bytes.AsSpan(0, new JoinDatagram(1, challenge.Cookie, JoinCookies.Prove("", 1, challenge.Cookie), 0, (uint)Simulation.FoldVersion).Encode(bytes)));
        WelcomeDatagram.TryDecode(port.LastSent, out WelcomeDatagram welcome, out _);
        update.SessionId = welcome.SessionId;
        update.Ready = true;
        Feed(old.AsSpan(0, Next(0, old)));
        SeatDatagram.TryDecode(port.LastSent, out SeatDatagram seat, out _);
        update.Peer = seat.Peer;
        oldLength = Next(0, old);
        Feed(old.AsSpan(0, oldLength));
        new Random(1).NextBytes(noise);
        clock.Now += SimDuration.FromSeconds(2);
        host.Step();
        if (host.State != SessionState.Running)
        {
            throw new InvalidOperationException($"The session is {host.State}.");
        }
    }

    [Benchmark]
    public void Noise() => Feed(noise);

    [Benchmark]
    public void PlayedAgain() => Feed(old.AsSpan(0, oldLength));

    [Benchmark(Baseline = true)]
    public void KeepAlive()
    {
        Span<byte> bytes = stackalloc byte[WireFormat.MaxBytes];
        Feed(bytes.Slice(0, Next(0, bytes)));
    }

    [Benchmark]
    public void OneEvent()
    {
        Span<byte> bytes = stackalloc byte[WireFormat.MaxBytes];
        Feed(bytes.Slice(0, Next(1, bytes)));
    }

    private int Next(int events, Span<byte> bytes)
    {
        clock.Now += SimDuration.FromMilliseconds(2);
        update.ClearEntries();
        update.Number = ++number;
        update.Sent = clock.Now;
        update.EventsReceived = host.LogLength;
        update.FirstIndex = sequence + 1;
        if (events > 0)
        {
            // To and fro: what would in the end be faster than players may make it is refused, which is another thing to measure.
            double push = ++sequence % 2 == 0 ? -0.01 : 0.01;
            update.TryAdd(Verdict.Pending, ExternalEvent.Impulse(host.SharedTime.Now, update.Peer, sequence, BodyId.OfScene(0), new Vector3D(push, 0, 0)));
        }

        return update.Encode(bytes);
    }

    private void Feed(ReadOnlySpan<byte> datagram)
    {
        port.Put(datagram);
        host.Step();
    }

    /// <summary>A port into which a benchmark puts one datagram at a time.</summary>
    private sealed class FeedPort : IDatagramPort
    {
        private readonly byte[] waiting = new byte[IDatagramPort.MaxDatagramBytes];
        private readonly byte[] sent = new byte[IDatagramPort.MaxDatagramBytes];
        private int waitingLength;
        private int sentLength;

        public event Action? Arrived
        {
            add { }
            remove { }
        }

        public PeerAddress LocalAddress => PeerAddress.Virtual(0);

        internal ReadOnlySpan<byte> LastSent => sent.AsSpan(0, sentLength);

        public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
        {
            datagram.CopyTo(sent);
            sentLength = datagram.Length;
        }

        public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
        {
            length = waitingLength;
            from = PeerAddress.Virtual(1);
            waiting.AsSpan(0, waitingLength).CopyTo(buffer);
            waitingLength = 0;
            return length > 0;
        }

        public void Dispose()
        {
        }

        internal void Put(ReadOnlySpan<byte> datagram)
        {
            datagram.CopyTo(waiting);
            waitingLength = datagram.Length;
        }
    }
}
