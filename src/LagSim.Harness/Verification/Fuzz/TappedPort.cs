using System;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Fuzz;

/// <summary>A port that remembers what was sent through it and can replay any of it, from another thread.</summary>
internal sealed class TappedPort : IDatagramPort
{
    private const int Kept = 256;

    private readonly IDatagramPort inner;
    private readonly object gate = new();
    private readonly (byte[] Datagram, PeerAddress To)[] sent = new (byte[], PeerAddress)[Kept];
    private readonly SeededRandom random;
    private int count;

    internal TappedPort(IDatagramPort inner, ulong seed)
    {
        this.inner = inner;
        random = new SeededRandom(seed);
        inner.Arrived += () => Arrived?.Invoke();
    }

    public event Action? Arrived;

    public PeerAddress LocalAddress => inner.LocalAddress;

    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        lock (gate)
        {
            sent[count++ % Kept] = (datagram.ToArray(), to);
            inner.Send(datagram, to);
        }
    }

    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from) => inner.TryReceive(buffer, out length, out from);

    public void NoteSeated(PeerAddress peer) => inner.NoteSeated(peer);

    public void Dispose() => inner.Dispose();

    /// <summary>Replays one of the remembered datagrams to its original address; returns false if there is none yet.</summary>
    internal bool SendAgain()
    {
        lock (gate)
        {
            if (count == 0)
            {
                return false;
            }

            (byte[] datagram, PeerAddress to) = sent[(int)(random.NextUInt64() % (ulong)Math.Min(count, Kept))];
            inner.Send(datagram, to);
            return true;
        }
    }
}
