using System;
using System.Collections.Concurrent;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>A session on a thread of its own, in real time: woken by datagrams, by actions, and when something is due.</summary>
/// <remarks>Every member may be called from any thread, but <see cref="Latest"/> from one only, the one that draws.</remarks>
public sealed class PeerThread : IDisposable
{
    private readonly ConcurrentQueue<Action> requests = new();
    private readonly IDatagramPort port;
    private readonly WorldThread thread;
    private volatile bool disposed;

    /// <summary>Gives the session a thread; it is not started yet. The port is not disposed with it.</summary>
    public PeerThread(Session session, IDatagramPort port, string name)
    {
        Session = session ?? throw new ArgumentNullException(nameof(session));
        this.port = port ?? throw new ArgumentNullException(nameof(port));
        thread = new WorldThread(name, Step, session.Interrupt);
        port.Arrived += thread.Wake;
    }

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

    /// <summary>How many steps the thread has done.</summary>
    public long Steps => thread.Steps;

    /// <summary>Starts the thread; once.</summary>
    public void Start() => thread.Start();

    /// <summary>The newest picture of the world, for the one thread that draws; null before there is a world.</summary>
    /// <exception cref="InvalidOperationException">The thread ended by an exception, the inner one.</exception>
    public Picture? Latest()
    {
        thread.ThrowIfFaulted();
        return Session.World?.Pictures.Latest();
    }

    /// <summary>Does something to the shared world as soon as the session's thread gets to it, which is at once unless it is at work.
    /// Asked before <see cref="Start"/>, it waits for the thread.</summary>
    /// <returns>The stamped event, or the exception that <see cref="Session.Do"/> throws.</returns>
    public Task<ExternalEvent> Do(PlayerAction action) => Ask(session => session.Do(action));

    /// <summary>Asks the session something on its own thread; answered once the thread is started, cancelled if it is disposed before.</summary>
    /// <exception cref="ObjectDisposedException">The thread has been disposed.</exception>
    /// <exception cref="InvalidOperationException">The thread ended by an exception, the inner one.</exception>
    public Task<T> Ask<T>(Func<Session, T> question)
    {
        thread.ThrowIfFaulted();
        if (disposed)
        {
            throw new ObjectDisposedException(nameof(PeerThread));
        }

        TaskCompletionSource<T> answer = new(TaskCreationOptions.RunContinuationsAsynchronously);
        requests.Enqueue(() =>
        {
            if (disposed)
            {
                answer.SetCanceled();
                return;
            }

            try
            {
                answer.SetResult(question(Session));
            }
            catch (Exception failure)
            {
                answer.SetException(failure);
            }
        });
        thread.Wake();
        if (disposed)
        {
            AnswerAll(); // it was disposed meanwhile, and nobody else will
        }

        return answer.Task;
    }

    /// <summary>Stops the thread, in the middle of its work if it is at some, and waits for it. It does not say goodbye; <see cref="Session.Leave"/> does.</summary>
    public void Dispose()
    {
        port.Arrived -= thread.Wake;
        thread.Dispose();
        disposed = true;
        AnswerAll();
    }

    private void AnswerAll()
    {
        while (requests.TryDequeue(out Action? request))
        {
            request();
        }
    }

    private SimDuration Step()
    {
        try
        {
            AnswerAll();
            return Session.Step();
        }
        catch
        {
            disposed = true; // the thread ends with the exception: who still waits for an answer gets none
            AnswerAll();
            throw;
        }
    }
}
