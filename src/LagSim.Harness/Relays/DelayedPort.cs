using System;
using System.Collections.Generic;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Relays;

/// <summary>
/// A port that simulates a slow link in real time: incoming datagrams of another port are delayed, lost or duplicated.
/// </summary>
/// <remarks>
/// <para>Only incoming datagrams are affected, so a link that is slow in both directions has one of these at each end. Each sender has its
/// own <see cref="LinkModel"/>.</para>
/// <para>A background thread waits, without spinning, for the next datagram that falls due and raises <see cref="Arrived"/>, late by the
/// operating system's timer: about 1 ms on Linux and macOS, up to 16 ms on Windows. <see cref="TryReceive"/> depends only on the
/// clock.</para>
/// <para>The inner port is called from that thread and the session's, but never at once. <see cref="Arrived"/> is raised outside all locks.
/// What happens to a datagram depends on the seed and the order of arrival; when it is due also depends on the clock.</para>
/// </remarks>
public sealed class DelayedPort : IDatagramPort
{
    private readonly IDatagramPort inner;
    private readonly IClock clock;
    private readonly object gate = new(); // guards calls of the inner port and all fields below
    private readonly HeldDatagrams held;
    private readonly Queue<(byte[] Datagram, PeerAddress From)> due = new(); // due datagrams for which Arrived was raised
    private readonly WorldThread? waiter; // woken outside the gate: a port may raise Arrived under a lock of its own
    private volatile bool disposed;

    /// <summary>Wraps <paramref name="inner"/>, with the same leg for the link of every sender.</summary>
    /// <param name="inner">The port to delay, which is owned and disposed with this one.</param>
    /// <param name="clock">The real-time clock, read from two threads.</param>
    /// <param name="leg">The leg of each link.</param>
    /// <param name="seed">The seed of all links. Senders get theirs in the order of their first datagrams.</param>
    public DelayedPort(IDatagramPort inner, IClock clock, LinkLeg leg, ulong seed)
        : this(inner, clock, HeldDatagrams.SameLegs(leg, seed), waits: true)
    {
    }

    /// <summary>
    /// Wraps <paramref name="inner"/>, with a link for each sender from <paramref name="linkFrom"/>.
    /// </summary>
    /// <param name="inner">The port to delay, which is owned and disposed with this one.</param>
    /// <param name="clock">The real-time clock, read from two threads.</param>
    /// <param name="linkFrom">Called once for each new sender to get its link.</param>
    internal DelayedPort(IDatagramPort inner, IClock clock, Func<PeerAddress, LinkModel> linkFrom)
        : this(inner, clock, linkFrom, waits: true)
    {
    }

    /// <summary>As the others. Without a thread, the caller has to call <see cref="Poll"/>.</summary>
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
                waiter?.Wake(); // its wait may have changed because of what was taken
            }

            // Everything in the queue was due before anything that is still held.
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

    /// <inheritdoc/>
    public void NoteSeated(PeerAddress peer) => inner.NoteSeated(peer);

    /// <summary>Stops at once. Held datagrams are lost.</summary>
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
            waiter.Dispose(); // also from a handler of Arrived
        }

        inner.Dispose();
    }

    /// <summary>Takes what the inner port has, and raises <see cref="Arrived"/> if a datagram fell due.</summary>
    /// <returns>The time at which the next held datagram is due; null when none is held.</returns>
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
