using System;
using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Sends the host's log to the clients, with start, watermark and hashes; new entries go as soon as each link allows.</summary>
internal sealed class LogBroadcast
{
    private readonly ClientRoster roster;
    private readonly AuthoritativeLog log;
    private readonly LogView view;
    private readonly Watermark watermark;
    private readonly SharedWorld world;
    private readonly CommitTracker commits;
    private readonly KeepAlivePolicy keepAlive;
    private readonly DatagramSender sender;
    private readonly IClock clock;

    internal LogBroadcast(
        ClientRoster roster, AuthoritativeLog log, Watermark watermark, SharedWorld world, CommitTracker commits, KeepAlivePolicy keepAlive,
        DatagramSender sender, IClock clock)
    {
        this.roster = roster;
        this.log = log;
        this.watermark = watermark;
        this.world = world;
        this.commits = commits;
        this.keepAlive = keepAlive;
        this.sender = sender;
        this.clock = clock;
        view = new LogView(log.Lines);
    }

    /// <summary>Sends an update to every client on the next step.</summary>
    internal void Flush()
    {
        SimTime now = clock.Now;
        foreach (Client client in roster.All)
        {
            client.Link.Flush(now);
        }
    }

    /// <summary>Called when an entry was added to the log, with its event.</summary>
    internal void NoteRecorded(ExternalEvent external)
    {
        LogLines lines = log.Lines;
        SimTime now = clock.Now;
        foreach (Client client in roster.All)
        {
            if (client.Peer == 0)
            {
                continue;
            }

            if (client.Peer == external.Peer && lines.Count != log.LastUrgent)
            {
                client.Link.Flush(now + UpdateLink.MaxAckDelay); // its author has the event already, and a later one makes up for it
            }
            else if (client.Peer == external.Peer && lines[lines.Count].Verdict == Verdict.Accepted)
            {
                client.Link.AnswerSoon(now); // that it was accepted changes nothing there
            }
            else
            {
                client.Link.NoteNewEntry(UpdateDatagram.LengthOf(view.EntryFor(client, lines.Count)), now);
            }
        }
    }

    /// <summary>Sends the updates that are due.</summary>
    internal void Tend(SimTime now)
    {
        foreach (Client client in roster.All)
        {
            for (int n = 0; n < SendWindow.MaxDatagramsAtOnce && client.HasWritten && client.Link.IsDue(now); n++)
            {
                SendUpdate(client, now);
            }
        }
    }

    private void SendUpdate(Client client, SimTime now)
    {
        LogLines lines = log.Lines;
        UpdateLink link = client.Link;
        UpdateDatagram update = link.Compose(now);
        bool isToBegin = world.Live is not null && client.IsReady && !client.HasBegun;
        update.EventsReceived = client.EventsReceived;
        update.Start = client.HasBegun || world.Live is null ? SimTime.MinValue : world.Live.Simulation.Start;
        client.States.Note(update.Number, commits.PutHashes(update, client.States.Told));
        view.Reader = client;
        link.Fill(view, now);

        // The watermark is a promise about what comes after this update's last entry: the watermark when the next entry was added, or the
        // current one if there is none.
        uint last = update.FirstIndex + (uint)update.Held.Length - 1;
        update.Watermark = world.Live is null ? SimTime.MinValue : last < lines.Count ? lines.WatermarkAfter(last) : watermark.Now;
        bool isUrgent = client.Acknowledged < Math.Min(log.LastUrgent, view.Last);
        SimDuration rest = keepAlive.RestAfterUpdate(link, isToBegin, now, keepAlive.Overdue);
        sender.Send(link.Complete(view, now, rest, isUrgent), link);
    }
}
