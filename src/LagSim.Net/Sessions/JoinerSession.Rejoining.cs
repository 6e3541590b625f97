using System;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <content>What a joiner does that lost its host, or its world: it asks to be let in again, as the same player, and gets a fresh copy.</content>
public sealed partial class JoinerSession
{
    /// <summary>
    /// A fresh copy that did not last this long was of no use: four dips of a link that has one each half minute. So many of those in a row end the session; one
    /// is enough where it is the link that does not keep up, since the next copy would come over the same link.
    /// </summary>
    private static readonly SimDuration UsefulFor = SimDuration.FromSeconds(120);

    private const int MostUseless = 3;

    private SimTime rejoining; // since when, by the own clock
    private SessionEnd rejoiningFor; // what the session ends by if it is not let in
    private SimTime renewed = SimTime.MinValue; // when it was last in again
    private int useless;

    /// <summary>
    /// Raised on the session's thread when this peer lost its host, or its world, and asks to be let in again: with why. <see cref="Session.Renewed"/> follows, or
    /// <see cref="Regained"/>, or the session ends. Handlers must not throw.
    /// </summary>
    public event Action<string>? Interrupted;

    /// <summary>
    /// Raised on the session's thread each time that the host gives this peer a number, with what shows that it is this player: <see cref="Pass"/>. That is before there
    /// is a world, so a program that keeps it at once can come back whenever it is killed. Handlers must not throw.
    /// </summary>
    public event Action<PlayerPass>? PassGiven;

    /// <summary>Raised on the session's thread when a host that had fallen silent was heard again before it let this peer go: all goes on. Handlers must not throw.</summary>
    public event Action? Regained;

    private protected override bool TryRenew(SessionEnd by, string why) => Options.RejoinTime > SimDuration.Zero && Rejoin(by, why, isLinkGood: false);

    /// <summary>Asks to be let in again, or ends the session where that is of no use or not wanted.</summary>
    /// <param name="by">What the session ends by then.</param>
    /// <param name="why">As a sentence.</param>
    /// <param name="isLinkGood">Whether all is well as soon as the host is heard again.</param>
    /// <returns>False if the session has ended.</returns>
    private bool Rejoin(SessionEnd by, string why, bool isLinkGood)
    {
        SimTime now = Clock.Now;
        if (State == SessionState.Rejoining)
        {
            return true;
        }

        bool isSilence = by is SessionEnd.HostSilent or SessionEnd.LetGo; // who stood still, or was cut off, has nothing against the copy it got
        useless = isSilence ? useless : renewed != SimTime.MinValue && now - renewed < UsefulFor ? useless + 1 : 0;
        bool isUseless = !isSilence && useless >= (by == SessionEnd.LinkTooSlow ? 1 : MostUseless);
        if (Options.RejoinTime == SimDuration.Zero || isUseless)
        {
            Farewell(); // or its place stays taken until the time-out
            if (isUseless)
            {
                why += useless == 1 ? " A fresh copy was of no use." : $" {useless} fresh copies in a row were of no use.";
            }

            End(by, why);
            return false;
        }

        rejoining = now;
        rejoiningFor = by;
        RenewedBecause = why;
        link = isLinkGood ? link : null;
        inquiry = null;
        attempt = new JoinAttempt(NextNonce(), now);
        State = SessionState.Rejoining;
        Interrupted?.Invoke(why);
        return true;
    }

    /// <summary>
    /// What a joiner does that was not let in: one that comes back after a restart, with its pass, asks for as long as one that lost its host; for it the host
    /// may stand still as well. Any other session ends.
    /// </summary>
    private void AskAgainOrEnd(SimTime now, SessionEnd by, string why)
    {
        if (Options.Pass.Number == 0 || now - began > Options.RejoinTime)
        {
            End(by, why);
        }
        else if (link is not null)
        {
            attempt = new JoinAttempt(NextNonce(), now); // what welcomed it is gone again
            link = null;
            State = SessionState.Joining;
        }
    }

    /// <summary>What is due while it asks.</summary>
    private void TendRejoining(SimTime now)
    {
        if (now - rejoining > Options.RejoinTime && attempt is not { IsWelcome: true }) // a copy may take longer than that
        {
            End(rejoiningFor, FormattableString.Invariant($"{RenewedBecause} It asked for {Options.RejoinTime.ToSeconds():0.###} s to be let in again, in vain."));
        }
        else if (attempt is not null && attempt.IsWelcome && link is not null && now - link.Heard > Options.Timeout)
        {
            attempt = new JoinAttempt(NextNonce(), now); // what welcomed it is gone again
            link = null;
        }
    }

    /// <summary>Goes on as before, since the host was heard again over the link that it had.</summary>
    private void Regain()
    {
        attempt = null;
        State = SessionState.Running;
        Regained?.Invoke();
    }

    /// <summary>Another number for an attempt, so that what answers an earlier one is told from what answers this. No secret: who saw one can tell the next.</summary>
    private ulong NextNonce() => nonce = (nonce * 6_364_136_223_846_793_005) + 1_442_695_040_888_963_407;
}
