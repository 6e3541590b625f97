using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>
/// A network of any number of nodes in virtual time and one thread: nothing waits in real time, and the same seed gives the same run.
/// </summary>
/// <remarks>
/// <para>For programs that step sessions, or their own datagram protocol, by themselves; <see cref="SessionTest"/> does all this for a
/// whole game. To drive it, call <see cref="DeliverUntil"/> to go to the next moment at which something is due, let the nodes act, and
/// repeat. Datagrams that arrive at the same tick do so in the order in which they were sent.</para>
/// <para>Each ordered pair of nodes has its own random draws, a function of seed and pair only: adding a node changes nothing for the
/// others. Not thread-safe.</para>
/// </remarks>
public sealed class VirtualNetwork
{
    private const ulong SharedByBothWays = ulong.MaxValue; // no generation gets there
    private const ulong OfTransfers = ulong.MaxValue - 1;

    private readonly SeededRandom random;
    private readonly LinkProfile profile;
    private readonly Dictionary<PeerAddress, VirtualPort> ports = []; // by current address
    private readonly Dictionary<int, VirtualPort> numbers = [];
    private readonly Dictionary<(int From, int To), LinkModel> links = [];
    private readonly List<(int From, int To, BulkTransfer Transfer)> transfers = [];
    private readonly List<Func<int, int, ReadOnlyMemory<byte>, bool>> lossRules = [];
    private readonly PriorityQueue<Flight, (SimTime Time, long Sequence)> inFlight = new();
    private readonly List<LinkQueue> undecided = []; // those that decide later; one that was removed from its link may still hold datagrams
    private long sequence;
    private ulong linksMade;
    private ulong transfersMade;

    /// <summary>Creates a network without nodes.</summary>
    /// <param name="clock">True time. Other code that moves it must not move it past <see cref="NextDelivery"/> without delivering.</param>
    /// <param name="seed">The seed of all links.</param>
    /// <param name="profile">
    /// The profile of pairs without one of their own; the lower number counts as the host. Default: no delay at all.
    /// </param>
    public VirtualNetwork(VirtualClock clock, ulong seed, LinkProfile? profile = null)
    {
        ArgumentNullException.ThrowIfNull(clock);
        Clock = clock;
        random = new SeededRandom(seed);
        this.profile = profile ?? LinkProfiles.PureDelay(0);
    }

    /// <summary>True time.</summary>
    public VirtualClock Clock { get; }

    /// <summary>When the next datagram arrives, or a CoDel queue decides on one; null if none is in flight.</summary>
    public SimTime? NextDelivery => NextDecision is SimTime decision && !(NextArrival < decision) ? decision : NextArrival;

    /// <summary>
    /// The number of datagrams that did not arrive: lost by a link or a rule, sent to an unknown address, or to a port without room.
    /// </summary>
    public long DatagramsLost { get; private set; }

    /// <summary>
    /// The number of datagrams that may wait at a port, as in a socket's buffer; newer ones are lost. Default: any number.
    /// </summary>
    internal int PortRoom { get; set; } = int.MaxValue;

    /// <summary>
    /// Creates a node's port; its address is <see cref="PeerAddress.Virtual"/> of <paramref name="number"/>. A disposed one may be created
    /// again.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="number"/> is negative.</exception>
    /// <exception cref="InvalidOperationException">The number is taken, or the address.</exception>
    public IDatagramPort CreatePort(int number)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(number);
        ThrowIfTaken(number);
        if (numbers.TryGetValue(number, out VirtualPort? former))
        {
            if (!former.IsDisposed)
            {
                throw new InvalidOperationException($"Port {number} of the virtual network is taken; it has moved to {former.LocalAddress}.");
            }

            ports.Remove(former.LocalAddress);
        }

        VirtualPort port = new(this, number);
        ports[port.LocalAddress] = port;
        numbers[number] = port;
        return port;
    }

    /// <summary>
    /// Gives a port another address, as when an address translator forgets a player: it sends from there from now on, and datagrams to the
    /// former address, including those in flight, are lost. Its links stay the same.
    /// </summary>
    /// <param name="number">The port's number, which stays.</param>
    /// <param name="address">The number of the new address, which must be unused.</param>
    /// <exception cref="KeyNotFoundException">There is no such port.</exception>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="address"/> is negative.</exception>
    /// <exception cref="InvalidOperationException">The address is taken.</exception>
    internal void Move(int number, int address)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(address);
        ThrowIfTaken(address);
        VirtualPort port = numbers[number];
        ports.Remove(port.LocalAddress);
        port.LocalAddress = PeerAddress.Virtual(address);
        ports[port.LocalAddress] = port;
    }

    private void ThrowIfTaken(int address)
    {
        if (ports.TryGetValue(PeerAddress.Virtual(address), out VirtualPort? taken) && !taken.IsDisposed)
        {
            throw new InvalidOperationException($"Port {address} of the virtual network is taken.");
        }
    }

    private SimTime? NextArrival => inFlight.TryPeek(out _, out (SimTime Time, long Sequence) due) ? due.Time : null;

    private SimTime? NextDecision
    {
        get
        {
            SimTime? next = null;
            foreach (LinkQueue queue in undecided)
            {
                next = queue.NextDecision is SimTime decision && !(next <= decision) ? decision : next;
            }

            return next;
        }
    }

    /// <summary>
    /// Connects a player and the host by a link with that profile, both ways, from now on; datagrams in flight arrive as before.
    /// </summary>
    /// <remarks>With <see cref="LinkProfile.HasBulkTransfer"/> a bulk transfer over it begins now.</remarks>
    /// <param name="player">The player's number.</param>
    /// <param name="host">The host's number.</param>
    /// <param name="link">The profile of the link.</param>
    public void Connect(int player, int host, LinkProfile link) => Connect(player, host, link, null, null);

    /// <summary>
    /// Connects the two likewise, where either direction may go through a queue shared with others, as for <see cref="SetLink"/>.
    /// </summary>
    internal void Connect(int player, int host, LinkProfile link, LinkQueue? up, LinkQueue? down)
    {
        ArgumentNullException.ThrowIfNull(link);
        SetLink(player, host, link.ToHost, up);
        SetLink(host, player, link.FromHost, down);
        if (link.HasBulkTransfer)
        {
            StartBulkTransfer(host, player);
        }
    }

    /// <summary>
    /// Sets the properties of the direction from one node to another from now on. Datagrams in flight or in a queue arrive as before, and
    /// bulk transfers between the two end.
    /// </summary>
    /// <param name="from">The sender's number.</param>
    /// <param name="to">The receiver's number.</param>
    /// <param name="leg">The properties of the direction.</param>
    /// <param name="queue">
    /// A queue shared with other directions, of this network or any with the same true time; it replaces the leg's own
    /// <see cref="LinkLeg.Bottleneck"/>. Default: the leg's own, if it has one.
    /// </param>
    internal void SetLink(int from, int to, LinkLeg leg, LinkQueue? queue = null)
    {
        // A link replaced in the middle of a run must not repeat the random draws of its predecessor.
        ulong generation = links.ContainsKey((from, to)) ? ++linksMade : 0;
        LinkModel link = new(leg, Luck(from, to).Fork(generation), PathLuck(from, to), queue);
        links[(from, to)] = link;
        foreach ((int _, int _, BulkTransfer ended) in transfers.FindAll(t => IsPair(t.From, t.To, from, to)))
        {
            ended.Stop();
        }

        transfers.RemoveAll(t => IsPair(t.From, t.To, from, to));
        if (!link.DecidesAtOnce && !undecided.Contains(link.Queue!))
        {
            undecided.Add(link.Queue!);
        }
    }

    /// <summary>
    /// Begins a bulk TCP transfer from one node to another: competing traffic on the link between them, and on all that share its queues.
    /// </summary>
    /// <remarks>
    /// It uses the links as they are; it needs no nodes at its ends, and they do not see it. It ends when one of the two directions is set
    /// again.
    /// </remarks>
    /// <exception cref="InvalidOperationException">The direction has no bottleneck, so nothing would limit the transfer.</exception>
    internal BulkTransfer StartBulkTransfer(int from, int to)
    {
        LinkModel there = Link(from, to), back = Link(to, from);
        if (there.Queue is null)
        {
            throw new InvalidOperationException($"A bulk transfer from {from} to {to} needs a bottleneck on its way; nothing else would hold it back.");
        }

        SeededRandom luck = Luck(from, to).Fork(OfTransfers).Fork(transfersMade++), path = PathLuck(from, to);
        BulkTransfer transfer = new(
            new LinkModel(there.Leg, luck.Fork(0), path, there.Queue), new LinkModel(back.Leg, luck.Fork(1), path, back.Queue), Clock.Now);
        transfers.Add((from, to, transfer));
        return transfer;
    }

    /// <summary>Drops every datagram for which the rule returns true; all rules given apply.</summary>
    /// <param name="rule">
    /// Called with sender, receiver and datagram when it is sent; true drops it. Each rule sees every datagram, in order.
    /// </param>
    public void Lose(Func<int, int, ReadOnlyMemory<byte>, bool> rule)
    {
        ArgumentNullException.ThrowIfNull(rule);
        lossRules.Add(rule);
    }

    /// <summary>Gives every path an MTU from now on: longer packets are lost and nobody is told, as where a router drops ICMP.</summary>
    /// <param name="mtu">The longest packet that passes, in bytes, with the 28 of IPv4 and UDP.</param>
    internal void LoseAbove(int mtu) => Lose((_, _, datagram) => datagram.Length > mtu - PortTraffic.HeaderBytes);

    /// <summary>The queue that one node's datagrams to another pass first; null if there is none.</summary>
    internal LinkQueue? Queue(int from, int to) => Link(from, to).Queue;

    /// <summary>The traffic through a node's port so far. Received counts what arrived, taken or not.</summary>
    /// <exception cref="KeyNotFoundException">There is no such port.</exception>
    public PortTraffic Traffic(int number) => numbers[number].Traffic;

    /// <summary>
    /// Moves true time to <paramref name="now"/> and delivers what arrives up to and including then, each datagram at its own time.
    /// </summary>
    /// <returns>The number of datagrams delivered.</returns>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="now"/> is before the clock.</exception>
    public int DeliverUntil(SimTime now)
    {
        int delivered = 0;
        while (DecideUntil(now) && inFlight.TryPeek(out Flight flight, out (SimTime Time, long Sequence) due) && due.Time <= now)
        {
            inFlight.Dequeue();
            Clock.Now = SimTime.Max(Clock.Now, due.Time);
            if (ports.TryGetValue(flight.To, out VirtualPort? port) && !port.IsDisposed && port.Deliver(flight.Datagram, flight.From, PortRoom))
            {
                delivered++;
            }
            else
            {
                DatagramsLost++;
            }
        }

        Clock.Now = now;
        foreach ((int _, int _, BulkTransfer transfer) in transfers)
        {
            transfer.RunUntil(now); // senders through its queues run it as needed; this is for a caller that only reads its figures
        }

        return delivered;
    }

    internal void Send(VirtualPort from, PeerAddress to, byte[] datagram)
    {
        from.Traffic = from.Traffic.WithSent(datagram.Length);
        if (!ports.TryGetValue(to, out VirtualPort? receiver))
        {
            DatagramsLost++; // as UDP does with an unused address
            return;
        }

        LinkModel link = Link(from.Number, receiver.Number);
        PeerAddress sender = from.LocalAddress;
        if (link.DecidesAtOnce)
        {
            // The link draws even for a datagram that a rule drops, so that dropping one datagram changes the draws of no other.
            LinkDeliveries deliveries = link.Send(Clock.Now, datagram.Length);
            Fly(deliveries, IsLostByRule(from.Number, receiver.Number, datagram), new Flight(datagram, sender, to));
        }
        else
        {
            bool lost = IsLostByRule(from.Number, receiver.Number, datagram);
            link.Send(Clock.Now, datagram.Length, deliveries => Fly(deliveries, lost, new Flight(datagram, sender, to)));
        }
    }

    private bool IsLostByRule(int from, int to, byte[] datagram)
    {
        bool lost = false;
        foreach (Func<int, int, ReadOnlyMemory<byte>, bool> rule in lossRules)
        {
            lost |= rule(from, to, datagram);
        }

        return lost;
    }

    private void Fly(in LinkDeliveries deliveries, bool lostByRule, in Flight flight)
    {
        if (lostByRule || deliveries.Count == 0)
        {
            DatagramsLost++;
            return;
        }

        for (int i = 0; i < deliveries.Count; i++)
        {
            inFlight.Enqueue(flight, (deliveries[i], sequence++));
        }
    }

    /// <summary>Makes the queues decide what is due before anything else arrives.</summary>
    private bool DecideUntil(SimTime now)
    {
        while (NextDecision is SimTime decision && decision <= now && !(NextArrival < decision))
        {
            foreach (LinkQueue queue in undecided)
            {
                queue.DecideUntil(decision);
            }
        }

        return true;
    }

    private SeededRandom Luck(int from, int to) => random.Fork(((ulong)(uint)from << 32) | (uint)to);

    private SeededRandom PathLuck(int from, int to) => Luck(Math.Min(from, to), Math.Max(from, to)).Fork(SharedByBothWays);

    private LinkModel Link(int from, int to)
    {
        if (!links.TryGetValue((from, to), out LinkModel? link))
        {
            SetLink(from, to, Usual(from, to));
            if (profile.HasBulkTransfer && !links.ContainsKey((to, from)))
            {
                SetLink(to, from, Usual(to, from));
                StartBulkTransfer(Math.Min(from, to), Math.Max(from, to));
            }

            link = links[(from, to)];
        }

        return link;
    }

    private LinkLeg Usual(int from, int to) => from < to ? profile.FromHost : profile.ToHost;

    private static bool IsPair(int from, int to, int one, int other) => (from == one && to == other) || (from == other && to == one);

    private readonly record struct Flight(byte[] Datagram, PeerAddress From, PeerAddress To);
}
