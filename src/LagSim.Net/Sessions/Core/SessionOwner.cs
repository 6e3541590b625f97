using System;
using System.Runtime.CompilerServices;
using System.Threading;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// The thread that runs a session: that of a <see cref="PeerThread"/>, which alone may then call it; or any that steps it, which is not
/// checked.
/// </summary>
internal sealed class SessionOwner
{
    private int isTaken; // 1 if a PeerThread runs the session
    private volatile int thread; // the managed id of its thread; 0 until it has entered

    /// <summary>Whether a <see cref="PeerThread"/> runs the session: what handlers throw is then reported, and ends nothing.</summary>
    internal bool IsTaken => Volatile.Read(ref isTaken) != 0;

    /// <summary>Whether a <see cref="PeerThread"/> runs the session, and the caller is on its thread.</summary>
    internal bool IsCaller => IsTaken && thread == Environment.CurrentManagedThreadId;

    /// <summary>Where the exceptions of handlers go.</summary>
    internal HandlerFailures Failures { get; } = new();

    /// <summary>From now on only the thread that calls <see cref="Enter"/> may call the session.</summary>
    /// <returns>False if it is taken already; then nothing has changed.</returns>
    internal bool TryTake() => Interlocked.CompareExchange(ref isTaken, 1, 0) == 0;

    /// <summary>Makes the caller's thread the one that steps the session.</summary>
    internal void Enter() => thread = Environment.CurrentManagedThreadId;

    /// <summary>The thread has stopped: any other may call the session again.</summary>
    internal void Release()
    {
        thread = 0;
        Volatile.Write(ref isTaken, 0);
    }

    /// <summary>Throws where a <see cref="PeerThread"/> runs the session and the caller is on another thread.</summary>
    /// <exception cref="InvalidOperationException">It is.</exception>
    internal void ThrowIfForeign([CallerMemberName] string member = "")
    {
        if (IsTaken && thread != Environment.CurrentManagedThreadId)
        {
            ThrowForeign(member);
        }
    }

    private static void ThrowForeign(string member) => throw new InvalidOperationException(
        $"'{member}' is for the session's own thread while a PeerThread runs it, and was called on another."
            + " Use PeerThread.Do for an action, and PeerThread.Ask for anything else.");
}
