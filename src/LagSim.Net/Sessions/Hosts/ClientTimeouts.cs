using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Lets go of clients that fell silent, did not come in, or fell so far behind that a fresh copy is sooner there.</summary>
internal sealed class ClientTimeouts
{
    /// <summary>A client that has not taken in so many lines of the log is told to go.</summary>
    private const int MaxUnacknowledged = 1 << 16;

    /// <summary>Who was welcomed is given up after this long, or the timeout if that is shorter, if it then says nothing.</summary>
    private static readonly SimDuration SilentPlace = SimDuration.FromSeconds(5);

    private readonly ClientRoster roster;
    private readonly LogLines log;
    private readonly SimDuration timeout;
    private readonly double slowestCopy;
    private readonly SuspendDetector suspend;

    /// <param name="roster">The clients.</param>
    /// <param name="log">What they are to take in.</param>
    /// <param name="timeout">After how much silence a client is given up.</param>
    /// <param name="slowestCopy">So many bytes of its copy a second gets who comes in on the slowest link.</param>
    /// <param name="now">By the own clock.</param>
    internal ClientTimeouts(ClientRoster roster, LogLines log, SimDuration timeout, double slowestCopy, SimTime now)
    {
        this.roster = roster;
        this.log = log;
        this.timeout = timeout;
        this.slowestCopy = slowestCopy;
        suspend = new SuspendDetector(timeout / 2, now);
    }

    /// <summary>Whether a client has been silent for so long that it does not count as one that falls behind.</summary>
    internal bool IsSilent(Client client, SimTime now) => now - client.Link.Heard > timeout / 2;

    /// <summary>How long one that is coming in may take, by what it has to request.</summary>
    internal SimDuration TimeoutWithCopy(JoinCopy copy) =>
        timeout + SilentPlace + SimDuration.FromSeconds(copy.Bytes.Length / slowestCopy);

    /// <summary>When a client that never wrote is given up.</summary>
    internal SimTime GivenUpAt(Client client) => client.Link.Heard + TimeoutWith(client) + SimDuration.OneTick;

    internal void Tend(SimTime now)
    {
        bool hasSlept = suspend.Look(now) > SimDuration.Zero; // it was this machine that slept: who was not listened to was not silent
        for (int i = roster.All.Count - 1; i >= 0; i--)
        {
            Client client = roster.All[i];
            if (hasSlept)
            {
                client.NoteSilence();
                client.Link.NoteHeard(now);
            }

            bool isSilent = now - client.Link.Heard > TimeoutWith(client) || (client.Peer == 0 && now > client.Claim.Until);
            if (isSilent || HasFallenBehind(client, now))
            {
                roster.Dismiss(client, isSilent ? LeaveReason.TimedOut : LeaveReason.FellBehind);
            }
        }
    }

    private SimDuration TimeoutWith(Client client) => client.HasWritten || timeout < SilentPlace ? timeout : SilentPlace;

    /// <summary>Whether a client is so far behind, and comes no nearer, that a fresh copy is sooner there.</summary>
    /// <remarks>
    /// By time only while it is heard: one that stands still is silent, and not behind a link that is too slow. One that came in with a
    /// large copy starts far behind, and catches up.
    /// </remarks>
    private bool HasFallenBehind(Client client, SimTime now)
    {
        SimDuration lag = client.Acknowledged < log.Count ? now - log.AddedAt(client.Acknowledged + 1) : SimDuration.Zero;
        bool isHeard = client.Peer > 0 && !IsSilent(client, now);
        return log.Count - client.Acknowledged > MaxUnacknowledged || (isHeard && client.CatchingUp.HasFailed(lag, now, timeout));
    }
}
