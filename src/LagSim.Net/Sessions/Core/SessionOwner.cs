using System;
using System.Runtime.CompilerServices;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// Who runs a session: a <see cref="PeerThread"/>, whose thread alone may then call it; or nobody but whoever steps it, which is not
/// checked.
/// </summary>
internal sealed class SessionOwner
{
    private Action<Exception>? onFailure;
    private volatile bool isTaken;
    private volatile int thread; // by its managed id

    /// <summary>Whether what handlers throw is told, and ends nothing.</summary>
    internal bool TakesFailures => onFailure is not null;

    /// <summary>Whether a <see cref="PeerThread"/> runs the session, and the caller is on its thread.</summary>
    internal bool IsCaller => isTaken && thread == Environment.CurrentManagedThreadId;

    /// <summary>Has what handlers throw told there, from now on; null lets it go through.</summary>
    internal void TellFailures(Action<Exception>? there) => onFailure = there;

    internal void TellFailure(Exception failure) => onFailure?.Invoke(failure);

    /// <summary>From now on nobody may call the session but the thread that <see cref="Enter"/> names.</summary>
    /// <returns>Whether it was taken already.</returns>
    internal bool Take()
    {
        bool wasTaken = isTaken;
        isTaken = true;
        return wasTaken;
    }

    /// <summary>The caller's thread is the one that steps the session.</summary>
    internal void Enter() => thread = Environment.CurrentManagedThreadId;

    /// <summary>The thread has stopped: anybody may call the session again.</summary>
    internal void Release() => isTaken = false;

    /// <summary>Throws where a <see cref="PeerThread"/> runs the session and the caller is on another thread.</summary>
    /// <exception cref="InvalidOperationException">It is.</exception>
    internal void ThrowIfForeign([CallerMemberName] string member = "")
    {
        if (isTaken && thread != Environment.CurrentManagedThreadId)
        {
            ThrowForeign(member);
        }
    }

    private static void ThrowForeign(string member) => throw new InvalidOperationException(
        $"'{member}' is for the session's own thread while a PeerThread runs it, and was called on another."
            + " Use PeerThread.Do for an action, and PeerThread.Ask for anything else.");
}
