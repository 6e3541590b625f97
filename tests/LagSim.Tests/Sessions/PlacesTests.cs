using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Hosts;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>
/// Honest players get in within 2 s, and a host sends no more than it should, whatever those do who only take: half-open joins, all places,
/// slow and greedy fetches. Each limit is taken away once, and missed.
/// </summary>
public sealed class PlacesTests(ITestOutputHelper output)
{
    private const int Seeds = 20;
    private const double Within = 2;
    private const int Thousand = 1000;
    private const int Honest = 5;
    private static readonly string[] Kinds = ["connect requests", "joins", "updates", "snapshot requests", "moves", "noise"];

    [Theory]
    [InlineData(false, 256)]
    [InlineData(true, 16)]
    public void ThousandHalfOpenJoins_HonestPlayersGetIn(bool ofOneMachine, int remembered)
    {
        List<double> took = [];
        for (int seed = 1; seed <= Seeds; seed++)
        {
            (SessionGroup group, NatPort nat) = Host(seed);
            Intruder[] halfOpen = Enumerable.Range(0, Thousand).Select(n => Intrude(group, nat, n, ofOneMachine)).ToArray();
            foreach (Intruder one in halfOpen)
            {
                one.ConnectRequest();
            }

            group.Run(0.01);
            Assert.All(halfOpen, one => Assert.NotEqual(0ul, one.SessionId));
            Assert.Equal((remembered, 0), (group.Host.ComingCount, group.Host.ClientCount));
            int next = 0;
            took.Add(GetIn(group, nat, seed, () => halfOpen[next++ % Thousand].ConnectRequest(), 0.005)); // 200 more a second meanwhile
        }

        Report($"1,000 half-open joins of {(ofOneMachine ? "one machine" : "as many machines")}", took);
    }

    [Fact]
    public void ThousandHalfOpenJoins_WithoutALimit_AreAllRemembered()
    {
        (SessionGroup group, NatPort nat) = Host(1, limits: new JoinLimits { Coming = int.MaxValue, ComingOfOne = int.MaxValue });
        foreach (int n in Enumerable.Range(0, Thousand))
        {
            Intrude(group, nat, n, n % 2 == 0).ConnectRequest();
        }

        group.Run(0.01);
        Assert.Equal(Thousand, group.Host.ComingCount);
    }

    [Theory]
    [InlineData(null, Seeds)]
    [InlineData(SessionOptions.MaxClients, 0)] // the limit taken away
    public void OneMachineThatTakesAllPlacesItCan_HonestPlayersGetIn(int? perAddress, int expected)
    {
        List<double> took = [];
        for (int seed = 1; seed <= Seeds; seed++)
        {
            (SessionGroup group, NatPort nat) = Host(seed, perAddress: perAddress);
            Intruder[] takers = Enumerable.Range(0, 3 * SessionOptions.MaxClients)
                .Select(n => Intrude(group, nat, n, true, sits: true)).ToArray();
            foreach (Intruder one in takers)
            {
                one.ConnectRequest();
            }

            group.Run(0.01);
            Assert.Equal(perAddress ?? SessionOptions.MaxClients / 2, group.Host.ClientCount);
            took.Add(GetIn(group, nat, seed, () => Array.ForEach(takers, Keep), 0.1));
        }

        Report($"one machine, {perAddress?.ToString() ?? "as many as it may"} places", took, expected);

        static void Keep(Intruder one)
        {
            if (one.Peer > 0)
            {
                one.Update(isReady: true);
            }
            else
            {
                one.ConnectRequest();
            }
        }
    }

    [Theory]
    [InlineData(1_000, true)]
    [InlineData(1e-3, false)] // the limit taken away
    public void SlowDownloads_HoldNoPlaceAndAreGivenUp(double slowest, bool areGone)
    {
        List<double> took = [];
        for (int seed = 1; seed <= (areGone ? Seeds : 1); seed++)
        {
            (SessionGroup group, NatPort nat) = Host(seed, limits: new JoinLimits { SlowestDownload = slowest });
            Intruder[] slow = Enumerable.Range(0, 200).Select(n => Intrude(group, nat, n, false)).ToArray();
            Array.ForEach(slow, one => one.ConnectRequest());
            group.Run(0.01);
            took.Add(GetIn(group, nat, seed, () => Array.ForEach(slow, one => one.Fetch(1)), 1));
            for (int second = 0; second < 40; second++)
            {
                Array.ForEach(slow, one => one.Fetch(1));
                group.Run(1);
            }

            Assert.Equal((areGone ? 0 : slow.Length, 1), (group.Host.ComingCount, group.Host.ClientCount));
        }

        Report("200 slow fetches", took, took.Count);
    }

    /// <summary>They come a second apart, so that each would have a copy of its own: no more are held than have room, and nobody is left out for another.</summary>
    [Theory]
    [InlineData(2.2, 2)]
    [InlineData(1e6, 4)] // the limit taken away
    public void CopiesOfHalfOpenJoins_TakeBoundedMemory(double room, int copies)
    {
        JoinLimits limits = new() { MinSnapshots = 1 };
        (SessionGroup group, NatPort nat) = Host(1, limits: limits);
        group.Run(3); // so that all copies have a world in them, and are of one length
        HashSet<ulong> hashes = [];
        for (int n = 0; n < 4; n++)
        {
            Intruder one = Intrude(group, nat, n, false);
            one.ConnectRequest();
            group.Run(1.05);
            hashes.Add(one.CopyHash);
            limits.SnapshotBytes = (long)(room * one.SnapshotBytes);
        }

        Assert.Equal((copies, 4), (hashes.Count, group.Host.ComingCount));
    }

    /// <summary>Half-open joins that leave no room for another copy do not have whoever comes fetch one that is older than a time-out.</summary>
    [Fact]
    public void CopiesOfHalfOpenJoins_AreNotGivenForLong()
    {
        JoinLimits limits = new() { MinSnapshots = 1 };
        (SessionGroup group, NatPort nat) = Host(1, limits: limits);
        group.Run(3);
        List<ulong> hashes = [];
        for (int n = 0; n < 20; n++)
        {
            Intruder one = Intrude(group, nat, n, false);
            one.ConnectRequest();
            group.Run(3);
            hashes.Add(one.CopyHash);
            limits.SnapshotBytes = (long)(1.5 * one.SnapshotBytes);
        }

        int[] shared = [.. Enumerable.Range(1, 19).Where(n => hashes[n] == hashes[n - 1])];
        Assert.InRange(shared.Length, 4, 16); // so there was no room
        Assert.All(Enumerable.Range(4, 16), n => Assert.NotEqual(hashes[n - 4], hashes[n])); // 12 s before
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)] // the limit taken away
    public void GreedyDownloadsOfOneMachine_ShareOnePace(bool isPaced)
    {
        JoinLimits limits = isPaced ? new JoinLimits() : new JoinLimits { ChunksPerSecond = 1e9, ChunkBurst = int.MaxValue };
        List<double> took = [];
        List<double> rates = [];
        for (int seed = 1; seed <= (isPaced ? Seeds : 1); seed++)
        {
            (SessionGroup group, NatPort nat) = Host(seed, limits: limits, isLarge: true);
            Intruder[] greedy = Enumerable.Range(0, 16).Select(n => Intrude(group, nat, n, true)).ToArray();
            Array.ForEach(greedy, one => one.ConnectRequest());
            group.Run(0.01);
            SimTime began = group.Clock.Now;
            int n = 0;
            took.Add(GetIn(group, nat, seed, Greed, 0.005));
            for (int step = 0; step < 200; step++)
            {
                Greed();
                group.Run(0.005);
            }

            double seconds = (group.Clock.Now - began).ToSeconds(), got = greedy.Sum(one => one.BytesIn);
            rates.Add(got / seconds);
            double most = ((2000 * seconds) + 256) * (WireFormat.MaxBytes + PortTraffic.HeaderBytes);
            double small = greedy.Sum(one => one.BytesOut); // challenges, welcomes, updates: no more than what they answer
            Assert.Equal(isPaced, got <= most + small);

            void Greed()
            {
                Array.ForEach(greedy, one => one.Fetch());
                greedy[n++ % greedy.Length].ConnectRequest(); // who comes again gets no more for it
            }
        }

        output.WriteLine($"greedy fetches of one machine: {rates.Max() / 1e6:F1} MB/s at most");
        Report("16 greedy fetches of one machine", took, took.Count);
    }

    /// <summary>
    /// Whatever is sent in the name of an address, that address gets no more than three times as much before it has shown that it is there.
    /// </summary>
    [Fact]
    public void BytesOut_BeforeTheAddressIsConfirmed_AreAtMostThreeTimesBytesIn()
    {
        double[] worst = new double[Kinds.Length];
        for (int seed = 1; seed <= Seeds; seed++)
        {
            (SessionGroup group, _) = Host(seed);
            Random random = new(seed);
            ClientSession player = group.Join(Honest, (ulong)seed);
            Assert.True(group.RunUntil(() => player.State == SessionState.Running));
            ulong session = 0;
            group.Network.Lose((from, _, datagram) =>
            {
                bool isIts = from == Honest && datagram.Span[3] == (byte)DatagramType.Update;
                session = isIts ? BitConverter.ToUInt64(datagram.Span[4..12]) : session;
                return false;
            });
            group.Run(3);
            Assert.NotEqual(0ul, session); // somebody on the way knows it
            for (int kind = 0; kind < Kinds.Length; kind++)
            {
                Spoofed spoofed = new(group, 900 + kind);
                for (int n = 0; n < 100; n++)
                {
                    spoofed.Send(Forged(random, session, kind));
                    group.Run(0.002);
                }

                group.Run(0.2);
                worst[kind] = Math.Max(worst[kind], (double)spoofed.BytesIn / spoofed.BytesOut);
                Assert.InRange(spoofed.BytesIn, 0, 3 * spoofed.BytesOut);
            }

            Assert.Equal((SessionState.Running, 0L), (player.State, player.Counters.Renewals));
        }

        Assert.True(worst[0] > 0.8); // a third are of another version, and answered with 41 bytes for 88
        string list = string.Join(", ", Kinds.Zip(worst, (kind, most) => $"{kind} {most:F2}"));
        output.WriteLine($"bytes out for bytes in before the address is confirmed, at most: {list}");

        // The same sum after it: the meter shows what a copy is beside the bytes that ask for it.
        (SessionGroup large, NatPort there) = Host(1, isLarge: true);
        Intruder confirmed = Intrude(large, there, 0, true);
        confirmed.ConnectRequest();
        large.Run(0.01);
        confirmed.Fetch();
        large.Run(0.01);
        Assert.True(confirmed.BytesIn > 3 * confirmed.BytesOut);
    }

    private static byte[] Forged(Random random, ulong session, int kind)
    {
        byte[] bytes = new byte[WireFormat.ConnectRequestBytes];
        Token128 token = new(Enumerable.Range(0, Token128.Bytes).Select(_ => (byte)random.Next(256)).ToArray());
        byte peer = (byte)random.Next(3);
        switch (kind)
        {
            case 0:
                new ConnectRequestDatagram((ulong)random.NextInt64()).Encode(bytes);
                bytes[2] = (byte)(random.Next(3) == 0 ? bytes[2] + 1 : bytes[2]); // of another version
                return bytes;
            case 1:
                bytes = new byte[WireFormat.JoinBytes];
                new JoinDatagram((ulong)random.NextInt64(), token, token, 0, (uint)Simulation.FoldVersion, peer, token).Encode(bytes);
                return bytes;
            case 2:
                ulong its = random.Next(2) == 0 ? session : (ulong)random.NextInt64();
                UpdateDatagram update = new() { SessionId = its, Peer = peer, Number = (uint)random.Next(1, 999), Ready = true };
                bytes = new byte[update.EncodedLength];
                update.Encode(bytes);
                return bytes;
            case 3:
                bytes = new byte[WireFormat.SnapshotRequestBytes];
                new SnapshotRequestDatagram(session, 0, 1 + (uint)random.Next(999), 0, ulong.MaxValue).Encode(bytes);
                return bytes;
            case 4:
                bytes = new byte[WireFormat.MoveBytes];
                new MoveDatagram(session, peer, token).Encode(bytes);
                return bytes;
            default:
                bytes = new byte[random.Next(1, 200)];
                random.NextBytes(bytes);
                return bytes;
        }
    }

    /// <summary>A host that runs a world, and sees its nodes behind their NATs.</summary>
    private static (SessionGroup Group, NatPort Nat) Host(int seed, int? perAddress = null, JoinLimits? limits = null, bool isLarge = false)
    {
        NatPort? nat = null;
        SessionGroup group = new(
            isLarge ? BuiltInScenes.Crowd(400) : ScriptedActions.Box(),
            1,
            LinkProfiles.FourG,
            (ulong)seed,
            _ => Options(),
            wrap: (node, port) => node == 0 ? nat = new NatPort(port) : port);
        group.Connect();
        return (group, nat!);

        HostOptions Options()
        {
            HostOptions options = new() { JoinLimits = limits ?? new JoinLimits() };
            return perAddress is int most ? options with { MaxClientsPerAddress = most } : options;
        }
    }

    private static Intruder Intrude(SessionGroup group, NatPort nat, int n, bool isOneMachine, bool sits = false)
    {
        nat.Place(Thousand + n, isOneMachine ? 1 : 2 + n, 2000 + n);
        return new Intruder(group, Thousand + n, sits);
    }

    /// <summary>
    /// How long an honest player on a 4G phone takes to get in while something goes on; infinite if it is not in after two seconds.
    /// </summary>
    private static double GetIn(SessionGroup group, NatPort nat, int seed, Action meanwhile, double each)
    {
        group.Run(new Random(seed).NextDouble() * 0.1);
        nat.Place(Honest, 5_000, 5000);
        ClientSession honest = group.Join(Honest, (ulong)seed);
        SimTime began = group.Clock.Now;
        SimTime next = began;
        bool isIn = group.RunUntil(
            () =>
            {
                for (; next <= group.Clock.Now; next += SimDuration.FromSeconds(each))
                {
                    meanwhile();
                }

                return honest.State is SessionState.Running or SessionState.Ended;
            },
            Within);
        return isIn && honest.State == SessionState.Running ? (group.Clock.Now - began).ToSeconds() : double.PositiveInfinity;
    }

    private void Report(string what, List<double> took, int expected = Seeds)
    {
        int got = took.Count(double.IsFinite);
        string most = got > 0 ? $", {took.Where(double.IsFinite).Max():F2} s at most" : "";
        output.WriteLine($"{what}: in within {Within} s in {got} of {took.Count} tries{most}");
        Assert.Equal(expected, got);
    }

    /// <summary>
    /// Somebody who sends in the name of an address and hears nothing of the answers; that address does, and did not ask.
    /// </summary>
    private sealed class Spoofed(SessionGroup group, int node)
    {
        private readonly Net.Carriers.IDatagramPort port = group.Network.CreatePort(node);

        internal long BytesOut { get; private set; }

        internal long BytesIn => group.Network.Traffic(node).BytesReceived;

        internal void Send(byte[] bytes)
        {
            BytesOut += bytes.Length + PortTraffic.HeaderBytes;
            port.Send(bytes, Net.Carriers.PeerAddress.Virtual(0));
        }
    }
}
