using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>Sends a client's updates to the host: its events, what it has of the log, and how far along its join is.</summary>
internal sealed class ClientUpdates(
    HostConnection connection, JoinAttempts attempts, SharedWorld world, SharedClock sharedTime, KeepAlivePolicy keepAlive,
    DatagramSender sender)
{
    /// <summary>Sends the updates that are due.</summary>
    internal void Tend(SimTime now)
    {
        for (int n = 0; n < SendWindow.MaxDatagramsAtOnce && connection.Link is UpdateLink link && link.IsDue(now); n++)
        {
            Send(link, now);
        }
    }

    private void Send(UpdateLink link, SimTime now)
    {
        JoinAttempt? attempt = attempts.Current;
        OwnEvents unconfirmed = connection.Unconfirmed;
        UpdateDatagram update = link.Compose(now);
        update.EventsReceived = attempt is null ? connection.Log.Received : 0;
        update.Ready = attempt is null || attempt.IsReady;
        update.Start = attempt is null && connection.IsStartTold ? world.Live!.Simulation.Start : SimTime.MinValue;
        link.Fill(unconfirmed, now);
        bool isComingIn = attempt is not null && !(attempt.Seat is not null && world.Live is null);
        SimDuration wanted = link.Trips.HasQueue ? link.Trips.Mean : link.Trips.Mean / 8;
        SimDuration pace = wanted > JoinAttempt.Pace ? wanted : JoinAttempt.Pace;
        SimDuration rest = isComingIn ? pace : keepAlive.RestAfterUpdate(link, false, now, keepAlive.KeepAlive);
        if (attempt is null && connection.Promises.AreWanted)
        {
            SimTime shared = sharedTime.Now;
            update.Watermark = connection.Promises.Make(unconfirmed, update.FirstIndex + (uint)update.Held.Length - 1, shared);
            SimDuration half = link.Trips.HasQueue ? link.Trips.Mean / 2 : SimDuration.Zero; // a link with a queue is full enough already
            SimDuration pause = connection.Promises.Pause(shared);
            pause = half > pause ? half : pause;
            rest = pause < rest ? pause : rest;
        }

        sender.Send(link.Complete(unconfirmed, now, rest, isUrgent: link.Outgoing.Acknowledged < connection.LastUrgent), link);
    }
}
