using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>A client's attempts to join, one after the other: the current one, and since when it has been asking.</summary>
internal sealed class JoinAttempts
{
    private ulong nonce; // of the newest attempt
    private SimTime awake = SimTime.MinValue; // local clock; when this machine last woke from a suspend

    /// <param name="nonce">A random number; an answer to the first attempt must carry it.</param>
    /// <param name="now">The time by the local clock.</param>
    internal JoinAttempts(ulong nonce, SimTime now)
    {
        this.nonce = nonce;
        Current = new JoinAttempt(nonce, now);
    }

    /// <summary>The current attempt; null once this peer is in.</summary>
    internal JoinAttempt? Current { get; private set; }

    /// <summary>Whether there is an attempt that the host has not welcomed.</summary>
    internal bool IsAsking => Current is { IsWelcome: false };

    /// <summary>When this peer first asked, by the local clock, with any suspend of this machine discounted.</summary>
    internal SimTime Began { get; private set; } = SimTime.MaxValue;

    /// <summary>The earliest time at which the current question can have been answered.</summary>
    internal SimTime Since => SimTime.Max(awake, SimTime.Max(Began, Current?.Began ?? Began));

    /// <summary>Called at the first step.</summary>
    internal void Begin(SimTime now) => Began = Began == SimTime.MaxValue ? now : Began;

    /// <summary>Discounts a suspend of this machine.</summary>
    internal void NoteSuspend(SimDuration slept, SimTime now)
    {
        Began += slept;
        awake = now;
    }

    /// <summary>Begins another attempt at a given time.</summary>
    internal void Restart(SimTime from)
    {
        Current?.Dispose();
        Current = new JoinAttempt(NextNonce(), from);
    }

    /// <summary>Called when this peer is in, or will not be.</summary>
    internal void Finish()
    {
        Current?.Dispose();
        Current = null;
    }

    /// <summary>
    /// Returns another nonce, to tell answers to this attempt from answers to earlier ones. It is not secret: anyone who saw one can
    /// compute the next.
    /// </summary>
    private ulong NextNonce() => nonce = (nonce * 6_364_136_223_846_793_005) + 1_442_695_040_888_963_407;
}
