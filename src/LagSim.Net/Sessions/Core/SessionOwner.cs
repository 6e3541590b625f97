using System;
using System.Runtime.CompilerServices;
using System.Threading;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// The owner of a session: a <see cref="PeerThread"/>, whose thread alone may then call it, or none. Without an owner the calling thread is
/// not checked.
/// </summary>
internal sealed class SessionOwner
{
    private Action<Exception>? failed; // the owner's; null without an owner
    private volatile int thread; // the managed id; 0 until it has entered

    /// <summary>
    /// Whether a <see cref="PeerThread"/> runs the session. If so, it is notified of exceptions from handlers, and they end nothing.
    /// </summary>
    internal bool IsTaken => Volatile.Read(ref failed) is not null;

    /// <summary>Whether a <see cref="PeerThread"/> runs the session, and the caller is on its thread.</summary>
    internal bool IsCaller => IsTaken && thread == Environment.CurrentManagedThreadId;

    /// <summary>Takes ownership. From now on only the thread that calls <see cref="Enter"/> may call the session.</summary>
    /// <param name="onFailure">Called with the exceptions that handlers throw.</param>
    /// <returns>False if it is taken already; nothing changed then.</returns>
    internal bool TryTake(Action<Exception> onFailure) => Interlocked.CompareExchange(ref failed, onFailure, null) is null;

    /// <summary>Makes the caller's thread the one that steps the session.</summary>
    internal void Enter() => thread = Environment.CurrentManagedThreadId;

    /// <summary>Releases the session once the thread has stopped: any thread may call it again.</summary>
    internal void Release()
    {
        thread = 0;
        Volatile.Write(ref failed, null);
    }

    internal void TellFailure(Exception failure) => Volatile.Read(ref failed)?.Invoke(failure);

    /// <summary>Throws if a <see cref="PeerThread"/> runs the session and the caller is on another thread.</summary>
    /// <exception cref="InvalidOperationException">The caller is on another thread.</exception>
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
