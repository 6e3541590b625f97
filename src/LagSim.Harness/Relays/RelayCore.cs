using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Relays;

/// <summary>
/// A relay without threads or a clock of its own. It forwards datagrams when polled. Not thread-safe, except <see cref="Traffic"/>.
/// </summary>
internal sealed class RelayCore : IDisposable
{
    private readonly IDatagramPort front;
    private readonly PeerAddress host;
    private readonly LinkProfile profile;
    private readonly SeededRandom random;
    private readonly Func<IDatagramPort?> openPort;
    private readonly int maxClients;
    private readonly SimDuration? change;
    private readonly HeldDatagrams toHost;
    private readonly Dictionary<PeerAddress, Client> clients = [];
    private readonly object gate = new(); // guards seven counters that belong together
    private SimTime polled;
    private int changesAsked; // 1 if a change is requested
    private RelayTraffic traffic;
    private long forwardedToHost;
    private long forwardedFromHost;
    private long portChanges;

    /// <summary>Creates a relay without clients.</summary>
    /// <param name="front">The port for clients, which the relay owns.</param>
    /// <param name="host">The address of the host.</param>
    /// <param name="profile">The profile of each client's link.</param>
    /// <param name="seed">The seed of all links. Clients get theirs in the order of their first datagrams.</param>
    /// <param name="maxClients">The most clients.</param>
    /// <param name="openPort">Opens the port towards the host for one client, which the relay owns; returns null if none is
    /// available.</param>
    /// <param name="change">The interval after which the host sees each client at another port, repeatedly; null for never.</param>
    internal RelayCore(
        IDatagramPort front,
        PeerAddress host,
        LinkProfile profile,
        ulong seed,
        int maxClients,
        Func<IDatagramPort?> openPort,
        SimDuration? change = null)
    {
        this.change = change;
        this.front = front;
        this.host = host;
        this.profile = profile;
        this.maxClients = maxClients;
        this.openPort = openPort;
        random = new SeededRandom(seed);
        toHost = new HeldDatagrams(LinkOf);
    }

    /// <summary>The traffic so far. Safe on any thread.</summary>
    internal RelayTraffic Traffic
    {
        get
        {
            lock (gate)
            {
                return traffic;
            }
        }
    }

    /// <summary>Requests another port for every client, on the next poll. Safe on any thread.</summary>
    internal void ChangePorts() => Interlocked.Exchange(ref changesAsked, 1);

    /// <summary>Accepts what arrived, as sent now, and forwards what is due.</summary>
    /// <returns>The time at which the next datagram is due; null when none is in transit.</returns>
    internal SimTime? Poll(SimTime now)
    {
        polled = now;
        bool isAsked = Interlocked.Exchange(ref changesAsked, 0) != 0;
        foreach (Client client in clients.Values)
        {
            ChangePort(client, isAsked, now);
        }

        toHost.TakeFrom(front, now);
        while (toHost.TryDequeueDue(now, out (byte[] Datagram, PeerAddress From) up))
        {
            clients[up.From].Port.Send(up.Datagram, host);
            forwardedToHost++;
        }

        SimTime? next = toHost.NextDue;
        foreach (Client client in clients.Values)
        {
            client.FromHost.TakeFrom(client.Port, now);
            while (client.FromHost.TryDequeueDue(now, out (byte[] Datagram, PeerAddress From) down))
            {
                front.Send(down.Datagram, client.Address);
                forwardedFromHost++;
            }

            next = client.FromHost.NextDue is SimTime due && !(next <= due) ? due : next;
            next = client.NextChange is SimTime changing && !(next <= changing) ? changing : next;
        }

        Count();
        return next;
    }

    public void Dispose()
    {
        front.Dispose();
        foreach (Client client in clients.Values)
        {
            client.Port.Dispose();
        }
    }

    /// <summary>Adds a client; null if there can be no more.</summary>
    private LinkModel? LinkOf(PeerAddress client)
    {
        if (clients.Count == maxClients || openPort() is not IDatagramPort port)
        {
            return null;
        }

        SeededRandom luck = random.Fork((ulong)clients.Count);
        SeededRandom path = luck.Fork(2);
        LinkModel down = new(profile.FromHost, luck.Fork(1), path), up = new(profile.ToHost, luck.Fork(0), path);
        clients.Add(client, new Client(client, new HeldDatagrams(from => from == host ? down : null)) { Port = port, NextChange = polled + change });
        if (profile.HasBulkTransfer)
        {
            _ = new BulkTransfer(new LinkModel(profile.FromHost, luck.Fork(3), path, down.Queue), new LinkModel(profile.ToHost, luck.Fork(4), path, up.Queue), polled);
        }

        return up;
    }

    /// <summary>
    /// Replaces the port towards the host for a client when it is time. What the host still sends to the former port is lost, as behind a
    /// NAT that forgets a mapping.
    /// </summary>
    private void ChangePort(Client client, bool isAsked, SimTime now)
    {
        if ((isAsked || client.NextChange <= now) && openPort() is IDatagramPort port)
        {
            client.Port.Dispose();
            client.Port = port;
            portChanges++;
            client.NextChange = now + change;
        }
    }

    private void Count()
    {
        RelayTraffic now = new(
            clients.Count,
            forwardedToHost,
            toHost.Lost,
            forwardedFromHost,
            clients.Values.Sum(client => client.FromHost.Lost),
            toHost.Refused + clients.Values.Sum(client => client.FromHost.Refused),
            portChanges);
        lock (gate)
        {
            traffic = now;
        }
    }

    private sealed class Client(PeerAddress address, HeldDatagrams fromHost)
    {
        internal PeerAddress Address { get; } = address;

        internal HeldDatagrams FromHost { get; } = fromHost;

        /// <summary>The port towards the host.</summary>
        internal required IDatagramPort Port { get; set; }

        /// <summary>The time of the next port change; null for never.</summary>
        internal required SimTime? NextChange { get; set; }
    }
}
