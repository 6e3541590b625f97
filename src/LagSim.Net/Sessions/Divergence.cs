using System;
using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>
/// A client's first committed state that differs from the host's: since when, and which player event makes the difference, in both
/// versions.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class Divergence
{
    private readonly SimTime start;

    internal Divergence(
        SimTime start,
        SimTime after,
        in CommittedState own,
        ulong hostHash,
        IReadOnlyList<LogEntry> events,
        DivergenceFinding finding,
        LogEntry? hostVersion = null,
        LogEntry? ownVersion = null,
        bool hasOwnEffect = false)
    {
        this.start = start;
        After = after;
        At = own.Time;
        OwnHash = own.StateHash;
        HostHash = hostHash;
        Events = events;
        Finding = finding;
        HostVersion = hostVersion;
        OwnVersion = ownVersion;
        HasOwnEffect = hasOwnEffect;
    }

    /// <summary>
    /// The newest committed time at which the states agreed; before any, the tick before this peer's world begins. The cause lies after it.
    /// </summary>
    public SimTime After { get; }

    /// <summary>The committed time at which they differ.</summary>
    public SimTime At { get; }

    /// <summary>This peer's <see cref="CommittedState.StateHash"/> at that time.</summary>
    public ulong OwnHash { get; }

    /// <summary>The host's hash, as it reported it.</summary>
    public ulong HostHash { get; }

    /// <summary>
    /// The accepted events stamped between the two times that took effect in this peer's world, by stamp; in a very busy session only the
    /// newest.
    /// </summary>
    public IReadOnlyList<LogEntry> Events { get; }

    /// <summary>The finding so far.</summary>
    public DivergenceFinding Finding { get; }

    /// <summary>
    /// With <see cref="DivergenceFinding.EventDiffers"/>, the host's version of the first event that differs; null if the host has no such
    /// event.
    /// </summary>
    public LogEntry? HostVersion { get; }

    /// <summary>This peer's version of it, whatever its verdict here; null if this peer never received it.</summary>
    public LogEntry? OwnVersion { get; }

    /// <summary>
    /// Whether <see cref="OwnVersion"/> took effect in this peer's world. An accepted event without effect came too late for the history
    /// here.
    /// </summary>
    public bool HasOwnEffect { get; }

    /// <summary>All of it in sentences, with times since the start of the session.</summary>
    public override string ToString()
    {
        string since = After < start ? "from its beginning" : $"after T {Seconds(After)} s";
        string head = FormattableString.Invariant(
            $"The committed state at T {Seconds(At)} s differs from the host's. Its hash is {OwnHash:x16} here and {HostHash:x16} there. ")
            + $"It began to differ {since}; in between {Count()} of players took effect here. ";
        return head + Finding switch
        {
            DivergenceFinding.EventDiffers => $"The first that differs: at the host {Text(HostVersion, true)}; here {Text(OwnVersion, HasOwnEffect)}.",
            DivergenceFinding.EventsAgree => "The host has the same ones: its world made something else of them, or the hash that it told is not its world's."
                + " A replay of a recording of each tells which of the two departs from its own events.",
            DivergenceFinding.Forgotten => "Not all of them are still kept, so which one differs cannot be told.",
            DivergenceFinding.Unanswered => "The host did not tell its own.",
            DivergenceFinding.NotPromised => "With this strategy worlds need not agree.",
            _ => "The host is being asked for its own.",
        };
    }

    private string Count() => Events.Count == 1 ? "1 event" : FormattableString.Invariant($"{Events.Count} events");

    private string Seconds(SimTime time) => FormattableString.Invariant($"{(time - start).ToSeconds()}");

    private string Text(LogEntry? version, bool hasEffect) => version is not LogEntry entry ? "there is none"
        : FormattableString.Invariant($"entry {entry.Index} of the log, at T {Seconds(entry.Event.Time)} s, {entry}")
            + (!hasEffect && entry.IsAccepted ? ", which came too late for the history here and had no effect" : "");
}
