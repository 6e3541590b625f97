using System;
using LagSim.Net.Carriers;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Links;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>The parts that host and client sessions have in common, created and wired up once.</summary>
internal sealed class SessionParts
{
    /// <summary>The latest clock reading at which a session can start or run: 23 days.</summary>
    // A clock estimate accepts readings of up to 24 days.
    internal static readonly SimTime MaxClock = SimTime.FromSeconds(2_000_000);

    internal SessionParts(Scene? scene, IDatagramPort port, IClock clock, SessionOptions options, SessionState first)
    {
        Port = port ?? throw new ArgumentNullException(nameof(port));
        Clock = clock ?? throw new ArgumentNullException(nameof(clock));
        Options = options ?? throw new ArgumentNullException(nameof(options));
        options.Check();
        if (clock.Now > MaxClock)
        {
            throw new ArgumentException(
                FormattableString.Invariant($"The clock reads {clock.Now.ToSeconds():F0} s; a session takes one that reads less than")
                    + FormattableString.Invariant($" {MaxClock.ToSeconds():F0} s. Make a new one."),
                nameof(clock));
        }

        SharedTime = new SharedClock(clock);
        Status = new SessionStatus(first);
        World = new SharedWorld(scene, options, clock, SharedTime, Counters);
        Commits = new CommitTracker(World, SharedTime, Status, Counters, options.ExtraHistory);
        Start = new WorldStart(World, Commits, Journal, Status, Counters, options.CommitInterval);
        Actions = new LocalActions(Self, Status, SharedTime, World);
        Sender = new DatagramSender(port, Counters);
        Links = new LinkFactory(options.ResendInterval) { BytesPerSecond = (options as HostOptions)?.MaxBytesPerSecond ?? double.PositiveInfinity };
        KeepAlive = new KeepAlivePolicy(options.KeepAlive, options.ResendInterval);
    }

    internal IDatagramPort Port { get; }

    internal IClock Clock { get; }

    internal SessionOptions Options { get; }

    internal SessionCounters Counters { get; } = new();

    internal SessionOwner Owner { get; } = new();

    internal PlayerIdentity Self { get; } = new();

    internal EventJournal Journal { get; } = new();

    internal PeerRoster Peers { get; } = new();

    internal SharedClock SharedTime { get; }

    internal SessionStatus Status { get; }

    internal SharedWorld World { get; }

    internal CommitTracker Commits { get; }

    internal WorldStart Start { get; }

    internal LocalActions Actions { get; }

    internal DatagramSender Sender { get; }

    internal LinkFactory Links { get; }

    internal KeepAlivePolicy KeepAlive { get; }
}
