using System;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>
/// What a client does that lost its host, or its world: it asks to be let in again, as the same player, and gets a fresh copy. Where that
/// is of no use or not
/// wanted the session ends.
/// </summary>
internal sealed class HostLoss(
    JoinAttempts attempts, HostConnection connection, SharedWorld world, SessionStatus status, SessionCounters counters,
    IClock clock, ClientOptions options)
{
    private const int MostUseless = 3;

    /// <summary>
    /// A fresh copy that did not last this long was of no use: four dips of a link that has one each half minute. So many of those in a row
    /// end the session; one
    /// is enough where it is the link that does not keep up, since the next copy would come over the same link.
    /// </summary>
    private static readonly SimDuration UsefulFor = SimDuration.FromSeconds(120);

    private SimTime rejoining; // since when, by the own clock
    private SessionEnd rejoiningFor; // what the session ends by if it is not let in
    private SimTime renewed = SimTime.MinValue; // when it was last in again
    private int useless;

    /// <summary>Raised when this peer begins to ask to be let in again, with why.</summary>
    internal event Action<string>? Interrupted;

    /// <summary>Raised when a host that had fallen silent was heard again before it disconnected this peer.</summary>
    internal event Action? Regained;

    private string Silence =>
        FormattableString.Invariant($"The host at {connection.Host} fell silent for {options.Timeout.ToSeconds():0.###} s.");

    /// <summary>How long one that is coming in, and is pushed out, asks again.</summary>
    private SimDuration LongestComing => options.RejoinTime > options.Timeout ? options.RejoinTime : options.Timeout;

    /// <summary>Notes that this machine slept for so long: nobody was silent meanwhile.</summary>
    internal void NoteSuspend(SimDuration slept) => rejoining += slept;

    /// <summary>Notes that this peer is in again.</summary>
    internal void NoteRenewed() => renewed = clock.Now;

    /// <summary>Sees to it that the host has not been silent for too long, or that asking for it is not in vain.</summary>
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
            AskAgainOrEnd(now, SessionEnd.HostSilent, connection.Link is null ? NoAnswer(now) : Silence);
        }
        else
        {
            Rejoin(SessionEnd.HostSilent, Silence, isLinkGood: true);
        }
    }

    internal void OnLeave(in LeaveDatagram leave)
    {
        if (connection.Link is not UpdateLink link || leave.SessionId != link.SessionId || leave.Peer != 0)
        {
            counters.DatagramsIgnored++;
            return;
        }

        string why = Sentence(leave.Reason);
        SimTime now = clock.Now;
        bool isOver = leave.Reason is not (LeaveReason.TimedOut or LeaveReason.NotJoined or LeaveReason.FellBehind);
        if (isOver)
        {
            SessionEnd by = leave.Reason == LeaveReason.HostEnded ? SessionEnd.HostEnded
                : leave.Reason == LeaveReason.Kicked ? SessionEnd.Kicked
                : SessionEnd.Disconnect;
            status.End(by, why);
        }
        else if (status.IsRejoining)
        {
            if (attempts.Current!.IsWelcome)
            {
                attempts.Restart(now);
            }

            connection.Close(); // what it was is over, or what it was about to be
        }
        else if (world.Live is not null)
        {
            Rejoin(leave.Reason == LeaveReason.FellBehind ? SessionEnd.LinkTooSlow : SessionEnd.Disconnect, why, isLinkGood: false);
        }
        else if (leave.Reason is LeaveReason.NotJoined or LeaveReason.TimedOut && attempts.Current?.IsWelcome == true
            && now - attempts.Began <= LongestComing)
        {
            AskAnew(now); // others who came in pushed it out, or it stood still, or the host is another one
        }
        else
        {
            AskAgainOrEnd(now, SessionEnd.Disconnect, why);
        }
    }

    /// <summary>
    /// Asks for a fresh copy in place of a world that cannot be gone on with; false where none is wanted, or none is of use and the session
    /// has ended.
    /// </summary>
    internal bool TryRenew(SessionEnd by, string why) => options.RejoinTime > SimDuration.Zero && Rejoin(by, why, isLinkGood: false);

    /// <summary>Asks to be let in again, or ends the session where that is of no use or not wanted.</summary>
    /// <param name="by">What the session ends by then.</param>
    /// <param name="why">As a sentence.</param>
    /// <param name="isLinkGood">Whether all is well as soon as the host is heard again.</param>
    /// <returns>False if the session has ended.</returns>
    internal bool Rejoin(SessionEnd by, string why, bool isLinkGood)
    {
        SimTime now = clock.Now;
        if (status.IsRejoining)
        {
            return true;
        }

        // Who stood still, or was cut off, has nothing against the copy it got.
        bool isSilence = by is SessionEnd.HostSilent or SessionEnd.Disconnect;
        useless = isSilence ? useless : renewed != SimTime.MinValue && now - renewed < UsefulFor ? useless + 1 : 0;
        bool isUseless = !isSilence && useless >= (by == SessionEnd.LinkTooSlow ? 1 : MostUseless);
        if (options.RejoinTime == SimDuration.Zero || isUseless)
        {
            connection.Farewell(); // or its place stays taken until the time-out
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

    /// <summary>Goes on as before if the host is heard again over the link that it had.</summary>
    internal void NoteHeard()
    {
        if (status.IsRejoining && attempts.IsAsking)
        {
            attempts.Finish();
            status.State = SessionState.Running;
            Regained?.Invoke();
        }
    }

    /// <summary>What is due while it asks.</summary>
    private void TendRejoining(SimTime now)
    {
        bool isWelcome = attempts.Current is { IsWelcome: true };
        if (now - rejoining > options.RejoinTime && !isWelcome) // a copy may take longer than that
        {
            status.End(rejoiningFor, FormattableString.Invariant(
                $"{status.RejoiningBecause} It asked for {options.RejoinTime.ToSeconds():0.###} s to be let in again, in vain."));
        }
        else if (isWelcome && connection.Link is UpdateLink link && now - link.Heard > options.Timeout)
        {
            attempts.Restart(now); // what welcomed it is gone again
            connection.Close();
        }
    }

    /// <summary>
    /// What a client does that was not let in: one that comes back after a restart, with its pass, asks for as long as one that lost its
    /// host; for it the host
    /// may stand still as well. Any other session ends.
    /// </summary>
    private void AskAgainOrEnd(SimTime now, SessionEnd by, string why)
    {
        if (options.Pass.Number == 0 || now - attempts.Began > options.RejoinTime)
        {
            status.End(by, why);
        }
        else if (connection.Link is not null)
        {
            AskAnew(now); // what welcomed it is gone again
        }
    }

    private void AskAnew(SimTime now)
    {
        attempts.Restart(now);
        connection.Close();
        status.State = SessionState.Joining;
    }

    /// <summary>
    /// Names the longest of the times for which there was certainly no answer: who has a pass asks for more than the time-out.
    /// </summary>
    private string NoAnswer(SimTime now)
    {
        SimDuration named = options.Pass.Number > 0 && now - attempts.Since > options.RejoinTime ? LongestComing : options.Timeout;
        return FormattableString.Invariant($"No answer from {connection.Host} within {named.ToSeconds():0.###} s.");
    }

    private string Sentence(LeaveReason reason) => reason switch
    {
        LeaveReason.TimedOut => $"The host at {connection.Host} heard nothing from this peer for too long.",
        LeaveReason.Replaced => $"This player came in from elsewhere; the host at {connection.Host} let this peer go.",
        LeaveReason.NotJoined => $"The host at {connection.Host} does not have this peer among its clients, or no longer.",
        LeaveReason.FellBehind => FormattableString.Invariant(
            $"The link to the host at {connection.Host} is too slow: what happened {options.Timeout.ToSeconds():0.###} s ago")
            + " has not come over it yet.",
        LeaveReason.Kicked => $"The host at {connection.Host} sent this player away.",
        _ => $"The host at {connection.Host} ended the session.",
    };
}
