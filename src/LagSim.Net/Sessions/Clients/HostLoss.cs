using System;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>
/// Rejoins the session after a client has lost its host or its world: it asks to be let in again as the same player and downloads a fresh
/// snapshot. Where rejoining is disabled or pointless, it ends the session.
/// </summary>
internal sealed class HostLoss(
    JoinAttempts attempts, HostConnection connection, JoinProgress progress, LastAnswer answer, SharedWorld world, SessionStatus status,
    SessionCounters counters, IClock clock, ClientOptions options)
{
    private const int MaxFailedAttempts = 3;

    /// <summary>
    /// A fresh snapshot that did not last this long was useless. The value spans four dips of a link that dips every 30 s.
    /// </summary>
    /// <remarks>
    /// <see cref="MaxFailedAttempts"/> useless ones in a row end the session; a single one does when the link is too slow, since the next
    /// snapshot would come over the same link.
    /// </remarks>
    private static readonly SimDuration UsefulFor = SimDuration.FromSeconds(120);

    private SimTime rejoining; // when it began, by the local clock
    private SessionEnd rejoiningFor; // how the session ends if it is not let in
    private SimTime renewed = SimTime.MinValue; // when this peer last got back in
    private int useless;

    /// <summary>Raised when this peer begins to ask to be let in again, with the reason.</summary>
    internal event Action<string>? Interrupted;

    /// <summary>Raised when a silent host answers again before it has disconnected this peer.</summary>
    internal event Action? Regained;

    /// <summary>That the link got no fresh keys, as both ends say it.</summary>
    internal string NoFreshKeys =>
        FormattableString.Invariant($"The {connection.Name} agreed on no fresh keys for {LinkKeys.MaxAge.ToSeconds():0} s.");

    private string Silence =>
        FormattableString.Invariant($"The {connection.Name} fell silent for {options.Timeout.ToSeconds():0.###} s.");

    /// <summary>How long a joining client that was pushed out keeps asking.</summary>
    private SimDuration LongestComing => options.RejoinTime > options.Timeout ? options.RejoinTime : options.Timeout;

    /// <summary>Discounts a suspend of this machine: the host was not silent meanwhile.</summary>
    internal void NoteSuspend(SimDuration slept) => rejoining += slept;

    /// <summary>Records that this peer is back in.</summary>
    internal void NoteRenewed() => renewed = clock.Now;

    /// <summary>Rejoins or ends the session if the host has been silent for too long, or if asking has not helped.</summary>
    internal void Tend(SimTime now)
    {
        if (status.IsRejoining)
        {
            TendRejoining(now);
        }
        else if (now - (connection.Link?.Heard ?? attempts.Since) <= options.Timeout)
        {
            return;
        }
        else if (world.Live is null)
        {
            AskAgainOrEnd(now, SessionEnd.HostSilent, connection.Link is null ? NotLetIn(now) : $"{Silence} {progress.Stage(now)}");
        }
        else
        {
            Rejoin(SessionEnd.HostSilent, Silence, isLinkGood: true);
        }
    }

    internal void OnLeave(in LeaveDatagram leave)
    {
        if (connection.Link is UpdateLink link && leave.SessionId == link.SessionId && leave.Peer == 0)
        {
            Lose(leave.Reason, leave.Sentence);
        }
        else
        {
            counters.DatagramsIgnored++;
        }
    }

    /// <summary>Handles a host that says outside the link that it does not have this peer, and proves it.</summary>
    internal void OnReset(in ResetDatagram reset)
    {
        if (connection.Link is not UpdateLink { Seal: LinkSeal { IsWiped: false } seal } link || reset.SessionId != link.SessionId)
        {
            counters.DatagramsIgnored++;
        }
        else if (reset.Proof != ResetDatagram.Prove(seal.ResetKey, reset.Reason))
        {
            counters.DatagramsForged++;
        }
        else
        {
            Lose(reset.Reason, "");
        }
    }

    /// <summary>
    /// Asks for a fresh snapshot to replace an unusable world. Returns false if rejoining is disabled, or if it is pointless and the
    /// session has ended.
    /// </summary>
    internal bool TryRenew(SessionEnd by, string why) => options.RejoinTime > SimDuration.Zero && Rejoin(by, why, isLinkGood: false);

    /// <summary>Asks to be let in again, or ends the session where that is disabled or pointless.</summary>
    /// <param name="by">How the session ends in that case.</param>
    /// <param name="why">The reason, as a sentence.</param>
    /// <param name="isLinkGood">Whether hearing from the host again is enough to continue.</param>
    /// <returns>False if the session has ended.</returns>
    internal bool Rejoin(SessionEnd by, string why, bool isLinkGood)
    {
        SimTime now = clock.Now;
        if (status.IsRejoining)
        {
            return true;
        }

        // A client that stalled or was cut off has nothing to hold against its snapshot.
        bool isSilence = by is SessionEnd.HostSilent or SessionEnd.Disconnected;
        useless = isSilence ? useless : renewed != SimTime.MinValue && now - renewed < UsefulFor ? useless + 1 : 0;
        bool isUseless = !isSilence && useless >= (by == SessionEnd.LinkTooSlow ? 1 : MaxFailedAttempts);
        if (options.RejoinTime == SimDuration.Zero || isUseless)
        {
            connection.Farewell(isChosen: false); // otherwise its place stays taken until the timeout
            if (isUseless)
            {
                why += useless == 1 ? " A fresh copy was of no use." : $" {useless} fresh copies in a row were of no use.";
            }

            status.End(by, why);
            return false;
        }

        rejoining = now;
        rejoiningFor = by;
        if (!isLinkGood)
        {
            connection.Close();
        }

        attempts.Restart(now);
        status.Rejoin(why);
        Interrupted?.Invoke(why);
        return true;
    }

    /// <summary>Resumes if the host is heard from again over the existing link.</summary>
    internal void NoteHeard()
    {
        if (status.IsRejoining && attempts.IsAsking)
        {
            attempts.Finish();
            status.State = SessionState.Running;
            Regained?.Invoke();
        }
    }

    /// <summary>Handles a host that does not have this peer any more.</summary>
    private void Lose(LeaveReason reason, string said)
    {
        string why = Sentence(reason, said);
        SimTime now = clock.Now;
        bool isOver = reason is not (LeaveReason.TimedOut or LeaveReason.NotJoined or LeaveReason.FellBehind or LeaveReason.KeysTooOld);
        if (isOver)
        {
            SessionEnd by = reason == LeaveReason.HostEnded ? SessionEnd.HostEnded
                : reason == LeaveReason.HostFailed ? SessionEnd.HostFailed
                : reason == LeaveReason.Kicked ? SessionEnd.Kicked
                : SessionEnd.Disconnected;
            status.End(by, why);
        }
        else if (status.IsRejoining)
        {
            if (attempts.Current!.IsWelcome)
            {
                attempts.Restart(now);
            }

            connection.Close(); // the old link, or the one being set up, is over
        }
        else if (world.Live is not null)
        {
            Rejoin(reason == LeaveReason.FellBehind ? SessionEnd.LinkTooSlow : SessionEnd.Disconnected, why, isLinkGood: false);
        }
        else if (reason is LeaveReason.NotJoined or LeaveReason.TimedOut && attempts.Current?.IsWelcome == true
            && now - attempts.Began <= LongestComing)
        {
            AskAgain(now); // newer clients pushed it out, or it stalled, or this is another host
        }
        else
        {
            AskAgainOrEnd(now, SessionEnd.Disconnected, why);
        }
    }

    /// <summary>The periodic work while rejoining.</summary>
    private void TendRejoining(SimTime now)
    {
        bool isWelcome = attempts.Current is { IsWelcome: true };
        if (now - rejoining > options.RejoinTime && !isWelcome) // the download may take longer than that
        {
            status.End(rejoiningFor, FormattableString.Invariant(
                $"{status.RejoiningBecause} This peer asked for {options.RejoinTime.ToSeconds():0.###} s to be let in again, in vain.")
                + answer.Sentence);
        }
        else if (isWelcome && connection.Link is UpdateLink link && now - link.Heard > options.Timeout)
        {
            attempts.Restart(now); // the host that welcomed it is gone again
            connection.Close();
        }
    }

    /// <summary>
    /// Handles a client that was not let in. One that returns with a pass after a restart keeps asking as long as one that lost its host,
    /// since the host may be stalled too; any other session ends.
    /// </summary>
    private void AskAgainOrEnd(SimTime now, SessionEnd by, string why)
    {
        if (options.Pass.Number == 0 || now - attempts.Began > options.RejoinTime)
        {
            status.End(by, why);
        }
        else if (connection.Link is not null)
        {
            AskAgain(now); // the host that welcomed it is gone again
        }
    }

    private void AskAgain(SimTime now)
    {
        attempts.Restart(now);
        connection.Close();
        status.State = SessionState.Joining;
    }

    /// <summary>
    /// Names the longest time that certainly passed without an answer; a client with a pass asks for longer than the timeout.
    /// </summary>
    private string NotLetIn(SimTime now) =>
        progress.NotLetIn(options.Pass.Number > 0 && now - attempts.Since > options.RejoinTime ? LongestComing : options.Timeout);

    private string Sentence(LeaveReason reason, string said) => reason switch
    {
        LeaveReason.TimedOut => $"The {connection.Name} heard nothing from this peer for too long.",
        LeaveReason.Replaced => $"This player came in from elsewhere; the {connection.Name} let this peer go.",
        LeaveReason.NotJoined => $"The {connection.Name} does not have this peer among its clients, or no longer.",
        LeaveReason.FellBehind => FormattableString.Invariant(
            $"The link to the {connection.Name} is too slow: what happened {options.Timeout.ToSeconds():0.###} s ago")
            + " has not come over it yet.",
        LeaveReason.KeysTooOld => NoFreshKeys,
        LeaveReason.HostFailed => $"The {connection.Name} failed, and the session is over.{(said.Length == 0 ? "" : $" {said}")}",
        LeaveReason.Kicked => $"The {connection.Name} sent this player away.{(said.Length == 0 ? "" : $" {said}")}",
        _ => $"The {connection.Name} ended the session.",
    };
}
