using System;
using System.Collections.Generic;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Relays;

/// <summary>
/// A port that makes a fast link look like a slow one in real time: what comes in by another port is held, lost or doubled first.
/// </summary>
/// <remarks>
/// <para>Only what comes in is touched, so a link that is slow both ways has one of these at each end. Each sender has its own
/// <see cref="LinkModel"/>.</para>
/// <para>A thread of its own waits, without spinning, for the next datagram that falls due and raises <see cref="Arrived"/>, late by the
/// operating system's timer: about 1 ms on Linux and macOS, up to 16 ms on Windows. <see cref="TryReceive"/> goes by the clock
/// alone.</para>
/// <para>The inner port is called from that thread and the session's, but never at once. <see cref="Arrived"/> is raised outside all
/// locks. Which luck a datagram meets depends on the seed and the order of arrival; when it is due also on the clock.</para>
/// </remarks>
public sealed class DelayedPort : IDatagramPort
{
    private readonly IDatagramPort inner;
    private readonly IClock clock;
    private readonly object gate = new(); // guards the inner port's calls and all fields below
    private readonly HeldDatagrams held;
    private readonly Queue<(byte[] Datagram, PeerAddress From)> due = new(); // was held, and Arrived raised for it
    private readonly WorldThread? waiter; // woken without the gate: a port may raise Arrived under a lock of its own
    private volatile bool disposed;

    /// <summary>Holds what comes in by <paramref name="inner"/>, from every sender by a link of that leg.</summary>
    /// <param name="inner">The port to slow down; it is owned, and disposed with this one.</param>
    /// <param name="clock">Real time, read from two threads.</param>
    /// <param name="leg">What each link does.</param>
    /// <param name="seed">The luck of all links; senders get theirs in the order in which they are first heard of.</param>
    public DelayedPort(IDatagramPort inner, IClock clock, LinkLeg leg, ulong seed)
        : this(inner, clock, HeldDatagrams.SameLegs(leg, seed), waits: true)
    {
    }

    /// <summary>
    /// Holds what comes in by <paramref name="inner"/>, from each sender by the link that <paramref name="linkFrom"/> makes for it.
    /// </summary>
    /// <param name="inner">The port to slow down; it is owned, and disposed with this one.</param>
    /// <param name="clock">Real time, read from two threads.</param>
    /// <param name="linkFrom">Called once for each sender.</param>
    internal DelayedPort(IDatagramPort inner, IClock clock, Func<PeerAddress, LinkModel> linkFrom)
        : this(inner, clock, linkFrom, waits: true)
    {
    }

    /// <summary>As the others; without a thread, <see cref="Poll"/> does what it would.</summary>
    internal DelayedPort(IDatagramPort inner, IClock clock, Func<PeerAddress, LinkModel> linkFrom, bool waits)
    {
        ArgumentNullException.ThrowIfNull(inner);
        ArgumentNullException.ThrowIfNull(clock);
        ArgumentNullException.ThrowIfNull(linkFrom);
        this.inner = inner;
        this.clock = clock;
        held = new HeldDatagrams(linkFrom);
        if (waits)
        {
            waiter = new WorldThread("LagSim delayed port", Announce);
            inner.Arrived += waiter.Wake;
            waiter.Start();
        }
    }

    /// <inheritdoc/>
    public event Action? Arrived;

    /// <inheritdoc/>
    public PeerAddress LocalAddress => inner.LocalAddress;

    /// <inheritdoc/>
    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        lock (gate)
        {
            ObjectDisposedException.ThrowIf(disposed, this);
            inner.Send(datagram, to);
        }
    }

    /// <inheritdoc/>
    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
    {
        lock (gate)
        {
            length = 0;
            from = default;
            if (disposed)
            {
                return false;
            }

            SimTime now = clock.Now;
            if (held.TakeFrom(inner, now))
            {
                waiter?.Wake(); // it may not know of what was taken, and how long it must wait has changed
            }

            // What is in the queue was due before anything that is still held.
            if (!due.TryDequeue(out (byte[] Datagram, PeerAddress From) next) && !held.TryDequeueDue(now, out next))
            {
                return false;
            }

            next.Datagram.CopyTo(buffer);
            length = next.Datagram.Length;
            from = next.From;
            return true;
        }
    }

    /// <summary>Stops at once; what is still held is lost.</summary>
    public void Dispose()
    {
        lock (gate)
        {
            if (disposed)
            {
                return;
            }

            disposed = true;
        }

        if (waiter is not null)
        {
            inner.Arrived -= waiter.Wake;
            waiter.Dispose(); // from a handler of Arrived too
        }

        inner.Dispose();
    }

    /// <summary>Takes in what the inner port has and raises <see cref="Arrived"/> if something fell due.</summary>
    /// <returns>When the next held datagram is due; null when none is held.</returns>
    internal SimTime? Poll()
    {
        bool announce = false;
        SimTime? next;
        lock (gate)
        {
            if (disposed)
            {
                return null;
            }

            SimTime now = clock.Now;
            held.TakeFrom(inner, now);
            while (held.TryDequeueDue(now, out (byte[] Datagram, PeerAddress From) datagram))
            {
                due.Enqueue(datagram);
                announce = true;
            }

            next = held.NextDue;
        }

        if (announce)
        {
            Arrived?.Invoke();
        }

        return next;
    }

    private SimDuration Announce() => Poll() is SimTime next ? next - clock.Now : SimDuration.MaxValue;
}
