using System;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>Runs a session on its own thread, in real time. It wakes for datagrams, for actions, and when something is due.</summary>
/// <remarks>
/// Members are safe on any thread, but only the drawing thread may call <see cref="Latest"/>, and the session's own may call neither that
/// nor <see cref="WaitUntilRunning"/>. What a handler of an event throws comes to <see cref="Session.HandlerFailed"/>, and ends nothing.
/// </remarks>
/// <example>
/// A host in one program and a client in another; each draws a frame and kicks the ball:
/// <code>
/// using PeerThread me = isHost
///     ? PeerThread.Host(scene, udpPort: 5000, new HostOptions { Unprotected = true }) // or with a Protection
///     : PeerThread.Join(new IPEndPoint(IPAddress.Loopback, 5000));
/// me.Refused += (action, why) => Console.Error.WriteLine($"{action.Kind}: {why.Message}");
/// me.WaitUntilRunning(TimeSpan.FromSeconds(5));
/// _ = me.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0))); // 6 N s upwards
/// if (me.Latest() is RenderSnapshot snapshot &amp;&amp; snapshot.TryRead(ball, me.Session.DisplayTime, out BodyState state))
/// {
///     Console.WriteLine($"height {state.Position.Y:F2} m");
/// }
/// </code>
/// </example>
public sealed class PeerThread : IDisposable
{
    private readonly PeerRequests requests;
    private readonly ActionRequests actions;
    private readonly IDatagramPort port;
    private readonly SessionOwner owner;
    private readonly ActionRefusals refused;
    private readonly WorldThread thread;
    private readonly StateWaiters waiters;
    private readonly object ending = new(); // held while a thread cleans up
    private readonly bool ownsPort;
    private volatile bool isOwner; // from Start to the end of the thread
    private volatile bool isDisposed;
    private bool hasLeftPort; // it no longer wakes the thread, and is disposed if owned
    private volatile bool isWarmupSkipped;
    private Action<Session, Func<bool>>? warmUp; // null once called; for the session's thread only

    /// <summary>Gives the session a thread, which is not started yet. The port is not disposed with it.</summary>
    public PeerThread(Session session, IDatagramPort port, string name)
        : this(session, port, name, ownsPort: false, SessionWarmup.Before)
    {
    }

    // The thread calls warmUp before its first step, with what tells it to wait no longer.
    internal PeerThread(Session session, IDatagramPort port, string name, bool ownsPort, Action<Session, Func<bool>> warmUp)
    {
        this.ownsPort = ownsPort;
        this.warmUp = warmUp;
        Session = session ?? throw new ArgumentNullException(nameof(session));
        this.port = port ?? throw new ArgumentNullException(nameof(port));
        owner = session.Parts.Owner;
        waiters = new StateWaiters(session.Parts.Status);
        refused = new(owner, session.Parts.Clock);
        actions = new ActionRequests(refused, owner.Failures);
        thread = new WorldThread(name, Step, session.Interrupt, End);
        requests = new PeerRequests(session, thread.Wake);
        port.Arrived += thread.Wake;
    }

    /// <summary>Raised on the session's thread for each action of <see cref="Do"/> that was refused, with the action and the exception; before
    /// the returned task completes, awaited or not. The host's verdict on a client's event comes by <see cref="Session.Logged"/>.</summary>
    /// <remarks>Not for what the end of the thread left unanswered. Without a handler it goes to <see cref="System.Diagnostics.Trace"/>, and
    /// the first refusal that nobody awaits either is written to standard error, a second later.</remarks>
    public event Action<PlayerAction, Exception>? Refused
    {
        add => refused.Add(value);
        remove => refused.Remove(value);
    }

    /// <summary>Opens a session over UDP, on a started thread. Disposing it leaves the session and closes the port.</summary>
    /// <param name="scene">The scene that all peers share.</param>
    /// <param name="udpPort">The port to listen on, 0 to 65,535; 0 takes any free port, which <see cref="LocalAddress"/> returns.</param>
    /// <param name="options">How to take part; the default begins at once, and clients may join at any time.</param>
    /// <param name="bind">The address to listen on; default every IPv4 address of this machine.</param>
    /// <param name="setUp">Called with the session before its thread starts, so that you can subscribe to its events and miss none.</param>
    /// <exception cref="System.IO.IOException">The system refuses the port, for instance because it is in use.</exception>
    /// <exception cref="ArgumentException">The port or an option is out of range, the scene is too large to be shared, or nothing protects
    /// the session, other machines can reach it, and the options do not say that this is meant: <see cref="HostOptions.Unprotected"/>.</exception>
    public static PeerThread Host(
        Scene scene, int udpPort = 0, HostOptions? options = null, IPAddress? bind = null, Action<HostSession>? setUp = null)
    {
        if (udpPort is < 0 or > IPEndPoint.MaxPort)
        {
            throw new ArgumentOutOfRangeException(
                nameof(udpPort), udpPort, $"A UDP port is a number from 1 to {IPEndPoint.MaxPort}, or 0 for any that is free.");
        }

        UdpPort port = new(new IPEndPoint(bind ?? IPAddress.Any, udpPort));
        return Begin(port, () => HostSession.Open(scene, port, options, bind is null || !IPAddress.IsLoopback(bind)), "LagSim host", setUp);
    }

    /// <summary>Opens a session over a carrier, on a started thread. Disposing it leaves the session and disposes the carrier.</summary>
    /// <param name="scene">The scene that all peers share.</param>
    /// <param name="carrier">The carrier of datagrams. The thread owns it from now on, and it is disposed even if this throws.</param>
    /// <param name="options">How to take part; the default begins at once, and clients may join at any time.</param>
    /// <param name="setUp">Called with the session before its thread starts, so that you can subscribe to its events and miss none.</param>
    /// <exception cref="ArgumentException">An option is out of range, the scene is too large to be shared, or nothing protects the session,
    /// the network is not virtual and the carrier no <see cref="UdpPort"/> on a loopback address, and the options do not say that this is meant: <see cref="HostOptions.Unprotected"/>.</exception>
    public static PeerThread Host(
        Scene scene, IDatagramPort carrier, HostOptions? options = null, Action<HostSession>? setUp = null) => Begin(
            carrier, () => HostSession.Open(scene, carrier, options, !carrier.LocalAddress.IsVirtual && carrier is not UdpPort { IsForThisMachineAlone: true }),
            "LagSim host", setUp);

    /// <summary>Joins a session over UDP, on a started thread. Disposing it leaves the session and closes the port.</summary>
    /// <param name="host">The host's address: that of one machine, and a port from 1 on.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="scene">The scene that the host is expected to have; null accepts any.</param>
    /// <param name="setUp">Called with the session before its thread starts, so that you can subscribe to its events and miss none.</param>
    /// <exception cref="System.IO.IOException">The system has no free port.</exception>
    /// <exception cref="ArgumentException">The address is not that of one machine, or an option is out of range.</exception>
    public static PeerThread Join(IPEndPoint host, ClientOptions? options = null, Scene? scene = null, Action<ClientSession>? setUp = null)
    {
        if (!UdpDestination.IsOneMachine(host, "join", out string? error))
        {
            throw new ArgumentException(error, nameof(host));
        }

        PeerAddress address = PeerAddress.From(host);
        return Join(new UdpPort(UdpDestination.Facing(address.ToEndPoint().Address)), address, options, scene, setUp);
    }

    /// <summary>Joins a session over a carrier, on a started thread. Disposing it leaves the session and disposes the carrier.</summary>
    /// <param name="carrier">The carrier of datagrams. The thread owns it from now on, and it is disposed even if this throws.</param>
    /// <param name="host">The host's address, in the carrier's terms.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="scene">The scene that the host is expected to have; null accepts any.</param>
    /// <param name="setUp">Called with the session before its thread starts, so that you can subscribe to its events and miss none.</param>
    /// <exception cref="ArgumentException">An option is out of range.</exception>
    public static PeerThread Join(
        IDatagramPort carrier, PeerAddress host, ClientOptions? options = null, Scene? scene = null, Action<ClientSession>? setUp = null) => Begin(
            carrier,
            () => new ClientSession(scene, carrier, new StopwatchClock(), options ?? new ClientOptions(), host, Session.DrawNumber()),
            "LagSim client",
            setUp);

    /// <summary>The address of this peer's port. If it listens on every address, other peers use one of the machine's own.</summary>
    public PeerAddress LocalAddress => port.LocalAddress;

    /// <summary>The session. While the thread runs, read only the members that are documented as safe from any thread.</summary>
    public Session Session { get; }

    /// <summary>The state of the session.</summary>
    /// <exception cref="InvalidOperationException">The thread ended with an exception, the inner one.</exception>
    public SessionState State
    {
        get
        {
            thread.ThrowIfFaulted();
            return Session.State;
        }
    }

    /// <summary>Waits until the world is running or the session has ended. Blocks the caller; <see cref="WhenRunning"/> does not.</summary>
    /// <param name="timeout">The longest time to wait: zero to 24 days, or <see cref="Timeout.InfiniteTimeSpan"/>.</param>
    /// <returns>Whether it is running; if not, <see cref="Session.WhyNotRunning"/> says why.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The timeout is neither.</exception>
    /// <exception cref="InvalidOperationException">
    /// The thread ended with an exception, the inner one; or this is the session's own thread, which would wait for itself.
    /// </exception>
    public bool WaitUntilRunning(TimeSpan timeout)
    {
        ThrowIfOwn(nameof(WaitUntilRunning));
        waiters.Wait(SessionState.Running, timeout);
        return State == SessionState.Running;
    }

    /// <summary>A task that completes once the world is running: <see cref="WhenState"/> with <see cref="SessionState.Running"/>.</summary>
    /// <inheritdoc cref="WhenState"/>
    public Task WhenRunning(TimeSpan timeout, CancellationToken cancellation = default) =>
        WhenState(SessionState.Running, timeout, cancellation);

    /// <summary>A task that completes once the session is in a state, at once if it is. No thread waits for it.</summary>
    /// <param name="state">The state.</param>
    /// <param name="timeout">The longest time to wait: zero to 24 days, or <see cref="Timeout.InfiniteTimeSpan"/>.</param>
    /// <param name="cancellation">Cancels the task.</param>
    /// <returns>It fails with a <see cref="TimeoutException"/> if the time is over, which says <see cref="Session.WhyNotRunning"/>, and with
    /// an <see cref="InvalidOperationException"/> if the session ends instead, which says <see cref="Session.EndReason"/>, or the thread does.</returns>
    /// <remarks>From any thread. What follows an <c>await</c> never runs on the session's thread.</remarks>
    /// <exception cref="ArgumentOutOfRangeException">The timeout is neither.</exception>
    public Task WhenState(SessionState state, TimeSpan timeout, CancellationToken cancellation = default) => waiters.When(state, timeout, cancellation);

    /// <summary>The contact notices given in the session's options; null if none were, and before there is a world.</summary>
    public ContactNotices? Contacts => Session.World?.Contacts;

    /// <summary>The crossing notices given in the session's options; null if none were, and before there is a world.</summary>
    public CrossingNotices? Crossings => Session.World?.Crossings;

    /// <summary>The number of steps done so far.</summary>
    public long Steps => thread.Steps;

    /// <summary>Starts the thread, once. Until this is disposed, members for the session's thread throw on any other.</summary>
    /// <exception cref="InvalidOperationException">It was started before, or another thread runs the session.</exception>
    /// <exception cref="ObjectDisposedException">It has been disposed.</exception>
    public void Start()
    {
        if (!owner.TryTake())
        {
            throw new InvalidOperationException("The session has been started already, on this PeerThread or on another: it runs on one.");
        }

        isOwner = true;
        Session.Parts.World.Watchdog.Abandoned = Abandon;
        try
        {
            thread.Start();
        }
        catch
        {
            Session.Parts.World.Watchdog.Abandoned = null;
            isOwner = false;
            owner.Release();
            throw;
        }
    }

    /// <summary>
    /// The newest render snapshot of the world, for the drawing thread; null before there is a world. A frame reads it at
    /// <see cref="Session.DisplayTime"/>.
    /// </summary>
    /// <exception cref="InvalidOperationException">
    /// The thread ended with an exception, the inner one; or this is the session's own thread, which is not the one that draws.
    /// </exception>
    public RenderSnapshot? Latest()
    {
        ThrowIfOwn(nameof(Latest));
        thread.ThrowIfFaulted();
        return Session.World?.RenderSnapshots.Latest();
    }

    /// <summary>
    /// Performs an action as soon as the session's thread gets to it: at once unless it is busy, or after <see cref="Start"/>.
    /// </summary>
    /// <param name="action">The action.</param>
    /// <param name="at">When, see <see cref="Session.Do"/>; by default now, or later by the local lag.</param>
    /// <remarks>From any thread. Cost: wakes the thread; allocates nothing while fewer than 64 answers are outstanding.</remarks>
    /// <returns>
    /// The stamped event, or the exception that <see cref="Session.Do"/> throws, which <see cref="Refused"/> reports too. The host's
    /// verdict on the event comes later, by <see cref="Session.Logged"/>. Await the task at once and once, or discard it: an answer that is
    /// not awaited is forgotten some 60 calls later. What follows the <c>await</c> runs in the caller's
    /// <see cref="SynchronizationContext"/>, and if it has none on a thread of the pool, where <see cref="Latest"/> may not be called: a
    /// frame discards the task, or keeps it by <see cref="ValueTask{T}.AsTask"/> and looks at it in later frames. A thread that ends first cancels it, or completes it with the exception that ended it.
    /// </returns>
    /// <exception cref="ObjectDisposedException">The thread has been disposed.</exception>
    /// <exception cref="InvalidOperationException">The thread ended with an exception, the inner one.</exception>
    public ValueTask<ExternalEvent> Do(PlayerAction action, SimTime? at = null)
    {
        ThrowIfOver();
        ActionRequest request = actions.Take(action, at);
        ValueTask<ExternalEvent> answer = request.Task; // taken first: once answered, the request may be reused
        requests.Add(request);
        return answer;
    }

    /// <summary>
    /// Runs a function on the session's thread, once it is started. A thread that ends first cancels the task, or completes it with the
    /// exception that ended it.
    /// </summary>
    /// <exception cref="ObjectDisposedException">The thread has been disposed.</exception>
    /// <exception cref="InvalidOperationException">The thread ended with an exception, the inner one.</exception>
    public Task<T> Ask<T>(Func<Session, T> question)
    {
        ThrowIfOver();
        SessionQuestion<T> request = new(question ?? throw new ArgumentNullException(nameof(question)));
        requests.Add(request);
        return request.Task;
    }

    /// <summary>
    /// Stops the thread, even in the middle of a step, and waits for it; if rules do not return from a call, until it is given up
    /// (<see cref="SessionOptions.RuleTimeout"/>). One made by <c>Host</c> or <c>Join</c> leaves its session and
    /// closes its port; any other sends no goodbye, <see cref="Session.Leave"/> does.
    /// </summary>
    /// <remarks>
    /// From any thread, and more than once. In a handler, on the session's own thread, it returns at once and takes effect after the step.
    /// A handler that waits for the thread that disposes this, or for an answer of <see cref="Do"/> or <see cref="Ask"/>, waits for ever.
    /// </remarks>
    public void Dispose()
    {
        isDisposed = true;
        thread.Dispose();
        if (!IsOwnThread)
        {
            End(thread.Fault);
        }
    }

    private static PeerThread Begin<TSession>(IDatagramPort carrier, Func<TSession> make, string name, Action<TSession>? setUp)
        where TSession : Session
    {
        _ = carrier ?? throw new ArgumentNullException(nameof(carrier));
        PeerThread? peer = null;
        try
        {
            TSession session = make();
            peer = new PeerThread(session, carrier, name, ownsPort: true, SessionWarmup.Before);
            setUp?.Invoke(session);
            peer.Start();
            return peer;
        }
        catch
        {
            ((IDisposable?)peer ?? carrier).Dispose();
            throw;
        }
    }

    /// <summary>Has the warm-up waited for no longer, so that what was asked is answered soon. From any thread, at any time.</summary>
    internal void SkipWarmup() => isWarmupSkipped = true;

    private bool IsOwnThread => isOwner && owner.IsCaller;

    private void ThrowIfOwn(string member)
    {
        if (IsOwnThread)
        {
            throw new InvalidOperationException(
                $"'{member}' may not be called on the session's own thread, in a handler or a question: it is for the threads beside it.");
        }
    }

    private void ThrowIfOver()
    {
        thread.ThrowIfFaulted();
        requests.ThrowIfOver();
    }

    /// <summary>One step of the thread's loop; for that thread only, or for the caller if it was never started.</summary>
    internal SimDuration Step()
    {
        owner.Enter();
        warmUp?.Invoke(Session, () => isDisposed || isWarmupSkipped);
        warmUp = null;
        requests.AnswerAll();
        return refused.SayUnheard(Session.Step());
    }

    /// <summary>
    /// Cleans up after the last step: on the session's thread, and again on each thread that disposes this. Whatever is done already stays
    /// as it is, so a thread that was cancelled says goodbye once it is disposed, and one that was never started does all of it then.
    /// </summary>
    /// <param name="fault">What ended the thread. Even then it says goodbye, so that other peers need not wait for the timeout.</param>
    private void End(Exception? fault)
    {
        lock (ending)
        {
            if (isOwner)
            {
                owner.Enter(); // if disposed before its first step, the thread has not entered yet
            }

            bool hasFailed = fault is not (null or OperationCanceledException);
            if (hasFailed)
            {
                owner.Failures.Guard(() => Session.Fail(fault!));
            }
            else if (ownsPort && isDisposed && Session.State != SessionState.Ended)
            {
                owner.Failures.Guard(Session.Leave);
            }

            if (isDisposed && !hasLeftPort) // a handler of the end may have disposed it just now
            {
                hasLeftPort = true;
                owner.Failures.Guard(() => port.Arrived -= thread.Wake);
                owner.Failures.Guard(Session.WipeKeysIfEnded);
                if (ownsPort)
                {
                    owner.Failures.Guard(port.Dispose);
                }
            }

            waiters.Close(hasFailed ? fault : null);
            refused.SayUnheard();
            requests.Close(hasFailed ? fault : null);
            if (isOwner)
            {
                Session.Parts.World.Watchdog.Abandoned = null;
                isOwner = false;
                owner.Release();
            }
        }
    }

    /// <summary>
    /// Rules never return from a call on the session's thread: this thread takes its place, and ends the session. Nobody waits for the
    /// other any more, which never comes back.
    /// </summary>
    private void Abandon(SimulationException why)
    {
        lock (ending)
        {
            thread.Abandon(null);
            owner.Enter();
            owner.Failures.Guard(() => Session.EndLostWorld(why));
            End(why);
            requests.GiveUp(why);
        }
    }
}
