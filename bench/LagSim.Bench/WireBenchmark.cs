using System;
using BenchmarkDotNet.Attributes;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>What a datagram costs to write and to read: a keep-alive, and one with ten events.</summary>
[MemoryDiagnoser]
public class WireBenchmark
{
    private readonly byte[] buffer = new byte[WireFormat.MaxBytes];
    private readonly UpdateDatagram incoming = new();
    private UpdateDatagram outgoing = new();
    private byte[] bytes = [];

    [Params(0, 10)]
    public int Events { get; set; }

    [GlobalSetup]
    public void Fill()
    {
        outgoing = new UpdateDatagram { SessionId = 1, Peer = 1, Number = 7, Sent = SimTime.FromSeconds(3), EchoNumber = 6, EchoReceived = SimTime.FromSeconds(2.5), FirstIndex = 1 };
        for (uint n = 1; n <= Events; n++)
        {
            outgoing.TryAdd(Verdict.Pending, ExternalEvent.Teleport(SimTime.FromSeconds(3), 1, n, BodyId.OfScene(0), new Vector3D(1, 2, 3), new Vector3D(4, 5, 6)));
        }

        bytes = buffer.AsSpan(0, outgoing.Encode(buffer)).ToArray();
    }

    [Benchmark(Baseline = true)]
    public int Encode() => outgoing.Encode(buffer);

    [Benchmark]
    public bool Decode() => incoming.TryDecode(bytes, out _);
}
