using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Harness.Links;

/// <summary>A network of any number of nodes in virtual time and one thread: nothing waits, and the same seed gives the same run.</summary>
/// <remarks>
/// <para>Drive it so: set the clock or call <see cref="DeliverUntil"/> to go to the next moment at which something is due, let the nodes
/// act, repeat. Datagrams that arrive at the same tick do so in the order in which they were sent.</para>
/// <para>Each ordered pair of nodes has its own <see cref="LinkModel"/>, its luck a function of seed and pair only. Not thread-safe.</para>
/// </remarks>
public sealed class VirtualNetwork
{
    private const ulong SharedByBothWays = ulong.MaxValue; // no generation gets there

    private readonly SeededRandom random;
    private readonly LinkProfile profile;
    private readonly Dictionary<PeerAddress, VirtualPort> ports = [];
    private readonly Dictionary<(int From, int To), LinkModel> links = [];
    private readonly List<Func<int, int, ReadOnlyMemory<byte>, bool>> lossRules = [];
    private readonly PriorityQueue<Flight, (SimTime Time, long Sequence)> inFlight = new();
    private long sequence;
    private ulong linksMade;

    /// <summary>A network without nodes.</summary>
    /// <param name="clock">True time. Who else moves it must not move it past <see cref="NextDelivery"/> without delivering.</param>
    /// <param name="seed">The luck of all links.</param>
    /// <param name="profile">What a pair gets that nothing else was said of; the lower number counts as the host. Default: no delay at all.</param>
    public VirtualNetwork(VirtualClock clock, ulong seed, LinkProfile? profile = null)
    {
        ArgumentNullException.ThrowIfNull(clock);
        Clock = clock;
        random = new SeededRandom(seed);
        this.profile = profile ?? LinkProfiles.PureDelay(0);
    }

    /// <summary>True time.</summary>
    public VirtualClock Clock { get; }

    /// <summary>When the next datagram arrives; null when none is in flight.</summary>
    public SimTime? NextDelivery => inFlight.TryPeek(out _, out (SimTime Time, long Sequence) due) ? due.Time : null;

    /// <summary>How many datagrams did not arrive: lost by a link or a rule, or sent to nobody.</summary>
    public long DatagramsLost { get; private set; }

    /// <summary>A node's port; its address is <see cref="PeerAddress.Virtual"/> of <paramref name="number"/>. A disposed one may be made anew.</summary>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="number"/> is negative.</exception>
    /// <exception cref="InvalidOperationException">The number is taken.</exception>
    public IDatagramPort CreatePort(int number)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(number);
        if (ports.TryGetValue(PeerAddress.Virtual(number), out VirtualPort? taken) && !taken.IsDisposed)
        {
            throw new InvalidOperationException($"Port {number} of the virtual network is taken.");
        }

        VirtualPort port = new(this, number);
        ports[port.LocalAddress] = port;
        return port;
    }

    /// <summary>Joins a player and the host by a link of that profile, both ways.</summary>
    public void Connect(int player, int host, LinkProfile link)
    {
        ArgumentNullException.ThrowIfNull(link);
        SetLink(player, host, link.ToHost);
        SetLink(host, player, link.FromHost);
    }

    /// <summary>Says what the direction from one node to another does from now on; what is in flight arrives as it would have.</summary>
    public void SetLink(int from, int to, LinkLeg leg)
    {
        // A link made anew in the middle of a run must not repeat the luck of the one that it follows.
        ulong generation = links.ContainsKey((from, to)) ? ++linksMade : 0;
        links[(from, to)] = new LinkModel(leg, Luck(from, to).Fork(generation), Luck(Math.Min(from, to), Math.Max(from, to)).Fork(SharedByBothWays));
    }

    /// <summary>Loses for good each datagram of which the rule says so; all rules given count.</summary>
    /// <param name="rule">Gets sender, receiver and datagram when it is sent; true loses it. Each rule sees every datagram, in order.</param>
    public void Lose(Func<int, int, ReadOnlyMemory<byte>, bool> rule)
    {
        ArgumentNullException.ThrowIfNull(rule);
        lossRules.Add(rule);
    }

    /// <summary>What went through a node's port so far. Received is what arrived, taken or not.</summary>
    /// <exception cref="KeyNotFoundException">There is no such port.</exception>
    public PortTraffic Traffic(int number) => ports[PeerAddress.Virtual(number)].Traffic;

    /// <summary>Moves true time to <paramref name="now"/> and delivers what arrives until then, that included, each at its own time.</summary>
    /// <returns>How many datagrams were delivered.</returns>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="now"/> is before the clock.</exception>
    public int DeliverUntil(SimTime now)
    {
        int delivered = 0;
        while (inFlight.TryPeek(out Flight flight, out (SimTime Time, long Sequence) due) && due.Time <= now)
        {
            inFlight.Dequeue();
            Clock.Now = SimTime.Max(Clock.Now, due.Time);
            if (!ports.TryGetValue(flight.To, out VirtualPort? port) || port.IsDisposed)
            {
                DatagramsLost++;
                continue;
            }

            port.Deliver(flight.Datagram, flight.From);
            delivered++;
        }

        Clock.Now = now;
        return delivered;
    }

    internal void Send(VirtualPort from, PeerAddress to, byte[] datagram)
    {
        from.Traffic = from.Traffic.WithSent(datagram.Length);
        if (!ports.TryGetValue(to, out VirtualPort? receiver))
        {
            DatagramsLost++; // as UDP does with an address where nobody is
            return;
        }

        // The link is asked even for what a rule loses, so that a test which loses one datagram changes the luck of no other.
        LinkDeliveries deliveries = Link(from.Number, receiver.Number).Send(Clock.Now);
        bool lost = deliveries.Count == 0;
        foreach (Func<int, int, ReadOnlyMemory<byte>, bool> rule in lossRules)
        {
            lost |= rule(from.Number, receiver.Number, datagram);
        }

        if (lost)
        {
            DatagramsLost++;
            return;
        }

        for (int i = 0; i < deliveries.Count; i++)
        {
            inFlight.Enqueue(new Flight(datagram, from.LocalAddress, to), (deliveries[i], sequence++));
        }
    }

    private SeededRandom Luck(int from, int to) => random.Fork(((ulong)(uint)from << 32) | (uint)to);

    private LinkModel Link(int from, int to)
    {
        if (!links.TryGetValue((from, to), out LinkModel? link))
        {
            SetLink(from, to, from < to ? profile.FromHost : profile.ToHost);
            link = links[(from, to)];
        }

        return link;
    }

    private readonly record struct Flight(byte[] Datagram, PeerAddress From, PeerAddress To);
}
