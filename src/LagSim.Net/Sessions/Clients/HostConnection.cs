using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>A client's end of its link to the host, with what is under way on it: its own events up, the host's log down.</summary>
internal sealed class HostConnection
{
    private readonly LinkFactory links;
    private readonly PlayerIdentity self;
    private readonly DatagramSender sender;
    private readonly SessionCounters counters;

    internal HostConnection(PeerAddress host, LinkFactory links, PlayerIdentity self, DatagramSender sender, SessionCounters counters)
    {
        Host = host;
        this.links = links;
        this.self = self;
        this.sender = sender;
        this.counters = counters;
    }

    /// <summary>Where the host is.</summary>
    internal PeerAddress Host { get; }

    /// <summary>The link; null while there is none.</summary>
    internal UpdateLink? Link { get; private set; }

    /// <summary>How late the host accepts an event, as it said; zero before it has.</summary>
    internal SimDuration History { get; private set; }

    /// <summary>The host's log.</summary>
    internal ReceiveWindow Log { get; private set; } = new(0);

    /// <summary>The own events whose verdict has not come.</summary>
    internal OwnEvents Unconfirmed { get; private set; } = new(0);

    /// <summary>The last sequence number of those who had this peer's number before.</summary>
    internal uint FirstSequence { get; private set; }

    /// <summary>Of the own events: the newest that nothing later makes up for.</summary>
    internal uint LastUrgent { get; private set; }

    /// <summary>Whether the host still tells the start: it does until it has heard that it is known here.</summary>
    internal bool IsStartTold { get; set; }

    /// <summary>Begins a new link, by the host's welcome.</summary>
    internal void Open(in WelcomeDatagram welcome, SimTime now)
    {
        History = welcome.History;
        counters.EventsUnanswered += Unconfirmed.Count;
        Unconfirmed = new OwnEvents(0);
        Log = new ReceiveWindow(welcome.LogIndex);
        Link = links.To(Host, welcome.SessionId, 0, now);
    }

    /// <summary>Gives the link up: what it was is over, or what it was about to be.</summary>
    internal void Close() => Link = null;

    /// <summary>Takes the number that the host gave over the link.</summary>
    internal void Sit(UpdateLink link, byte number, uint lastSequence)
    {
        self.Take(number, lastSequence);
        FirstSequence = LastUrgent = lastSequence;
        Unconfirmed = new OwnEvents(lastSequence);
        link.Self = number;
        link.Outgoing.StartAfter(lastSequence);
    }

    /// <summary>Sees to it that the host hears of an own event.</summary>
    internal void Publish(in ExternalEvent external, SimTime now)
    {
        Unconfirmed.Add(external);
        LastUrgent = SendWindow.IsMadeUpFor(external) ? LastUrgent : external.Sequence;
        Link!.NoteLateEvent(UpdateDatagram.LengthOf(new UpdateEntry(Verdict.Pending, external)), now);
    }

    /// <summary>Takes the oldest own event, of which the verdict has come.</summary>
    internal ExternalEvent TakeConfirmed(SimTime now)
    {
        ExternalEvent external = Unconfirmed.Take();
        Link!.Acknowledge(external.Sequence, now); // an update that was overtaken may tell the verdict first
        return external;
    }

    /// <summary>Tells the host that this peer leaves, if there is a link.</summary>
    internal void SayGoodbye()
    {
        if (Link is not null)
        {
            sender.SayGoodbye(Link, self.Number, LeaveReason.Left);
        }
    }

    /// <summary>The same as often as it takes for one of them to arrive.</summary>
    internal void Farewell()
    {
        for (int n = 0; n < DatagramSender.Goodbyes; n++)
        {
            SayGoodbye();
        }
    }
}
