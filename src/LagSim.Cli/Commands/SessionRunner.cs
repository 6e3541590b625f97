using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Cli.Output;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary>Takes part in a session from its beginning to its end: does what is to be done at its time, tells what happens, and leaves.</summary>
/// <remarks>The session has a thread of its own; this type's methods are for the calling one, which alone prints.</remarks>
internal sealed class SessionRunner : IDisposable
{
    private static readonly TimeSpan LookInterval = TimeSpan.FromMilliseconds(250);

    /// <summary>After so long without an answer it is told that there is none.</summary>
    private static readonly TimeSpan SilenceToTell = TimeSpan.FromMilliseconds(450);

    private static readonly TimeSpan LeaveTimeout = TimeSpan.FromSeconds(1);

    /// <summary>How long a host whose time is up waits for its clients to leave, besides some round trips.</summary>
    private static readonly SimDuration HostTimeout = SimDuration.FromSeconds(1.5);

    private const int RoundTripsOfTimeout = 4;

    /// <summary>How long a host waits, after its time is up and the history has passed, for a world that is behind.</summary>
    private static readonly SimDuration WorldTimeout = SimDuration.FromSeconds(5);

    /// <summary>How long a host that has said goodbye answers those who have not heard it.</summary>
    private static readonly TimeSpan GoodbyeTime = TimeSpan.FromMilliseconds(300);

    private readonly Session session;
    private readonly UdpPort port;
    private readonly SessionRequest request;
    private readonly SessionPrinter printer;
    private readonly CancellationToken stop;
    private readonly PeerThread thread;
    private readonly SessionRecorder? recorder;
    private readonly AutoResetEvent wakeUp = new(false);
    private readonly CancellationTokenRegistration onStop;
    private readonly ConcurrentQueue<Action> told = new(); // what the session's thread has to say, for this one to print
    private readonly Dictionary<uint, ScriptedAction> unconfirmed = []; // own ones of a client, by sequence number; the session's thread's
    private readonly List<(ScriptedAction ScriptedAction, Task Attempt)> attempts = []; // of which the outcome has not been looked at
    private volatile bool isAwaitingVerdict; // whether any is unjudged
    private bool hasToldDifference; // the session's thread's
    private bool isLooking;
    private PlayerAction[]? actions; // of the scripted actions, once the scene is known
    private int done; // or given up
    private bool hasFailedAction;
    private readonly PaceWatch pace = new();
    private SimTime? timeoutEnd;
    private bool hasToldSilence;

    internal SessionRunner(Session session, UdpPort port, SessionRequest request, SessionPrinter printer, CancellationToken stop)
    {
        this.session = session;
        this.port = port;
        this.request = request;
        this.printer = printer;
        this.stop = stop;
        session.Begun += Wake;
        session.Ended += Wake;
        session.Logged += OnLogged;
        if (session is HostSession host)
        {
            host.ClientCame += link => Tell(() => printer.Came(link));
            host.ClientGone += link => Tell(() => printer.Gone(link));
            host.PlayerExpelled += e => Tell(() => printer.Problem(e.Sentence));
            host.ClientDiverged += (peer, time) => Tell(() => printer.Problem(FormattableString.Invariant(
                $"Peer {peer} says that its committed state at T {(time - session.World!.Simulation.Start).ToSeconds()} s is not this one's.")));
        }

        session.StateCommitted += OnCommitted;
        if (session is ClientSession client)
        {
            client.Diverged += _ => TellDifference();
            client.Interrupted += why => Tell(() => printer.Problem($"{why} Asking to be let in again."));
            client.Regained += () => Tell(() => printer.Problem("The host is there again; all goes on."));
            client.Renewed += _ => OnRenewed(client.Peer);
        }

        if (request.RecordFile is string file)
        {
            recorder = new SessionRecorder(session, file, request.Length);
            recorder.Failed += why => Tell(() => printer.Problem(why));
        }

        thread = new PeerThread(session, port, "LagSim session");
        thread.HandlerFailed += failure => Tell(() => printer.Problem($"Something that happened could not be told: {failure.Message}"));
        onStop = stop.Register(Wake);
    }

    /// <summary>What a session that ended so is to the shell. That states differ, or accepted events are lost, counts whatever else there is.</summary>
    internal static int ExitCodeOf(SessionEnd by, bool isTimeReached, long statesDiffered, long eventsLost, bool hasFailedAction, bool isInterrupted)
    {
        bool isOrderly = by is SessionEnd.Left || (by == SessionEnd.HostEnded && isTimeReached);
        return statesDiffered > 0 || eventsLost > 0 ? ExitCode.CheckFailed
            : isInterrupted ? ExitCode.Interrupted
            : isOrderly && !hasFailedAction ? ExitCode.Done
            : ExitCode.Input;
    }

    /// <summary>Takes part until the end.</summary>
    /// <returns>The exit code.</returns>
    /// <exception cref="UsageException">Something is to be done to a body that the scene has not.</exception>
    /// <exception cref="OperationCanceledException">It was asked to stop before there was a session.</exception>
    internal int Run()
    {
        thread.Start();
        TimeSpan? wait = TimeSpan.Zero;
        Stopwatch asking = Stopwatch.StartNew();
        try
        {
            while (wait is TimeSpan span && !stop.IsCancellationRequested && thread.State != SessionState.Ended)
            {
                wakeUp.WaitOne(span);
                PrintTold();
                LookAtAttempts();
                LookAtLinks();
                LookAtPace();
                LookAtSilence(asking.Elapsed);
                wait = session.World is null ? LookInterval : Tend(session.World.Simulation.Start);
            }
        }
        catch (InvalidOperationException fault) when (fault.InnerException is not null)
        {
            throw new InputException(fault.Message, fault); // the session's thread ended by an exception, of which a force is the likeliest source
        }

        bool isTimeReached = request.Seconds is null || (session.World is not null && Passed(session.World.Simulation.Start) >= request.Seconds);
        bool isInterrupted = stop.IsCancellationRequested && session.State != SessionState.Ended;
        Leave();
        if (!isInterrupted)
        {
            TellUndone();
        }

        SessionCounters counters = session.Counters;
        int code = ExitCodeOf(session.EndedBy, isTimeReached, counters.StatesDiffered, counters.EventsLost, hasFailedAction, isInterrupted);
        if (session.EndedBy != SessionEnd.Left && code != ExitCode.Done)
        {
            printer.Problem(session.EndReason!);
        }

        if (session.World is not null)
        {
            printer.Summary(session, port, recorder);
        }
        else if (isInterrupted)
        {
            throw new OperationCanceledException(stop); // as of any command that has no result yet
        }
        else
        {
            printer.Failed(session.EndReason ?? "There was no session.", code);
        }

        return code == ExitCode.Done && recorder?.Failure is not null ? ExitCode.Input : code;
    }

    /// <summary>Has the session's thread do something, and prints what it says of it; from any thread, at any time.</summary>
    internal void Have(Func<Session, string> what)
    {
        try
        {
            thread.Ask(peer =>
            {
                string answer = what(peer);
                Tell(() => printer.Line(answer));
                return true;
            });
        }
        catch (Exception gone) when (gone is InvalidOperationException or ObjectDisposedException)
        {
            // The session is over; nobody prints any more.
        }
    }

    public void Dispose()
    {
        SayGoodbye(); // where something went wrong, the others are told even so
        onStop.Dispose();
        thread.Dispose();
        recorder?.Dispose();
        wakeUp.Dispose();
    }

    private void Wake()
    {
        try
        {
            wakeUp.Set();
        }
        catch (ObjectDisposedException)
        {
            // Nobody waits any more.
        }
    }

    private void Tell(Action what)
    {
        told.Enqueue(what);
        Wake();
    }

    private void PrintTold()
    {
        while (told.TryDequeue(out Action? what))
        {
            what();
        }
    }

    /// <summary>Tells, once, of a world that this machine cannot simulate as fast as time passes.</summary>
    private void LookAtPace()
    {
        if (session.World is not { } world || session.State != SessionState.Running)
        {
            return; // there is no shared time yet, or the world waits for a host that is silent
        }

        SimTime now = session.SharedTime.Now;
        SimDuration behind = now - world.Simulation.SimulatedTo;
        if (pace.Finds(now, behind))
        {
            printer.Problem(FormattableString.Invariant($"The world is {behind.ToSeconds():0.0} s behind: this machine cannot simulate it in real time."));
        }
    }

    /// <summary>Tells, once and soon, that no host answers, and for how long it will be asked: with a pass that is minutes.</summary>
    private void LookAtSilence(TimeSpan asked)
    {
        if (!hasToldSilence && asked >= SilenceToTell && session is ClientSession { State: SessionState.Joining } && session.Counters.DatagramsReceived == 0)
        {
            hasToldSilence = true;
            ClientOptions options = ClientOptions.From(request.Options);
            SimDuration most = options.Pass.Number > 0 && options.RejoinTime > options.Timeout ? options.RejoinTime : options.Timeout;
            printer.Problem(FormattableString.Invariant($"No host answers at {request.Host} yet; asking for up to {most.ToSeconds():0.###} s. Ctrl-C ends it."));
        }
    }

    private double Passed(SimTime start) => (session.SharedTime.Now - start).ToSeconds();

    /// <summary>Does what is due.</summary>
    /// <returns>How long there is nothing to do; null at the end.</returns>
    private TimeSpan? Tend(SimTime start)
    {
        double passed = Passed(start);
        if (actions is null)
        {
            actions = request.ScriptedActions.Select(scripted => scripted.ActionIn(session.Scene!)).ToArray();
            SkipPast(passed);
            if (passed > request.Seconds)
            {
                Fail(FormattableString.Invariant($"--for-s {request.Seconds} was over when this peer came in at T {passed:0.000} s."));
            }
        }

        for (; done < actions.Length && request.ScriptedActions[done].Seconds <= passed; done++)
        {
            Do(request.ScriptedActions[done], actions[done]);
        }

        if (passed >= request.Seconds)
        {
            return HasSettled(start) ? null : LookInterval / 2;
        }

        double next = Math.Min(done < actions.Length ? request.ScriptedActions[done].Seconds : double.MaxValue, request.Seconds ?? double.MaxValue);
        return TimeSpan.FromMilliseconds(Math.Min(Math.Ceiling(1000 * (next - passed)), LookInterval.TotalMilliseconds));
    }

    /// <summary>
    /// Whether all has been said, once the time is up: what happened until then is committed here, and a host has waited, but not for long, until its
    /// clients have heard of it and left.
    /// </summary>
    private bool HasSettled(SimTime start)
    {
        SimDuration interval = request.Options.CommitInterval;
        SimTime last = start + (interval * (long)(request.Seconds!.Value / interval.ToSeconds()));
        bool isCommitted = last == start || session.Committed?.Time >= last;
        SimTime now = session.SharedTime.Now;
        if (session is ClientSession client)
        {
            timeoutEnd ??= now + client.History + (request.Options.KeepAlive * 2);
            return (isCommitted && attempts.Count == 0 && !isAwaitingVerdict) || now >= timeoutEnd;
        }

        if (!isCommitted && now - start > SimDuration.FromSeconds(request.Seconds.Value) + request.Options.Window.History + WorldTimeout)
        {
            Fail(FormattableString.Invariant($"The time is up, and the world is not committed to T {(last - start).ToSeconds()} s: it is too far behind."));
            return true;
        }

        if (isCommitted)
        {
            timeoutEnd ??= now + HostTimeout + (printer.Links.LongestRoundTrip * RoundTripsOfTimeout);
            thread.Ask(host =>
            {
                ((HostSession)host).Flush();
                return true;
            });
        }

        return isCommitted && (printer.Links.Present == 0 || now >= timeoutEnd);
    }

    /// <summary>Gives up what was to be done before this peer came in: done now it would be something else.</summary>
    private void SkipPast(double passed)
    {
        for (; done < request.ScriptedActions.Count && request.ScriptedActions[done].Seconds < passed; done++)
        {
        }

        if (done > 0)
        {
            Fail(FormattableString.Invariant($"Not done, for the time was past when this peer came in at T {passed:0.000} s: {Texts(request.ScriptedActions.Take(done))}."));
        }
    }

    private void Do(ScriptedAction scripted, PlayerAction action) => attempts.Add((scripted, thread.Ask(peer =>
    {
        ExternalEvent external = peer.Do(action);
        if (peer is ClientSession) // what a host does needs nobody's leave
        {
            unconfirmed[external.Sequence] = scripted;
            isAwaitingVerdict = true;
        }

        return external;
    })));

    /// <summary>Tells of what could not be done here.</summary>
    private void LookAtAttempts()
    {
        foreach ((ScriptedAction scripted, Task attempt) in attempts)
        {
            if (attempt.IsFaulted)
            {
                Fail($"--do {scripted.Text} was not done. {attempt.Exception!.InnerException!.Message}");
            }
        }

        attempts.RemoveAll(a => a.Attempt.IsFaulted || a.Attempt.IsCompletedSuccessfully);
    }

    /// <summary>Tells of what was not done, or what nobody knows of. The session's thread must have stopped.</summary>
    private void TellUndone()
    {
        ScriptedAction[] undone = [.. attempts.Select(a => a.ScriptedAction), .. request.ScriptedActions.Skip(done)];
        if (undone.Length > 0)
        {
            Fail($"Not done, for the session ended before: {Texts(undone)}.");
        }

        if (unconfirmed.Count > 0)
        {
            Fail($"Done here, but the session ended before the host's verdict came: {Texts(unconfirmed.OrderBy(d => d.Key).Select(d => d.Value))}.");
        }
    }

    private void Fail(string sentence)
    {
        hasFailedAction = true;
        printer.Problem(sentence);
    }

    private static string Texts(IEnumerable<ScriptedAction> scriptedActions) => string.Join(", ", scriptedActions.Select(scripted => $"--do {scripted.Text}"));

    /// <summary>Has the session's thread say how its links are; what it said before of who came and went is printed before.</summary>
    private void LookAtLinks()
    {
        if (!isLooking)
        {
            isLooking = true;
            thread.Ask(peer =>
            {
                IReadOnlyList<LinkTraffic> links = peer.Links;
                told.Enqueue(() =>
                {
                    isLooking = false;
                    printer.LookAt(links);
                });
                return true;
            });
        }
    }

    private void OnLogged(LogEntry entry)
    {
        if (session is ClientSession && entry.Event.Peer == session.Peer && unconfirmed.Remove(entry.Event.Sequence, out ScriptedAction? scripted))
        {
            isAwaitingVerdict = unconfirmed.Count > 0;
            if (entry.Verdict != Verdict.Accepted)
            {
                Tell(() => Fail($"The host refused --do {scripted.Text}: {Why(entry.Verdict)}."));
            }
        }
    }

    /// <summary>
    /// Stops waiting for the verdicts that had not come yet. With a fresh copy the numbers of this peer's events may start again, so a later verdict on one of these
    /// numbers would be about another event.
    /// </summary>
    private void OnRenewed(byte player)
    {
        Tell(() => printer.Problem($"In again as player {player}, with a fresh copy of the world."));
        if (unconfirmed.Count > 0)
        {
            string texts = Texts(unconfirmed.OrderBy(d => d.Key).Select(d => d.Value));
            unconfirmed.Clear();
            isAwaitingVerdict = false;
            Tell(() => Fail($"Done here, but a fresh copy took the place of the world before the host's verdict came: {texts}."));
        }
    }

    private static string Why(Verdict verdict) => verdict switch
    {
        Verdict.TooLate => "it came too late, when nothing could change any more what was to happen then (the host's --history-s)",
        Verdict.TooEarly => "it is stamped too far in the future",
        Verdict.NoRight =>
            "this peer may not do that: it has no right to, or what it did costs more than the host allows (docs/BUDGETS.md)",
        _ => "it makes no sense in this scene",
    };

    private void OnCommitted(CommittedState state)
    {
        ClockReading? clock = session is ClientSession client
            ? new ClockReading(client.ClockSync.Estimate.Offset, client.ClockSync.Estimate.ErrorBound, client.ClockSync.RoundTrip / 2)
            : null;
        SimDuration sinceStart = state.Time - session.World!.Simulation.Start;
        if (!(sinceStart > request.Length))
        {
            Tell(() => printer.State(state, sinceStart, clock));
        }
    }

    /// <summary>Tells of the first committed state that was not the host's, and what is known of it.</summary>
    private void TellDifference()
    {
        if (!hasToldDifference && session is ClientSession { Divergence: Divergence divergence })
        {
            hasToldDifference = true;
            string sentences = divergence.ToString();
            Tell(() => printer.Problem(sentences));
        }
    }

    private void SayGoodbye()
    {
        bool hasClients = session is HostSession && printer.Links.Present > 0;
        try
        {
            if (session.State != SessionState.Ended && thread.Ask(Goodbye).Wait(LeaveTimeout, CancellationToken.None) && hasClients)
            {
                Thread.Sleep(GoodbyeTime);
            }
        }
        catch (Exception failure) when (failure is AggregateException or InvalidOperationException)
        {
            // The thread has ended; so does the session for everybody else, by their time-out.
        }

        static bool Goodbye(Session peer)
        {
            peer.Leave();
            return true;
        }
    }

    /// <summary>Says goodbye, stops the thread, and ends the recording.</summary>
    private void Leave()
    {
        SayGoodbye();
        thread.Dispose();
        if (session.State != SessionState.Ended)
        {
            session.Leave(); // its thread was stopped in the middle of its work, so this one may
        }

        TellDifference();
        PrintTold();
        LookAtAttempts();
        printer.LookAt(session.Links);
        recorder?.Dispose();
    }
}
