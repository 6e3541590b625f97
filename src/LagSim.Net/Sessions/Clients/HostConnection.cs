using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>A client's end of the link to the host, with the data in transit: its own events up, the host's log down.</summary>
internal sealed class HostConnection
{
    private readonly HostPlaces places;
    private readonly LinkFactory links;
    private readonly PlayerIdentity self;
    private readonly DatagramSender sender;
    private readonly SessionCounters counters;
    private volatile bool keepsPlace;

    internal HostConnection(
        PeerAddress host, IEnumerable<PeerAddress> others, LinkFactory links, PlayerIdentity self, DatagramSender sender,
        SessionCounters counters, string? name = null)
    {
        places = new HostPlaces(host, others, name);
        this.links = links;
        this.self = self;
        this.sender = sender;
        this.counters = counters;
    }

    /// <summary>The host's address; the one that is asked first while several may be it.</summary>
    internal PeerAddress Host => places.First;

    /// <summary>What sentences call the host.</summary>
    internal string Name => places.Name;

    /// <summary>Whether it is the host's address, as far as is known.</summary>
    internal bool IsHost(PeerAddress address) => places.Has(address);

    /// <summary>Which addresses to ask after a time without an answer.</summary>
    internal IEnumerable<PeerAddress> ToAsk(SimDuration asked) => places.ToAsk(asked);

    /// <summary>Settles which address is the host's: it answered, and the others are not asked any more.</summary>
    internal void Choose(PeerAddress host) => places.Choose(host);

    /// <summary>The link; null while there is none.</summary>
    internal UpdateLink? Link { get; private set; }

    /// <summary>How late the host accepts an event in any case, as announced by the host; zero before that.</summary>
    internal SimDuration History { get; private set; }

    /// <summary>How late at the most, while it waits for players; zero before it is announced.</summary>
    internal SimDuration LongestHistory { get; private set; }

    /// <summary>The entries received of the host's log.</summary>
    internal ReceiveWindow Log { get; private set; } = new(0);

    /// <summary>Own events that have no verdict yet.</summary>
    internal OwnEvents Unconfirmed { get; private set; } = new(0);

    /// <summary>The last sequence number of the former holders of this peer's number.</summary>
    internal uint FirstSequence { get; private set; }

    /// <summary>The newest own event that no later event supersedes.</summary>
    internal uint LastUrgent { get; private set; }

    /// <summary>What this peer has promised the host about its stamps.</summary>
    internal OwnPromises Promises { get; private set; } = new(default);

    /// <summary>Whether the host still sends the start: it does until it knows that it has arrived here.</summary>
    internal bool IsStartTold { get; set; }

    /// <summary>Whether the host is asked to keep this peer's number when it leaves. From any thread.</summary>
    internal bool KeepsPlace
    {
        get => keepsPlace;
        set => keepsPlace = value;
    }

    /// <summary>Begins a new link from the host's welcome.</summary>
    /// <param name="welcome">The welcome.</param>
    /// <param name="seal">What protects the link; null in a session without protection.</param>
    /// <param name="now">The time by the local clock.</param>
    internal void Open(in WelcomeDatagram welcome, LinkSeal? seal, SimTime now)
    {
        (History, LongestHistory) = (welcome.History, welcome.LongestHistory);
        counters.EventsUnanswered += Unconfirmed.Count;
        Unconfirmed = new OwnEvents(0);
        Log = new ReceiveWindow(welcome.LogIndex);
        Close();
        Link = links.To(Host, welcome.SessionId, 0, now, seal);
    }

    /// <summary>Drops the link, whether established or still being set up, and wipes its keys.</summary>
    internal void Close()
    {
        Link?.Seal?.Dispose();
        Link = null;
    }

    /// <summary>Takes the number that the host gave over the link.</summary>
    internal void Sit(UpdateLink link, in SeatDatagram seat)
    {
        (byte number, uint lastSequence) = (seat.Peer, seat.LastSequence);
        Promises = new OwnPromises(seat);
        self.Take(number, lastSequence);
        FirstSequence = LastUrgent = lastSequence;
        Unconfirmed = new OwnEvents(lastSequence);
        link.Self = number;
        link.Outgoing.StartAfter(lastSequence);
    }

    /// <summary>Queues an own event for sending to the host.</summary>
    internal void Publish(in ExternalEvent external, SimTime now)
    {
        Unconfirmed.Add(external);
        Promises.NoteAct(external.Time);
        LastUrgent = SendWindow.IsMadeUpFor(external) ? LastUrgent : external.Sequence;
        Link!.NoteNewEntry(UpdateDatagram.LengthOf(new UpdateEntry(Verdict.Pending, external)), now);
    }

    /// <summary>Takes the oldest own event, whose verdict has arrived.</summary>
    internal ExternalEvent TakeConfirmed(SimTime now)
    {
        ExternalEvent external = Unconfirmed.Take();
        Link!.Acknowledge(external.Sequence, now); // the verdict may overtake the acknowledgement
        return external;
    }

    /// <summary>Notifies the host that this peer leaves, if there is a link.</summary>
    internal void SayGoodbye()
    {
        if (Link is not null)
        {
            sender.SayGoodbye(Link, self.Number, keepsPlace ? LeaveReason.Away : LeaveReason.Left);
        }
    }

    /// <summary>Says goodbye several times, so that one of them arrives.</summary>
    /// <param name="isChosen">Whether this peer leaves of its own will; who does not may come back as who it was.</param>
    internal void Farewell(bool isChosen)
    {
        keepsPlace |= !isChosen;
        for (int n = 0; n < DatagramSender.Goodbyes; n++)
        {
            SayGoodbye();
        }
    }
}
