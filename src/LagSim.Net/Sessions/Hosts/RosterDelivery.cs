using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>How far a client has the host's roster, and what it was sent of it.</summary>
internal sealed class RosterDelivery
{
    private const int MaxDoublings = 5;

    private uint sentUpTo;
    private uint sentOf; // the newest revision then
    private int tries;

    /// <summary>The revision that the client has.</summary>
    internal uint Acknowledged { get; private set; }

    /// <summary>When to send again what was not acknowledged, by the local clock.</summary>
    internal SimTime Due { get; private set; } = SimTime.MaxValue;

    /// <summary>Whether something is to be sent now.</summary>
    internal bool IsDue(uint newest, SimTime now) =>
        Acknowledged < newest && (Acknowledged >= sentUpTo || sentOf < newest || now >= Due);

    /// <summary>Records what was sent; the pause until it is sent again doubles each time.</summary>
    internal void NoteSent(uint upTo, uint newest, SimTime now, SimDuration pause)
    {
        tries = newest == sentOf && tries < MaxDoublings ? tries + 1 : 0;
        (sentUpTo, sentOf) = (upTo, newest);
        Due = now + (pause * (1 << tries));
    }

    /// <summary>Takes an acknowledgement.</summary>
    /// <returns>False if it is of nothing that was sent.</returns>
    internal bool Acknowledge(uint revision)
    {
        if (revision > sentUpTo)
        {
            return false;
        }

        if (revision > Acknowledged)
        {
            Acknowledged = revision;
            tries = 0;
            Due = SimTime.MaxValue; // what is left is sent at once
        }

        return true;
    }
}
