using System;
using System.Runtime.CompilerServices;
using System.Threading;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// Who runs a session: a <see cref="PeerThread"/>, whose thread alone may then call it; or nobody but whoever steps it, which is not
/// checked.
/// </summary>
internal sealed class SessionOwner
{
    private Action<Exception>? failed; // the owner's; null for nobody
    private volatile int thread; // by its managed id; 0 until it has entered

    /// <summary>Whether a <see cref="PeerThread"/> runs the session: then what handlers throw is told it, and ends nothing.</summary>
    internal bool IsTaken => Volatile.Read(ref failed) is not null;

    /// <summary>Whether a <see cref="PeerThread"/> runs the session, and the caller is on its thread.</summary>
    internal bool IsCaller => IsTaken && thread == Environment.CurrentManagedThreadId;

    /// <summary>From now on nobody may call the session but the thread that calls <see cref="Enter"/>.</summary>
    /// <param name="onFailure">Told what handlers throw.</param>
    /// <returns>False if it is taken already; nothing changed then.</returns>
    internal bool TryTake(Action<Exception> onFailure) => Interlocked.CompareExchange(ref failed, onFailure, null) is null;

    /// <summary>The caller's thread is the one that steps the session.</summary>
    internal void Enter() => thread = Environment.CurrentManagedThreadId;

    /// <summary>The thread has stopped: anybody may call the session again.</summary>
    internal void Release()
    {
        thread = 0;
        Volatile.Write(ref failed, null);
    }

    internal void TellFailure(Exception failure) => Volatile.Read(ref failed)?.Invoke(failure);

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
