using System;
using LagSim.Net.Sessions.Core;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>
/// What a client that does not run waits for, as a sentence: for a program that waits with it, and for the end if it does not get in.
/// </summary>
internal sealed class JoinProgress(
    JoinAttempts attempts, HostConnection connection, LastAnswer answer, SharedWorld world, SessionStatus status, bool isProtected)
{
    /// <summary>What this peer waits for.</summary>
    internal string WaitsFor(SimTime now) => status.IsRejoining ? $"{status.RejoiningBecause} {Stage(now)}" : Stage(now);

    /// <summary>The step of the join that is not done yet.</summary>
    internal string Stage(SimTime now) => attempts.Current switch
    {
        null => world.BeginsIn,
        { IsWelcome: false } => Asking(now - attempts.Since),
        { Download: SnapshotDownload download } => FormattableString.Invariant(
            $"This peer has {download.Received / 1000.0:0.#} of {download.Length / 1000.0:0.#} kB of the copy of the world.{download.Size.Sentence}"),
        { Clock: { IsReady: false } } => $"This peer measures the offset of its clock from that of the {connection.Name}.",
        { Seat: null } => $"The {connection.Name} has not given this peer a number yet.",
        _ => $"This peer is in. The {connection.Name} has not begun the session: it waits for other players.",
    };

    /// <summary>Says that nothing which the host has sent so far lets this peer in.</summary>
    /// <param name="asked">How long this peer has asked.</param>
    internal string NotLetIn(SimDuration asked)
    {
        string within = FormattableString.Invariant($"within {asked.ToSeconds():0.###} s.");
        return (IsAnswered ? $"The {connection.Name} answered, and did not let this peer in {within}" : $"No answer from the {connection.Name} {within}")
            + answer.Sentence;
    }

    /// <summary>Whether the host has answered. In a protected session the answer that a join waits for may be anybody's on the path.</summary>
    private bool IsAnswered => !isProtected && attempts.Current is { Joins: { Count: > 0 } };

    private string Asking(SimDuration asked) => asked < SimDuration.FromSeconds(1) && answer.Refusal is string refusal
        ? $"{refusal} This peer asks again each second."
        : (status.IsRejoining ? "Asking to be let in again."
            : IsAnswered ? $"The {connection.Name} answered, and has not let this peer in yet." : $"No answer from the {connection.Name} yet.") + answer.Sentence;
}
