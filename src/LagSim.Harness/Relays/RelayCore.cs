using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Relays;

/// <summary>
/// A relay without threads or a clock of its own: who goes where, and when. Not thread-safe, but for <see cref="Traffic"/>.
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
    private readonly object gate = new(); // seven counters that belong together; taken only to replace or copy them
    private SimTime polled;
    private int changesAsked; // 1 if so
    private RelayTraffic traffic;
    private long forwardedToHost;
    private long forwardedFromHost;
    private long portChanges;

    /// <summary>A relay without clients.</summary>
    /// <param name="front">Where clients send to; owned from now on.</param>
    /// <param name="host">Whom they mean.</param>
    /// <param name="profile">What each client's link does.</param>
    /// <param name="seed">The luck of all links; clients get theirs in the order in which they are first heard of.</param>
    /// <param name="maxClients">How many there can be.</param>
    /// <param name="openPort">Opens the port by which the host knows one client, owned from then on; null if there is none to be
    /// had.</param>
    /// <param name="change">After how long the host sees each client at another port, again and again; null for never.</param>
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

    /// <summary>What went through so far. From any thread.</summary>
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

    /// <summary>Has the next poll give every client another port. From any thread.</summary>
    internal void ChangePorts() => Interlocked.Exchange(ref changesAsked, 1);

    /// <summary>Takes in what came, as sent now, and hands on what is due by now.</summary>
    /// <returns>When the next datagram is due; null when none is on its way.</returns>
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

    /// <summary>A new client's way to the host; null if there can be no more.</summary>
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
    /// Closes the port by which the host knows a client, when it is time, and opens another one: what the host still sends to the former is
    /// lost, as with a translator of addresses that forgets.
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

        /// <summary>By which the host knows it.</summary>
        internal required IDatagramPort Port { get; set; }

        /// <summary>When that is to be another one; null for never.</summary>
        internal required SimTime? NextChange { get; set; }
    }
}
