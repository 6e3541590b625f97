using System;
using System.Threading;
using LagSim.Time;

namespace LagSim.Net.Carriers;

/// <summary>The place of one connection among a limited number. Disposed, it is given back.</summary>
/// <remarks>
/// While it is safe, it gives way only to a machine that has fewer. While it is held, it does not give way at all. For any thread.
/// </remarks>
internal sealed class ConnectionPlace : IDisposable
{
    private readonly ConnectionLimiter limiter;
    private readonly Action end;
    private long safeUntil; // ticks of the limiter's clock
    private long heldUntil = SimTime.MinValue.Ticks; // the same

    internal ConnectionPlace(ConnectionLimiter limiter, PeerAddress machine, Action end) => (this.limiter, Machine, this.end) = (limiter, machine, end);

    /// <summary>The machine whose connection it is.</summary>
    internal PeerAddress Machine { get; }

    /// <summary>Until when it gives way only to a machine that has fewer.</summary>
    internal SimTime SafeUntil => SimTime.FromTicks(Interlocked.Read(ref safeUntil));

    /// <summary>Whether it gives way to nobody now.</summary>
    internal bool IsHeld(SimTime now) => Interlocked.Read(ref heldUntil) >= now.Ticks;

    /// <summary>Makes it safe for some time from now on, and no longer than that.</summary>
    internal void KeepSafe(SimDuration time) => Interlocked.Exchange(ref safeUntil, (limiter.Now + time).Ticks);

    /// <summary>Holds it for some time from now on.</summary>
    internal void Hold(SimDuration time)
    {
        KeepSafe(time);
        Interlocked.Exchange(ref heldUntil, (limiter.Now + time).Ticks);
    }

    /// <summary>Holds it for as long as the connection lasts.</summary>
    internal void Hold() => Interlocked.Exchange(ref heldUntil, SimTime.MaxValue.Ticks);

    /// <summary>Ends its connection: another has its place.</summary>
    internal void End() => end();

    public void Dispose() => limiter.Leave(this);
}
