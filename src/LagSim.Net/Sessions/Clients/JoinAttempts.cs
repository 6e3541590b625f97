using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>A client's tries to come in, one after the other: the one that is going on, and since when it has asked.</summary>
internal sealed class JoinAttempts
{
    private ulong nonce; // of the newest attempt
    private SimTime awake = SimTime.MinValue; // own clock, when this machine last woke, if it slept

    /// <param name="nonce">A number chosen at random; an answer to the first try must bear it.</param>
    /// <param name="now">By the own clock.</param>
    internal JoinAttempts(ulong nonce, SimTime now)
    {
        this.nonce = nonce;
        Current = new JoinAttempt(nonce, now);
    }

    /// <summary>The try that is going on; null once this peer is in.</summary>
    internal JoinAttempt? Current { get; private set; }

    /// <summary>Whether there is a try that the host has not welcomed.</summary>
    internal bool IsAsking => Current is { IsWelcome: false };

    /// <summary>
    /// When this peer first asked, by the own clock; later by as long as its machine slept, for nobody was silent meanwhile.
    /// </summary>
    internal SimTime Began { get; private set; } = SimTime.MaxValue;

    /// <summary>Since when there may have been an answer to what is asked now.</summary>
    internal SimTime Since => SimTime.Max(awake, SimTime.Max(Began, Current?.Began ?? Began));

    /// <summary>Notes that the first step is done.</summary>
    internal void Begin(SimTime now) => Began = Began == SimTime.MaxValue ? now : Began;

    /// <summary>Notes that this machine slept for so long.</summary>
    internal void NoteSuspend(SimDuration slept, SimTime now)
    {
        Began += slept;
        awake = now;
    }

    /// <summary>Begins another try, from a time on.</summary>
    internal void Restart(SimTime from) => Current = new JoinAttempt(NextNonce(), from);

    /// <summary>This peer is in.</summary>
    internal void Finish() => Current = null;

    /// <summary>
    /// Another number for an attempt, so that what answers an earlier one is told from what answers this. No secret: who saw one can tell
    /// the next.
    /// </summary>
    private ulong NextNonce() => nonce = (nonce * 6_364_136_223_846_793_005) + 1_442_695_040_888_963_407;
}
