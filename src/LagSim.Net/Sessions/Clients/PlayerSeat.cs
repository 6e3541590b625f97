using System;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>
/// Takes the number that a host gives a client. With it the client takes part in the session: its clock is set, and it has a pass.
/// </summary>
internal sealed class PlayerSeat
{
    private readonly JoinAttempts attempts;
    private readonly HostConnection connection;
    private readonly SharedClock sharedTime;
    private readonly SessionStatus status;
    private readonly SessionCounters counters;
    private readonly IClock clock;
    private volatile object? pass; // boxed, so that other threads read it whole

    internal PlayerSeat(
        JoinAttempts attempts, HostConnection connection, SharedClock sharedTime, SessionStatus status, SessionCounters counters,
        IClock clock, PlayerPass pass)
    {
        this.attempts = attempts;
        this.connection = connection;
        this.sharedTime = sharedTime;
        this.status = status;
        this.counters = counters;
        this.clock = clock;
        this.pass = pass.Number > 0 ? pass : null;
    }

    /// <summary>Raised each time that the host gives a number, with the pass that proves that this peer is that player.</summary>
    internal event Action<PlayerPass>? PassGiven;

    /// <summary>The pass that proves to the host who this player was; null if there is none. From any thread.</summary>
    internal PlayerPass? Pass => (PlayerPass?)pass;

    /// <summary>The number of log entries that were not sent to this peer because its initial state includes them.</summary>
    internal uint LogStart { get; private set; }

    /// <summary>The estimate of the offset between the two clocks.</summary>
    internal ClockSync Clock { get; private set; } = new();

    internal void OnSeat(in SeatDatagram seat)
    {
        if (connection.Link is not UpdateLink link || attempts.Current is not JoinAttempt attempt
            || seat.SessionId != link.SessionId || !attempt.IsReady)
        {
            counters.DatagramsIgnored++;
            return;
        }

        link.CountReceived(WireFormat.SeatBytes);
        if (attempt.Seat is not null)
        {
            return;
        }

        attempt.Seat = seat;
        connection.Sit(link, seat);
        LogStart = attempt.LogStart;
        PlayerPass given = new(seat.Peer, seat.Pass);
        pass = given;
        Clock = attempt.Clock;
        sharedTime.Restart();
        sharedTime.Adjust(Clock.Estimate);
        status.State = status.State == SessionState.Synchronising ? SessionState.Waiting : status.State;
        link.Flush(clock.Now);
        PassGiven?.Invoke(given);
    }
}
