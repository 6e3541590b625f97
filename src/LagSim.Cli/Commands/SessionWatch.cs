using System;
using System.Collections.Generic;
using System.Diagnostics;
using LagSim.Cli.Output;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary>A reporter of session events for the terminal: clients, committed states, links and problems.</summary>
/// <remarks>Methods are for the printing thread. Results from the session's thread arrive through the queue.</remarks>
internal sealed class SessionWatch
{
    /// <summary>
    /// The time without an answer after which a client reports that no host answers: more than a first join takes to compile.
    /// </summary>
    private static readonly TimeSpan SilenceToTell = TimeSpan.FromMilliseconds(1450);

    /// <summary>How long a session waits for the same players until that is told: those who come at once need no word.</summary>
    private static readonly TimeSpan WaitToTell = TimeSpan.FromSeconds(0.5);

    private readonly Session session;
    private readonly CarrierInUse carrier;
    private readonly SessionRequest request;
    private readonly SessionPrinter printer;
    private readonly PrintQueue queue;
    private readonly PaceWatch pace = new();
    private bool hasToldDifference; // owned by the session's thread
    private bool hasToldSilence;
    private readonly Stopwatch waiting = new(); // since when it waits for the same
    private string? waitsFor;
    private string? toldWaiting;
    private bool isLooking;

    internal SessionWatch(Session session, CarrierInUse carrier, SessionRequest request, SessionPrinter printer, PrintQueue queue)
    {
        this.session = session;
        this.carrier = carrier;
        this.request = request;
        this.printer = printer;
        this.queue = queue;
        if (session is HostSession host)
        {
            host.ClientCame += link => queue.Tell(() => printer.Came(link));
            host.ClientGone += link => queue.Tell(() => printer.Gone(link));
            host.PlayerExpelled += e => queue.Tell(() => printer.Problem(e.Sentence));
            host.KeyRefused += e => queue.Tell(() => printer.Problem(e.Sentence));
            host.ClientDiverged += (peer, time) =>
                queue.Tell(() => printer.Problem(DivergenceOf(peer, time - session.World!.Simulation.Start)));
        }

        session.RosterChanged += _ => TellRoster();
        session.Begun += TellRoster;
        session.StateCommitted += OnCommitted;
        if (session is ClientSession client)
        {
            client.Diverged += _ => TellDifference();
            client.Interrupted += why => queue.Tell(() => printer.Problem($"{why} Asking to be let in again."));
            client.Regained += () => queue.Tell(() => printer.Problem("The host is there again; all goes on."));
            client.Renewed += _ => TellRenewal(client.Peer);
        }
    }

    /// <summary>Requests the state of the links from the session's thread. Clients that came and went before are printed first.</summary>
    internal void LookAtLinks(PeerThread thread)
    {
        if (!isLooking)
        {
            isLooking = true;
            thread.Ask(peer =>
            {
                IReadOnlyList<LinkTraffic> links = peer.Links;
                string? waits = thread.Steps > 0 && peer is { State: SessionState.Waiting, World: null } ? peer.WhyNotRunning : null;
                queue.Add(() =>
                {
                    isLooking = false;
                    Wait(waits);
                    printer.LookAt(links);
                });
                return true;
            });
        }
    }

    /// <summary>Reports, once, that this machine cannot simulate the world in real time.</summary>
    internal void LookAtPace()
    {
        if (session.World is not { } world || session.State != SessionState.Running)
        {
            return; // there is no shared time yet, or the world waits for a silent host
        }

        SimTime now = session.SharedTime.Now;
        SimDuration behind = now - world.Simulation.SimulatedTo;
        if (pace.Finds(now, behind))
        {
            printer.Problem(FormattableString.Invariant(
                $"The world is {behind.ToSeconds():0.0} s behind: this machine cannot simulate it in real time."));
        }
    }

    /// <summary>Reports, once and early, that no host answers and how long it will be tried. With a pass that is minutes.</summary>
    internal void LookAtSilence(TimeSpan asked)
    {
        bool isUnanswered = session is ClientSession { State: SessionState.Joining } && session.Counters.DatagramsReceived == 0;
        if (!hasToldSilence && asked >= SilenceToTell && isUnanswered)
        {
            hasToldSilence = true;
            ClientOptions options = ClientOptions.From(request.Options);
            SimDuration most = options.Pass.Number > 0 && options.RejoinTime > options.Timeout ? options.RejoinTime : options.Timeout;
            string why = carrier.Obstacle() is string obstacle ? $" ({obstacle.TrimEnd('.')})" : "";
            printer.Problem(FormattableString.Invariant(
                $"No host answers at {request.Host} yet{why}; asking for up to {most.ToSeconds():0.###} s. Ctrl-C ends it."));
        }
    }

    /// <summary>Reports for whom a session waits that does not begin, whenever that is another sentence than before.</summary>
    internal void LookAtWaiting()
    {
        if (waitsFor is not null && waitsFor != toldWaiting && waiting.Elapsed >= WaitToTell)
        {
            toldWaiting = waitsFor;
            printer.Problem(waitsFor);
        }
    }

    private void Wait(string? sentence)
    {
        if (sentence != waitsFor)
        {
            waitsFor = sentence;
            waiting.Restart();
        }
    }

    /// <summary>
    /// Reports the first committed state that differs from the host's. For the session's thread, or for the printing thread once that has
    /// stopped.
    /// </summary>
    internal void TellDifference()
    {
        if (!hasToldDifference && session is ClientSession { Divergence: Divergence divergence })
        {
            hasToldDifference = true;
            string sentences = divergence.ToString();
            queue.Tell(() => printer.Problem(sentences));
        }
    }

    private static string DivergenceOf(byte peer, SimDuration sinceStart) => FormattableString.Invariant(
        $"Peer {peer} says that its committed state at T {sinceStart.ToSeconds()} s is not this one's.");

    private void TellRenewal(byte player) =>
        queue.Tell(() => printer.Problem($"In again as player {player}, with a fresh copy of the world."));

    /// <summary>Reports who is there, once the world has begun. Changes of one moment are one line.</summary>
    private void TellRoster()
    {
        if (session.World is not null)
        {
            IReadOnlyList<RosterMember> roster = session.Roster;
            queue.Tell(() => printer.Here(roster));
        }
    }

    private void OnCommitted(CommittedState state)
    {
        ClockReading? clock = session is ClientSession client
            ? new ClockReading(client.ClockSync.Estimate.Offset, client.ClockSync.Estimate.ErrorBound, client.ClockSync.RoundTrip / 2)
            : null;
        SimDuration sinceStart = state.Time - session.World!.Simulation.Start;
        if (!(sinceStart > request.Length))
        {
            CommittedWorld world = new(session.World!.Simulation, state.Time);
            queue.Tell(() => printer.State(state, sinceStart, clock, world));
        }
    }
}
