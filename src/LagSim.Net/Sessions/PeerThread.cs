using System;
using System.Collections.Concurrent;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>A session on a thread of its own, in real time: woken by datagrams, by actions, and when something is due.</summary>
/// <remarks>Every member may be called from any thread, but <see cref="Latest"/> from one only, the one that draws.</remarks>
public sealed class PeerThread : IDisposable
{
    private readonly ConcurrentQueue<IPeerRequest> requests = new();
    private readonly ActionRequests actions = new();
    private readonly IDatagramPort port;
    private readonly WorldThread thread;
    private readonly ManualResetEventSlim decided = new(); // running or ended
    private readonly bool ownsPort;
    private volatile bool disposed;
    private bool isWarm; // the session's thread alone

    /// <summary>Gives the session a thread; it is not started yet. The port is not disposed with it.</summary>
    public PeerThread(Session session, IDatagramPort port, string name)
        : this(session, port, name, ownsPort: false)
    {
    }

    private PeerThread(Session session, IDatagramPort port, string name, bool ownsPort)
    {
        this.ownsPort = ownsPort;
        Session = session ?? throw new ArgumentNullException(nameof(session));
        this.port = port ?? throw new ArgumentNullException(nameof(port));
        thread = new WorldThread(name, Step, session.Interrupt);
        port.Arrived += thread.Wake;
    }

    /// <summary>Opens a session over UDP on a thread that is started already. Disposing it leaves the session and closes the port.</summary>
    /// <param name="scene">The scene that all share.</param>
    /// <param name="udpPort">Where others reach it, 0 to 65,535; 0 takes any free port, which <see cref="LocalAddress"/> tells.</param>
    /// <param name="options">How to take part; default begins at once, whoever joins later.</param>
    /// <param name="bind">The address to listen at; default every IPv4 address this machine has.</param>
    /// <exception cref="System.IO.IOException">The system does not give the port, for instance because it is in use.</exception>
    /// <exception cref="ArgumentException">The port or an option is out of its range, or the scene is too large to be shared.</exception>
    public static PeerThread Host(Scene scene, int udpPort = 0, SessionOptions? options = null, IPAddress? bind = null)
    {
        if (udpPort is < 0 or > IPEndPoint.MaxPort)
        {
            throw new ArgumentOutOfRangeException(nameof(udpPort), udpPort, $"A UDP port is a number from 1 to {IPEndPoint.MaxPort}, or 0 for any that"
                + " is free.");
        }

        UdpPort port = new(new IPEndPoint(bind ?? IPAddress.Any, udpPort));
        return Begin(port, () => new HostSession(scene, port, new StopwatchClock(), options ?? new SessionOptions(), Session.DrawNumber()), "LagSim host");
    }

    /// <summary>Joins a session over UDP on a thread that is started already. Disposing it leaves the session and closes the port.</summary>
    /// <param name="host">Where the host is: the address of one machine, and a port from 1 on.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="scene">The scene that the host is expected to have; null takes the host's, whichever it is.</param>
    /// <exception cref="System.IO.IOException">The system gives no port.</exception>
    /// <exception cref="ArgumentException">That is no machine's address, or an option is out of its range.</exception>
    public static PeerThread Join(IPEndPoint host, SessionOptions? options = null, Scene? scene = null)
    {
        if (!UdpDestination.IsOneMachine(host, "join", out string? error))
        {
            throw new ArgumentException(error, nameof(host));
        }

        PeerAddress address = PeerAddress.From(host);
        UdpPort port = new(UdpDestination.Facing(address.ToEndPoint().Address));
        return Begin(
            port, () => new ClientSession(scene, port, new StopwatchClock(), options ?? new SessionOptions(), address, Session.DrawNumber()), "LagSim joiner");
    }

    /// <summary>
    /// Where this peer's port is reached, from this machine only if it listens at every address there is: then others use one of the machine's own.
    /// </summary>
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
    /// <exception cref="InvalidOperationException">The thread ended by an exception, the inner one.</exception>
    public bool WaitUntilRunning(TimeSpan timeout)
    {
        decided.Wait(timeout);
        return State == SessionState.Running;
    }

    /// <summary>What tells of contacts, as the session's options gave it; null for nobody, and before there is a world.</summary>
    public ContactNotices? Contacts => Session.World?.Contacts;

    /// <summary>What the thread does before its first step, given the session's strategy; to be set before it is started.</summary>
    internal Action<string> WarmUpFor { get; set; } = SessionWarmup.Once;

    /// <summary>How many steps the thread has done.</summary>
    public long Steps => thread.Steps;

    /// <summary>Starts the thread; once.</summary>
    public void Start() => thread.Start();

    /// <summary>
    /// The newest render snapshot of the world, for the one thread that draws; null before there is a world. A frame reads it at <see cref="Session.DisplayTime"/>.
    /// </summary>
    /// <exception cref="InvalidOperationException">The thread ended by an exception, the inner one.</exception>
    public RenderSnapshot? Latest()
    {
        thread.ThrowIfFaulted();
        return Session.World?.RenderSnapshots.Latest();
    }

    /// <summary>Does something to the shared world as soon as the session's thread gets to it, which is at once unless it is at work.
    /// Asked before <see cref="Start"/>, it waits for the thread. From any thread. Cost: allocates nothing, and wakes the thread.</summary>
    /// <returns>
    /// The stamped event, or the exception that <see cref="Session.Do"/> throws: look at it, or what was refused goes unnoticed. What the host makes of the
    /// event is heard later, by <see cref="Session.Logged"/>. Await it at once, once, or let it go: an answer that nobody awaits is forgotten some 60 calls later.
    /// </returns>
    /// <exception cref="ObjectDisposedException">The thread has been disposed.</exception>
    /// <exception cref="InvalidOperationException">The thread ended by an exception, the inner one.</exception>
    public ValueTask<ExternalEvent> Do(PlayerAction action)
    {
        ThrowIfOver();
        ActionRequest request = actions.Take(action);
        ValueTask<ExternalEvent> answer = request.Task; // before it is asked: answered, it may be used again
        Send(request);
        return answer;
    }

    /// <summary>Asks the session something on its own thread; answered once the thread is started, cancelled if it is disposed before.</summary>
    /// <exception cref="ObjectDisposedException">The thread has been disposed.</exception>
    /// <exception cref="InvalidOperationException">The thread ended by an exception, the inner one.</exception>
    public Task<T> Ask<T>(Func<Session, T> question)
    {
        if (question is null)
        {
            throw new ArgumentNullException(nameof(question));
        }

        ThrowIfOver();
        SessionQuestion<T> request = new(question);
        Send(request);
        return request.Task;
    }

    /// <summary>Stops the thread, in the middle of its work if it is at some, and waits for it. One that <see cref="Host"/> or <see cref="Join"/> made
    /// leaves its session and closes its port; any other does not say goodbye, <see cref="Session.Leave"/> does.</summary>
    public void Dispose()
    {
        port.Arrived -= thread.Wake;
        thread.Dispose();
        disposed = true;
        decided.Set();
        AnswerAll();
        if (ownsPort)
        {
            Session.Leave(); // its thread has stopped, so this one may
            port.Dispose();
        }
    }

    private static PeerThread Begin(UdpPort port, Func<Session> make, string name)
    {
        try
        {
            PeerThread peer = new(make(), port, name, ownsPort: true);
            peer.Start();
            return peer;
        }
        catch
        {
            port.Dispose();
            throw;
        }
    }

    /// <summary>On this thread and not the game's, and before anything is answered, so that what is done waits for it at worst once.</summary>
    private void WarmUp()
    {
        if (!isWarm)
        {
            isWarm = true;
            if (Session.WarmsUpFor is string strategy)
            {
                WarmUpFor(strategy);
            }
        }
    }

    private void ThrowIfOver()
    {
        thread.ThrowIfFaulted();
        if (disposed)
        {
            throw new ObjectDisposedException(nameof(PeerThread));
        }
    }

    private void Send(IPeerRequest request)
    {
        requests.Enqueue(request);
        thread.Wake();
        if (disposed)
        {
            AnswerAll(); // it was disposed meanwhile, and nobody else will
        }
    }

    private void AnswerAll()
    {
        while (requests.TryDequeue(out IPeerRequest? request))
        {
            if (disposed)
            {
                request.Cancel();
            }
            else
            {
                request.Answer(Session);
            }
        }
    }

    /// <summary>Whatever went wrong here, the others need not wait for the time-out.</summary>
    private void SayGoodbye()
    {
        try
        {
            Session.Leave();
        }
        catch (Exception failure) when (failure is not OutOfMemoryException)
        {
            // What ends the thread is told; that leaving failed too adds nothing.
        }
    }

    /// <summary>What its thread does again and again; for that thread alone, or whoever has not started it.</summary>
    internal SimDuration Step()
    {
        try
        {
            WarmUp();
            AnswerAll();
            SimDuration wait = Session.Step();
            if (Session.State is SessionState.Running or SessionState.Ended)
            {
                decided.Set();
            }

            return wait;
        }
        catch (Exception failure)
        {
            if (failure is not OperationCanceledException)
            {
                SayGoodbye();
            }

            decided.Set();
            disposed = true; // the thread ends with the exception: who still waits for an answer gets none
            AnswerAll();
            throw;
        }
    }
}
