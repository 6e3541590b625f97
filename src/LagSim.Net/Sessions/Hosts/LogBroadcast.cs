using System;
using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Brings the host's log to the joiners, with start, watermark and hashes: what is new as soon as each link allows.</summary>
internal sealed class LogBroadcast
{
    private readonly JoinerRoster roster;
    private readonly AuthoritativeLog log;
    private readonly LogView view;
    private readonly Watermark watermark;
    private readonly SharedWorld world;
    private readonly CommitTracker commits;
    private readonly KeepAlivePolicy keepAlive;
    private readonly DatagramSender sender;
    private readonly IClock clock;

    internal LogBroadcast(
        JoinerRoster roster, AuthoritativeLog log, Watermark watermark, SharedWorld world, CommitTracker commits, KeepAlivePolicy keepAlive,
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

    /// <summary>Has the next step write to every joiner.</summary>
    internal void Hasten()
    {
        SimTime now = clock.Now;
        foreach (Joiner joiner in roster.All)
        {
            joiner.Link.Hasten(now);
        }
    }

    /// <summary>Notes that the log has a new last line, about that event.</summary>
    internal void NoteRecorded(ExternalEvent external)
    {
        VerdictLog lines = log.Lines;
        SimTime now = clock.Now;
        foreach (Joiner joiner in roster.All)
        {
            if (joiner.Peer == 0)
            {
                continue;
            }

            if (lines.Count != log.LastUrgent && joiner.Peer == external.Peer)
            {
                joiner.Link.Hasten(now + UpdateLink.MostAckDelay); // who did it knows it already
            }
            else
            {
                joiner.Link.NoteNews(UpdateDatagram.LengthOf(view.EntryFor(joiner, lines.Count)), now);
            }
        }
    }

    /// <summary>Sends the updates that are due.</summary>
    internal void Tend(SimTime now)
    {
        foreach (Joiner joiner in roster.All)
        {
            for (int n = 0; n < SendWindow.MaxDatagramsAtOnce && joiner.HasWritten && joiner.Link.IsDue(now); n++)
            {
                SendUpdate(joiner, now);
            }
        }
    }

    private void SendUpdate(Joiner joiner, SimTime now)
    {
        VerdictLog lines = log.Lines;
        UpdateLink link = joiner.Link;
        UpdateDatagram update = link.Compose(now);
        bool isToBegin = world.Live is not null && joiner.IsReady && !joiner.HasBegun;
        update.EventsReceived = joiner.EventsReceived;
        update.Start = joiner.HasBegun || world.Live is null ? SimTime.MinValue : world.Live.Simulation.Start;
        joiner.NoteTold(update.Number, commits.PutHashes(update, joiner.Told));
        view.Reader = joiner;
        link.Fill(view, now);

        // The watermark is a promise about what comes after this update's last entry: the one at which the next entry was added, or as
        // there is none, now's.
        uint last = update.FirstIndex + (uint)update.Held.Length - 1;
        update.Watermark = world.Live is null ? SimTime.MinValue : last < lines.Count ? lines.WatermarkAfter(last) : watermark.Now;
        bool isUrgent = joiner.Acknowledged < Math.Min(log.LastUrgent, view.Last);
        sender.Send(link.Seal(view, now, keepAlive.RestAfterUpdate(link, isToBegin, now, keepAlive.Overdue), isUrgent), link);
    }
}
