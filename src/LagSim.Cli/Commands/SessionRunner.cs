using System;
using System.Diagnostics;
using System.Threading;
using LagSim.Cli.Output;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary>Runs one session from start to end: performs the scripted actions, prints events, and leaves.</summary>
/// <remarks>The session has its own thread. Methods are for the calling thread, the only one that prints.</remarks>
internal sealed class SessionRunner : IDisposable
{
    private static readonly TimeSpan LookInterval = TimeSpan.FromMilliseconds(250);

    private static readonly TimeSpan LeaveTimeout = TimeSpan.FromSeconds(1);

    /// <summary>
    /// How long a host whose time is up waits for its clients to leave, in addition to <see cref="RoundTripsOfTimeout"/>.
    /// </summary>
    private static readonly SimDuration HostTimeout = SimDuration.FromSeconds(1.5);

    private const int RoundTripsOfTimeout = 4;

    /// <summary>How long a host waits for a world that is behind, after its time is up and the history has passed.</summary>
    private static readonly SimDuration WorldTimeout = SimDuration.FromSeconds(5);

    /// <summary>How long a host that has left keeps answering clients that missed its goodbye.</summary>
    private static readonly TimeSpan GoodbyeTime = TimeSpan.FromMilliseconds(300);

    private readonly Session session;
    private readonly CarrierInUse carrier;
    private readonly SessionRequest request;
    private readonly SessionPrinter printer;
    private readonly CancellationToken stop;
    private readonly PeerThread thread;
    private readonly SessionRecorder? recorder;
    private readonly PrintQueue queue = new();
    private readonly SessionWatch watch;
    private readonly SessionActions actions;
    private readonly CancellationTokenRegistration onStop;
    private bool hasFailed; // for a reason other than an action
    private SimTime? timeoutEnd;

    internal SessionRunner(Session session, CarrierInUse carrier, SessionRequest request, SessionPrinter printer, CancellationToken stop)
    {
        this.session = session;
        this.carrier = carrier;
        this.request = request;
        this.printer = printer;
        this.stop = stop;
        session.Begun += queue.Wake;
        session.Ended += queue.Wake;
        watch = new SessionWatch(session, carrier, request, printer, queue);
        actions = new SessionActions(session, request.Actions, printer, queue);
        if (request.RecordFile is string file)
        {
            recorder = new SessionRecorder(session, file, request.Length);
            recorder.Failed += why => queue.Tell(() => printer.Problem(why));
        }

        thread = new PeerThread(session, carrier.Port, "LagSim session");
        thread.Session.HandlerFailed += failure =>
            queue.Tell(() => printer.Problem($"A handler of a session event failed: {failure.Message}"));
        onStop = stop.Register(() =>
        {
            thread.SkipWarmup();
            queue.Wake();
        });
    }

    /// <summary>Returns the exit code for the way a session ended. A desync or a lost event outranks every other reason.</summary>
    internal static int ExitCodeOf(SessionEnd by, bool isTimeReached, long statesDiffered, long eventsLost, bool hasFailedAction, bool isInterrupted)
    {
        bool isOrderly = by is SessionEnd.Left || (by == SessionEnd.HostEnded && isTimeReached);
        return statesDiffered > 0 || eventsLost > 0 ? ExitCode.CheckFailed
            : isInterrupted ? ExitCode.Interrupted
            : isOrderly && !hasFailedAction ? ExitCode.Done
            : ExitCode.Input;
    }

    /// <summary>Runs the session to its end.</summary>
    /// <returns>The exit code.</returns>
    /// <exception cref="UsageException">An action names a body that the scene does not have.</exception>
    /// <exception cref="OperationCanceledException">The run was cancelled before the session began.</exception>
    internal int Run()
    {
        thread.Start();
        TimeSpan? wait = TimeSpan.Zero;
        Stopwatch asking = Stopwatch.StartNew();
        try
        {
            while (wait is TimeSpan span && !stop.IsCancellationRequested && thread.State != SessionState.Ended)
            {
                queue.Wait(span);
                queue.Print();
                actions.LookAtAttempts();
                watch.LookAtLinks(thread);
                watch.LookAtPace();
                watch.LookAtSilence(asking.Elapsed);
                watch.LookAtWaiting();
                wait = session.World is null ? LookInterval : Tend(session.World.Simulation.Start);
            }
        }
        catch (InvalidOperationException fault) when (fault.InnerException is not null)
        {
            throw new InputException(fault.Message, fault); // an exception ended the session's thread, most likely one from a force
        }

        bool isTimeReached = request.Seconds is null || (session.World is not null && Passed(session.World.Simulation.Start) >= request.Seconds);
        bool isInterrupted = stop.IsCancellationRequested && session.State != SessionState.Ended;
        Leave();
        if (!isInterrupted)
        {
            actions.TellUndone();
        }

        bool hasFailedAction = hasFailed || actions.HaveFailed;
        SessionCounters counters = session.Counters;
        int code = ExitCodeOf(session.EndedBy, isTimeReached, counters.StatesDiffered, counters.EventsLost, hasFailedAction, isInterrupted);
        if (session.EndedBy != SessionEnd.Left && code != ExitCode.Done)
        {
            printer.Problem(EndReason!);
        }

        if (session.World is not null)
        {
            printer.Summary(session, carrier.Counts(), recorder);
        }
        else if (isInterrupted)
        {
            throw new OperationCanceledException(stop); // as for any command that has no result yet
        }
        else
        {
            printer.Failed(EndReason ?? "There was no session.", code);
        }

        return code == ExitCode.Done && recorder?.Failure is not null ? ExitCode.Input : code;
    }

    /// <summary>Runs a function on the session's thread and prints the text it returns. Safe on any thread, at any time.</summary>
    internal void Have(Func<Session, string> what)
    {
        try
        {
            thread.Ask(peer =>
            {
                string answer = what(peer);
                queue.Tell(() => printer.Line(answer));
                return true;
            });
        }
        catch (Exception gone) when (gone is InvalidOperationException or ObjectDisposedException)
        {
            // The session has ended, and so has printing.
        }
    }

    public void Dispose()
    {
        SayGoodbye(); // also after an exception, so that the other peers know
        onStop.Dispose();
        thread.Dispose();
        recorder?.Dispose();
        queue.Dispose();
    }

    /// <summary>Why the session ended, and what the carrier says of a host that was never heard; null while it goes on.</summary>
    private string? EndReason => session.EndedBy == SessionEnd.HostSilent && session.Counters.DatagramsReceived == 0 && carrier.Obstacle() is string obstacle
        ? $"{session.EndReason} {obstacle.TrimEnd('.')}." : session.EndReason;

    private double Passed(SimTime start) => (session.SharedTime.Now - start).ToSeconds();

    /// <summary>Performs whatever is due.</summary>
    /// <returns>The time until the next call; null at the end.</returns>
    private TimeSpan? Tend(SimTime start)
    {
        double passed = Passed(start);
        if (!actions.HaveBegun)
        {
            actions.Begin(session.Scene!, passed);
            if (passed > request.Seconds)
            {
                Fail(FormattableString.Invariant($"--for-s {request.Seconds} was over when this peer came in at T {passed:0.000} s.")
                    + FormattableString.Invariant($" It counts from the session's start: to stay that long from now on, give --for-s {Math.Ceiling(passed + request.Seconds!.Value)};")
                    + " without it the session goes on until Ctrl-C or the host's end.");
            }
        }

        actions.DoDue(thread, passed);
        if (passed >= request.Seconds)
        {
            return HasSettled(start) ? null : LookInterval / 2;
        }

        double next = Math.Min(actions.NextSeconds, request.Seconds ?? double.MaxValue);
        return TimeSpan.FromMilliseconds(Math.Min(Math.Ceiling(1000 * (next - passed)), LookInterval.TotalMilliseconds));
    }

    /// <summary>
    /// Whether the session may end once its time is up: every state until then is committed here. A host also waits a short time for its
    /// clients to receive that and leave.
    /// </summary>
    private bool HasSettled(SimTime start)
    {
        SimDuration interval = request.Options.CommitInterval;
        SimTime last = start + (interval * (long)(request.Seconds!.Value / interval.ToSeconds()));
        bool isCommitted = last == start || session.Committed?.Time >= last;
        SimTime now = session.SharedTime.Now;
        if (session is ClientSession client)
        {
            timeoutEnd ??= now + client.LongestHistory + (request.Options.KeepAlive * 2);
            return (isCommitted && actions.AreSettled) || now >= timeoutEnd;
        }

        if (!isCommitted && now - start > SimDuration.FromSeconds(request.Seconds.Value) + request.Options.MostLateness + WorldTimeout)
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

    private void Fail(string sentence)
    {
        hasFailed = true;
        printer.Problem(sentence);
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
            // The session's thread has ended, so the other peers will notice by their timeouts.
        }

        static bool Goodbye(Session peer)
        {
            peer.Leave();
            return true;
        }
    }

    /// <summary>Leaves the session, stops its thread, and closes the recording.</summary>
    private void Leave()
    {
        SayGoodbye();
        thread.Dispose();
        if (session.State != SessionState.Ended)
        {
            session.Leave(); // its thread was stopped in mid-work, so this thread may call it
        }

        watch.TellDifference();
        queue.Print();
        actions.LookAtAttempts();
        printer.LookAt(session.Links);
        recorder?.Dispose();
    }
}
