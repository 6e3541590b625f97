using System;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>A session on a thread of its own, in real time: woken by datagrams, by actions, and when something is due.</summary>
/// <remarks>
/// Every member may be called from any thread, but <see cref="Latest"/> from one only, the one that draws, and neither that nor
/// <see cref="WaitUntilRunning"/> from the session's own. What a handler of a session's event throws is told by
/// <see cref="HandlerFailed"/>, and ends nothing.
/// </remarks>
/// <example>
/// A host in one program and a client in another; each draws a frame and kicks the ball:
/// <code>
/// using PeerThread me = isHost
///     ? PeerThread.Host(scene, udpPort: 5000)
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
    private readonly PeerFailures failures;
    private readonly WorldThread thread;
    private readonly ManualResetEventSlim decided = new(); // running or ended
    private readonly bool ownsPort;
    private volatile bool isOwner; // from the start on
    private volatile bool isDisposed;
    private int hasEnded; // 1 once it has
    private int hasClosed; // 1 once the port is
    private Action<LateEventStrategy>? warmUp; // null once it is done; the session's thread alone

    /// <summary>Gives the session a thread; it is not started yet. The port is not disposed with it.</summary>
    public PeerThread(Session session, IDatagramPort port, string name)
        : this(session, port, name, ownsPort: false, SessionWarmup.Once)
    {
    }

    // Before its first step the thread calls warmUp, with the session's strategy.
    internal PeerThread(Session session, IDatagramPort port, string name, bool ownsPort, Action<LateEventStrategy> warmUp)
    {
        this.ownsPort = ownsPort;
        this.warmUp = warmUp;
        Session = session ?? throw new ArgumentNullException(nameof(session));
        this.port = port ?? throw new ArgumentNullException(nameof(port));
        owner = session.Parts.Owner;
        failures = new PeerFailures(owner);
        actions = new ActionRequests(failures.TellRefused);
        thread = new WorldThread(name, Step, session.Interrupt, End);
        requests = new PeerRequests(session, thread.Wake);
        port.Arrived += thread.Wake;
    }

    /// <summary>
    /// Raised on the session's thread when a handler of one of the session's events threw, with what it threw. The other handlers are
    /// called, and nothing ends.
    /// </summary>
    /// <remarks>
    /// Where nobody listens it is written to <see cref="System.Diagnostics.Trace"/>, and so is what a handler of this event throws. While the thread ends,
    /// it may be raised by whoever disposes it.
    /// </remarks>
    public event Action<Exception>? HandlerFailed
    {
        add => failures.HandlerFailed += value;
        remove => failures.HandlerFailed -= value;
    }

    /// <summary>
    /// Raised on the session's thread for each action of <see cref="Do"/> that was refused, whether or not the answer is awaited, and
    /// before it is there: the action, and the exception. The host's verdict on a client's event comes later, by
    /// <see cref="Session.Logged"/>. What the end of the thread left unanswered is cancelled, and not told here.
    /// </summary>
    /// <remarks>Where nobody listens, the refusal is written to <see cref="System.Diagnostics.Trace"/>.</remarks>
    public event Action<PlayerAction, Exception>? Refused
    {
        add => failures.Refused.Add(value);
        remove => failures.Refused.Remove(value);
    }

    /// <summary>Opens a session over UDP, on a thread that is started. Disposing it leaves the session and closes the port.</summary>
    /// <param name="scene">The scene that all share.</param>
    /// <param name="udpPort">Where others reach it, 0 to 65,535; 0 takes any free port, which <see cref="LocalAddress"/> tells.</param>
    /// <param name="options">How to take part; default begins at once, whoever joins later.</param>
    /// <param name="bind">The address to listen at; default every IPv4 address this machine has.</param>
    /// <param name="setUp">Called with the session before its thread starts, to subscribe to its events: so nothing is missed.</param>
    /// <exception cref="System.IO.IOException">The system does not give the port, for instance because it is in use.</exception>
    /// <exception cref="ArgumentException">The port or an option is out of its range, or the scene is too large to be shared.</exception>
    public static PeerThread Host(
        Scene scene, int udpPort = 0, HostOptions? options = null, IPAddress? bind = null, Action<HostSession>? setUp = null)
    {
        if (udpPort is < 0 or > IPEndPoint.MaxPort)
        {
            throw new ArgumentOutOfRangeException(
                nameof(udpPort), udpPort, $"A UDP port is a number from 1 to {IPEndPoint.MaxPort}, or 0 for any that is free.");
        }

        return Host(scene, new UdpPort(new IPEndPoint(bind ?? IPAddress.Any, udpPort)), options, setUp);
    }

    /// <summary>Opens a session over a carrier, on a thread that is started. Disposing it leaves the session and disposes the carrier.</summary>
    /// <param name="scene">The scene that all share.</param>
    /// <param name="carrier">What carries datagrams; from now on the thread's own. It is disposed too where this throws.</param>
    /// <param name="options">How to take part; default begins at once, whoever joins later.</param>
    /// <param name="setUp">Called with the session before its thread starts, to subscribe to its events: so nothing is missed.</param>
    /// <exception cref="ArgumentException">An option is out of its range, or the scene is too large to be shared.</exception>
    public static PeerThread Host(
        Scene scene, IDatagramPort carrier, HostOptions? options = null, Action<HostSession>? setUp = null) => Begin(
            carrier,
            () => new HostSession(scene, carrier, new StopwatchClock(), options ?? new HostOptions(), Session.DrawNumber()),
            "LagSim host",
            setUp);

    /// <summary>Joins a session over UDP, on a thread that is started. Disposing it leaves the session and closes the port.</summary>
    /// <param name="host">Where the host is: the address of one machine, and a port from 1 on.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="scene">The scene that the host is expected to have; null takes the host's, whichever it is.</param>
    /// <param name="setUp">Called with the session before its thread starts, to subscribe to its events: so nothing is missed.</param>
    /// <exception cref="System.IO.IOException">The system gives no port.</exception>
    /// <exception cref="ArgumentException">That is no machine's address, or an option is out of its range.</exception>
    public static PeerThread Join(IPEndPoint host, ClientOptions? options = null, Scene? scene = null, Action<ClientSession>? setUp = null)
    {
        if (!UdpDestination.IsOneMachine(host, "join", out string? error))
        {
            throw new ArgumentException(error, nameof(host));
        }

        PeerAddress address = PeerAddress.From(host);
        return Join(new UdpPort(UdpDestination.Facing(address.ToEndPoint().Address)), address, options, scene, setUp);
    }

    /// <summary>Joins a session over a carrier, on a thread that is started. Disposing it leaves the session and disposes the carrier.</summary>
    /// <param name="carrier">What carries datagrams; from now on the thread's own. It is disposed too where this throws.</param>
    /// <param name="host">Where the host is, as the carrier knows it.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="scene">The scene that the host is expected to have; null takes the host's, whichever it is.</param>
    /// <param name="setUp">Called with the session before its thread starts, to subscribe to its events: so nothing is missed.</param>
    /// <exception cref="ArgumentException">An option is out of its range.</exception>
    public static PeerThread Join(
        IDatagramPort carrier,
        PeerAddress host,
        ClientOptions? options = null,
        Scene? scene = null,
        Action<ClientSession>? setUp = null) => Begin(
            carrier,
            () => new ClientSession(scene, carrier, new StopwatchClock(), options ?? new ClientOptions(), host, Session.DrawNumber()),
            "LagSim client",
            setUp);

    /// <summary>Where this peer's port is reached; where it listens at every address, others use one of the machine's own.</summary>
    public PeerAddress LocalAddress => port.LocalAddress;

    /// <summary>The session. While the thread runs, read of it only what it says may be read from any thread.</summary>
    public Session Session { get; }

    /// <summary>Where the peer stands.</summary>
    /// <exception cref="InvalidOperationException">The thread ended by an exception, the inner one.</exception>
    public SessionState State
    {
        get
        {
            thread.ThrowIfFaulted();
            return Session.State;
        }
    }

    /// <summary>Waits until there is a running world, or the session has ended.</summary>
    /// <param name="timeout">How long at most.</param>
    /// <returns>Whether it runs; if not, <see cref="Session.EndReason"/> tells why if it has ended.</returns>
    /// <exception cref="InvalidOperationException">
    /// The thread ended by an exception, the inner one; or this is the session's own thread, which would wait for itself.
    /// </exception>
    public bool WaitUntilRunning(TimeSpan timeout)
    {
        ThrowIfOwn(nameof(WaitUntilRunning));
        decided.Wait(timeout);
        return State == SessionState.Running;
    }

    /// <summary>What tells of contacts, as the session's options gave it; null for nobody, and before there is a world.</summary>
    public ContactNotices? Contacts => Session.World?.Contacts;

    /// <summary>How many steps the thread has done.</summary>
    public long Steps => thread.Steps;

    /// <summary>Starts the thread; once. Until this is disposed, what is for the session's thread throws on any other.</summary>
    /// <exception cref="InvalidOperationException">It has been started already, or another thread runs the session.</exception>
    /// <exception cref="ObjectDisposedException">It has been disposed.</exception>
    public void Start()
    {
        if (!owner.TryTake(failures.TellFailure))
        {
            throw new InvalidOperationException("The session has been started already, on this PeerThread or on another: it runs on one.");
        }

        isOwner = true;
        try
        {
            thread.Start();
        }
        catch
        {
            isOwner = false;
            owner.Release();
            throw;
        }
    }

    /// <summary>
    /// The newest render snapshot of the world, for the one thread that draws; null before there is a world. A frame reads it at
    /// <see cref="Session.DisplayTime"/>.
    /// </summary>
    /// <exception cref="InvalidOperationException">
    /// The thread ended by an exception, the inner one; or this is the session's own thread, which is not the one that draws.
    /// </exception>
    public RenderSnapshot? Latest()
    {
        ThrowIfOwn(nameof(Latest));
        thread.ThrowIfFaulted();
        return Session.World?.RenderSnapshots.Latest();
    }

    /// <summary>Does something to the shared world as soon as the session's thread gets to it, which is at once unless it is at work.
    /// Asked before <see cref="Start"/>, it waits for the thread. From any thread. Cost: wakes the thread, and allocates nothing while
    /// fewer than 64 answers are outstanding.</summary>
    /// <returns>
    /// The stamped event, or the exception that <see cref="Session.Do"/> throws: <see cref="Refused"/> tells that too. What the host makes
    /// of the event is heard later, by <see cref="Session.Logged"/>. Await it at once, once, or let it go: an answer that nobody awaits is
    /// forgotten some 60 calls later.
    /// </returns>
    /// <exception cref="ObjectDisposedException">The thread has been disposed.</exception>
    /// <exception cref="InvalidOperationException">The thread ended by an exception, the inner one.</exception>
    public ValueTask<ExternalEvent> Do(PlayerAction action)
    {
        ThrowIfOver();
        ActionRequest request = actions.Take(action);
        ValueTask<ExternalEvent> answer = request.Task; // before it is asked: answered, it may be used again
        requests.Add(request);
        return answer;
    }

    /// <summary>Asks the session something on its own thread; answered once that is started, cancelled if it is disposed before.</summary>
    /// <exception cref="ObjectDisposedException">The thread has been disposed.</exception>
    /// <exception cref="InvalidOperationException">The thread ended by an exception, the inner one.</exception>
    public Task<T> Ask<T>(Func<Session, T> question)
    {
        ThrowIfOver();
        SessionQuestion<T> request = new(question ?? throw new ArgumentNullException(nameof(question)));
        requests.Add(request);
        return request.Task;
    }

    /// <summary>Stops the thread, in the middle of its work if it is at some, and waits for it. One that <c>Host</c> or <c>Join</c> made
    /// leaves its session and closes its port; any other does not say goodbye, <see cref="Session.Leave"/> does.</summary>
    /// <remarks>
    /// From any thread, and more than once. On the session's own, in a handler, it returns at once, and all this is done after the step.
    /// </remarks>
    public void Dispose()
    {
        isDisposed = true;
        thread.Dispose();
        if (!IsOwnThread)
        {
            End(thread.Fault); // of a thread that was never started; else its thread has done so
            ClosePort(); // that of a thread that had failed is still open
        }
    }

    private static PeerThread Begin<TSession>(IDatagramPort carrier, Func<TSession> make, string name, Action<TSession>? setUp)
        where TSession : Session
    {
        _ = carrier ?? throw new ArgumentNullException(nameof(carrier));

        try
        {
            TSession session = make();
            PeerThread peer = new(session, carrier, name, ownsPort: true, SessionWarmup.Once);
            setUp?.Invoke(session);
            peer.Start();
            return peer;
        }
        catch
        {
            carrier.Dispose();
            throw;
        }
    }

    /// <summary>On this thread and not the game's, and before anything is answered, so that an action waits for it at worst once.</summary>
    private void WarmUp()
    {
        if (Session.WarmsUpFor is LateEventStrategy strategy)
        {
            warmUp?.Invoke(strategy);
        }

        warmUp = null;
    }

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
        if (requests.AreOver)
        {
            throw new ObjectDisposedException(nameof(PeerThread));
        }
    }

    /// <summary>What its thread does again and again; for that thread alone, or whoever has not started it.</summary>
    internal SimDuration Step()
    {
        owner.Enter();
        WarmUp();
        requests.AnswerAll();
        SimDuration wait = Session.Step();
        if (Session.State is SessionState.Running or SessionState.Ended)
        {
            decided.Set();
        }

        return wait;
    }

    /// <summary>What there is to do after the last step, once: on the thread that did it, or of a thread never started on whoever disposes it.</summary>
    /// <param name="fault">What ended it; whatever went wrong here, the others need not wait for the time-out.</param>
    private void End(Exception? fault)
    {
        if (Interlocked.Exchange(ref hasEnded, 1) != 0)
        {
            return;
        }

        port.Arrived -= thread.Wake;
        if (isOwner)
        {
            owner.Enter(); // disposed before its first step, it has not done so yet
        }

        if (fault is not (null or OperationCanceledException) || (ownsPort && isDisposed))
        {
            try
            {
                Session.Leave();
            }
            catch (Exception failure) when (failure is not OutOfMemoryException)
            {
                failures.TellFailure(failure); // beside what ended the thread, which is told whoever relies on it
            }
        }

        if (isDisposed)
        {
            ClosePort();
        }

        decided.Set();
        requests.Close();
        if (isOwner)
        {
            owner.Release();
        }
    }

    private void ClosePort()
    {
        if (ownsPort && Interlocked.Exchange(ref hasClosed, 1) == 0)
        {
            port.Dispose();
        }
    }
}
