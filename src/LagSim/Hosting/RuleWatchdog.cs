using System;
using System.Diagnostics;
using System.Threading;
using LagSim.Rules;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>Ends a world whose rules never return from a call: it looks at times which call runs, from outside of the world's
/// thread.</summary>
/// <remarks>
/// <para>Sessions and <see cref="SimulationHost"/> have one. It is for who keeps a <see cref="LiveWorld"/> himself.</para>
/// <para>It counts looks and reads no clock: the same call in <see cref="LooksToGiveUp"/> looks after the first has run for the limit. So a
/// process that was stopped meanwhile, by a debugger or by the system, counts as a single look.</para>
/// <para>First the call is given up, so that all it asks of the world throws, and the world ends on its own thread. If the thread is still
/// in the call <see cref="LooksToAbandon"/> looks later and somebody can do without it, it is abandoned: .NET can end no thread.</para>
/// <para>Thread-safe. Once started it is held by its timer only weakly, so it goes with the world that nobody has any more.</para>
/// </remarks>
public sealed class RuleWatchdog : IDisposable
{
    /// <summary>How long a call may take by default: 10 s.</summary>
    public static readonly SimDuration DefaultLimit = SimDuration.FromSeconds(10);

    /// <summary>The shortest limit: 100 ms.</summary>
    public static readonly SimDuration MinLimit = SimDuration.FromMilliseconds(100);

    /// <summary>The longest limit: 10 min.</summary>
    public static readonly SimDuration MaxLimit = SimDuration.FromSeconds(600);

    /// <summary>How many looks the limit has.</summary>
    public const int LooksToGiveUp = 10;

    /// <summary>How many looks a call that was given up has until its thread is abandoned.</summary>
    public const int LooksToAbandon = 5;

    private readonly object looking = new();
    private Action<SimulationException>? abandoned;
    private Timer? timer;
    private long seen; // the number of the call that the last look saw; 0 for none
    private int looks; // how many looks since the first that saw it, or since it was given up
    private bool isDisposed;

    /// <summary>A watchdog for one world, which is given it. It does not look by itself yet.</summary>
    /// <param name="limit">How long a call may take, <see cref="MinLimit"/> to <see cref="MaxLimit"/> of real time; default
    /// <see cref="DefaultLimit"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The limit is out of its range.</exception>
    public RuleWatchdog(SimDuration? limit = null)
    {
        SimDuration given = limit ?? DefaultLimit;
        if (given < MinLimit || given > MaxLimit)
        {
            throw new ArgumentOutOfRangeException(nameof(limit), given.ToShortString(), "A call of rules may take from 100 ms to 600 s.");
        }

        Running = new RunningRuleCall(given);
    }

    /// <summary>The call that the world is in.</summary>
    internal RunningRuleCall Running { get; }

    /// <summary>
    /// Called once if the world's thread is given up, on the thread that looks, with the sentence that says why; null, the default, if the
    /// program cannot do without that thread. It never comes back then, and may hold locks for good. Must not throw.
    /// </summary>
    public Action<SimulationException>? Abandoned
    {
        get => Volatile.Read(ref abandoned);
        set => Volatile.Write(ref abandoned, value);
    }

    /// <summary>Has it look by itself from now on, <see cref="LooksToGiveUp"/> times in the limit, on a thread of the pool. Calling it
    /// again has no effect.</summary>
    public void Start()
    {
        lock (looking)
        {
            if (timer is null && !isDisposed)
            {
                WeakReference<RuleWatchdog> weak = new(this);
                int period = (int)Math.Ceiling((Running.Limit / LooksToGiveUp).ToMilliseconds());
                Timer? made = null;
                made = new Timer(_ => LookIfThere(weak, made), null, Timeout.Infinite, Timeout.Infinite);
                timer = made;
                made.Change(period, period);
            }
        }
    }

    /// <summary>Looks which call runs, and ends what has run for too long. From any thread; cost: some loads and a lock.</summary>
    public void Look()
    {
        if (IsGivenUpNow())
        {
            Write(Running.Sentence());
        }
        else if (IsAbandonedNow(out Action<SimulationException>? handler))
        {
            handler!(new SimulationException(
                $"{Running.Sentence()} Its thread could not be ended, and is left to itself until the process ends."));
        }
    }

    /// <summary>Stops looking.</summary>
    public void Dispose()
    {
        lock (looking)
        {
            isDisposed = true;
            timer?.Dispose();
        }
    }

    private bool IsGivenUpNow()
    {
        lock (looking)
        {
            long now = Running.Number;
            looks = now == seen || Running.IsGivenUp ? looks + 1 : 0;
            seen = now;
            if (isDisposed || now == 0 || looks < LooksToGiveUp || !Running.TryGiveUp(now))
            {
                return false;
            }

            looks = 0;
            return true;
        }
    }

    private bool IsAbandonedNow(out Action<SimulationException>? handler)
    {
        lock (looking)
        {
            handler = Abandoned;
            return !isDisposed && handler is not null && Running.IsGivenUp && looks >= LooksToAbandon && Running.TryAbandon();
        }
    }

    private static void LookIfThere(WeakReference<RuleWatchdog> weak, Timer? timer)
    {
        if (weak.TryGetTarget(out RuleWatchdog? watchdog))
        {
            watchdog.Look();
        }
        else
        {
            timer?.Dispose();
        }
    }

    // Where no other thread can end a session, as a polled one, this is all that its program hears.
    private static void Write(string line)
    {
        try
        {
            Trace.TraceError(line);
        }
        catch (Exception failure) when (failure is not OutOfMemoryException)
        {
            // Listeners are anybody's and may throw.
        }
    }
}
