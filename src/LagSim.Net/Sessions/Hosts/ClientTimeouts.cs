using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Disconnects clients that fell silent, did not finish joining, agree on no fresh keys, or fell so far behind that a fresh snapshot is faster.
/// </summary>
internal sealed class ClientTimeouts
{
    /// <summary>The number of unacknowledged log entries above which a client is disconnected.</summary>
    private const int MaxUnacknowledged = 1 << 16;

    /// <summary>How long a welcomed client may stay silent before it is given up, or the timeout if that is shorter.</summary>
    private static readonly SimDuration SilentPlace = SimDuration.FromSeconds(5);

    private readonly ClientRoster roster;
    private readonly LogLines log;
    private readonly SimDuration timeout;
    private readonly double slowestCopy;
    private readonly SuspendDetector suspend;

    /// <param name="roster">The clients.</param>
    /// <param name="log">The log that they follow.</param>
    /// <param name="timeout">How long a client may be silent before it is given up.</param>
    /// <param name="slowestCopy">
    /// The rate at which a client on the slowest supported link downloads its snapshot, in bytes per second.
    /// </param>
    /// <param name="now">The time by the local clock.</param>
    internal ClientTimeouts(ClientRoster roster, LogLines log, SimDuration timeout, double slowestCopy, SimTime now)
    {
        this.roster = roster;
        this.log = log;
        this.timeout = timeout;
        this.slowestCopy = slowestCopy;
        suspend = new SuspendDetector(timeout / 2, now);
    }

    /// <summary>Whether a client has been silent for so long that it no longer counts as falling behind.</summary>
    internal bool IsSilent(Client client, SimTime now) => now - client.Link.Heard > timeout / 2;

    /// <summary>How long a client may take to join, given its snapshot.</summary>
    internal SimDuration TimeoutWithCopy(JoinSnapshot copy) =>
        timeout + SilentPlace + SimDuration.FromSeconds(copy.Bytes.Length / slowestCopy);

    /// <summary>
    /// When to look again at a client that is only waited for: once it is given up, or sooner, so that the pause does not look like a suspend
    /// of this machine.
    /// </summary>
    internal SimTime NextLook(Client client, SimTime now)
    {
        SimTime silent = client.Link.Heard + TimeoutWith(client);
        SimTime givenUp = client.Peer == 0 ? SimTime.Min(silent, client.Claim.Until) : silent;
        return SimTime.Min(givenUp + SimDuration.OneTick, now + (timeout / 4));
    }

    internal void Tend(SimTime now)
    {
        bool hasSlept = suspend.Look(now) > SimDuration.Zero; // this machine slept: the clients were not silent, the host did not listen
        for (int i = roster.All.Count - 1; i >= 0; i--)
        {
            Client client = roster.All[i];
            if (hasSlept)
            {
                client.NoteSilence();
                client.Link.NoteHeard(now);
                client.Link.Seal?.Keys.NoteSuspend(now);
            }

            client.Link.Seal?.Keys.Tend(now);
            if (WhyGivenUp(client, now) is LeaveReason why)
            {
                roster.Dismiss(client, why);
            }
        }
    }

    private LeaveReason? WhyGivenUp(Client client, SimTime now) =>
        now - client.Link.Heard > TimeoutWith(client) || (client.Peer == 0 && now > client.Claim.Until) ? LeaveReason.TimedOut
        : client.Link.Seal?.Keys.AreTooOld(now) == true ? LeaveReason.KeysTooOld
        : HasFallenBehind(client, now) ? LeaveReason.FellBehind
        : null;

    private SimDuration TimeoutWith(Client client) => client.HasWritten || timeout < SilentPlace ? timeout : SilentPlace;

    /// <summary>Whether a client is so far behind, without getting closer, that a fresh snapshot is faster.</summary>
    /// <remarks>
    /// Time counts only while the client is heard: one that stalls is silent rather than behind a slow link. A client with a large snapshot
    /// starts far behind, and catches up.
    /// </remarks>
    private bool HasFallenBehind(Client client, SimTime now)
    {
        SimDuration lag = client.Acknowledged < log.Count ? now - log.AddedAt(client.Acknowledged + 1) : SimDuration.Zero;
        bool isHeard = client.Peer > 0 && !IsSilent(client, now);
        return log.Count - client.Acknowledged > MaxUnacknowledged || (isHeard && client.CatchingUp.HasFailed(lag, now, timeout));
    }
}
