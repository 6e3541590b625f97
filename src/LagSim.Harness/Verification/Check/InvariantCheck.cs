using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using System.Threading;
using LagSim.Net.Strategies;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>
/// The check of the one invariant by random sessions: whatever arrives when, every peer's world equals the reference, which has all events
/// on time, bit for bit.
/// </summary>
/// <remarks>
/// In virtual time. Each session is drawn from its own seed and played on one thread, so every figure except the time taken is the same in
/// every run.
/// </remarks>
public static class InvariantCheck
{
    /// <summary>The most failing sessions that are shrunk; the others are only named.</summary>
    public const int MaxShrunk = 3;

    /// <summary>Plays all sessions, several at a time.</summary>
    /// <param name="options">The options.</param>
    /// <param name="progress">Called from time to time on the caller's thread with the number of finished sessions; may be null.</param>
    /// <param name="cancellation">Ends it early, with a report of the sessions that were done by then; those in progress are given
    /// up.</param>
    /// <exception cref="ArgumentException">An option is out of range; the sentence names it.</exception>
    public static CheckReport Run(CheckOptions options, Action<int>? progress = null, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(options);
        ThrowIfInvalid(options);
        Stopwatch watch = Stopwatch.StartNew();
        (IReadOnlyList<CheckOutcome> played, IReadOnlyList<int> stopped) = ParallelPlay.Run(
            options.Sessions, options.Workers, "LagSim check", n => CheckSession.Play(SeedOf(n), options, cancellation), progress, cancellation);
        double seconds = watch.Elapsed.TotalSeconds;
        List<CheckFailure> failures = [];
        foreach (CheckOutcome failed in played.Where(o => o.Failure is not null))
        {
            bool isShrunk = failures.Count < MaxShrunk && options.ShrinkingPlays > 0 && !cancellation.IsCancellationRequested;
            CheckOutcome least = isShrunk ? Shrinking.Shrink(failed, options, cancellation) : failed;
            failures.Add(new CheckFailure(failed, least, isShrunk, Command(least, options, isShrunk)));
        }

        return new CheckReport(played, failures, options.Sessions, seconds) { StoppedSeeds = [.. stopped.Select(SeedOf)] };

        ulong SeedOf(int n) => unchecked(options.Seed + (ulong)n);
    }

    /// <summary>Returns the command that plays one session, or the parts of it in the options.</summary>
    internal static string Command(CheckOutcome of, CheckOptions options, bool isShrunk)
    {
        bool isPart = isShrunk || (options.Bodies ?? options.Events) is not null;
        string part = isPart ? $" --bodies {string.Join(',', of.Bodies)} --events {List(of.Actions)}" : "";
        string peers = options.FromPeers == CheckOptions.FewestPeers && options.ToPeers == CheckOptions.MaxPeers ? ""
            : options.FromPeers == options.ToPeers ? $" --peers {options.FromPeers}"
            : $" --peers {options.FromPeers}-{options.ToPeers}";
        string profile = options.Profile is LinkProfile link ? $" --profile {link.Name}" : "";
        string strategy = options.Strategy == LateEventStrategies.Default ? "" : $" --strategy {options.Strategy}";
        string rules = options.Rules switch { RulesOfSessions.All => " --rules all", RulesOfSessions.None => " --rules none", _ => "" };
        return $"lagsim check --seed {of.Seed} --sessions 1{peers}{profile}{strategy}{rules}{part}";
    }

    private static string List(IReadOnlyList<int> indices) => indices.Count == 0 ? "none" : string.Join(',', indices);

    private static void ThrowIfInvalid(CheckOptions options)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(options.Sessions, 1);
        ArgumentOutOfRangeException.ThrowIfLessThan(options.Workers, 1);
        if (options.FromPeers < CheckOptions.FewestPeers || options.ToPeers > CheckOptions.MaxPeers || options.FromPeers > options.ToPeers)
        {
            throw new ArgumentOutOfRangeException(
                nameof(options), $"{options.FromPeers}-{options.ToPeers}", $"A session has {CheckOptions.FewestPeers} to {CheckOptions.MaxPeers} peers, the"
                    + " host included.");
        }

        if (options.Sessions > 1 && (options.Bodies is not null || options.Events is not null))
        {
            throw new ArgumentException("Bodies and events are kept of one session alone: give its seed, and 1 session.", nameof(options));
        }
    }
}
