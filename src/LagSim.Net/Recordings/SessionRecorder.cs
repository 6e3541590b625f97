using System;
using System.Collections.Generic;
using System.IO;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace LagSim.Net.Recordings;

/// <summary>Records a session as seen by one peer: its log, and the hashes of its committed states.</summary>
/// <remarks>
/// <para>It subscribes to the session and writes on the session's thread, to a file that is created once there is a world. A disk failure
/// does not end the session: the recording just ends there, and <see cref="Failure"/> and <see cref="Failed"/> report it. When a fresh
/// snapshot replaces the world, the recording ends with that reason and another begins, in a file named after the first: after
/// <c>game.lagsim</c>, <c>game.2.lagsim</c>.</para>
/// <para>Create it before the session's first step, and dispose it on the session's thread or once that has stopped.</para>
/// </remarks>
public sealed class SessionRecorder : IDisposable
{
    /// <summary>
    /// The number of log entries that can wait for the world's start. All of them are refusals, and only a peer that does nothing else
    /// causes that many.
    /// </summary>
    internal const int MaxWaiting = 1 << 16;

    private readonly Session session;
    private readonly Func<int, (Stream Stream, string? File)> open; // takes the number of the recording within the session, from 1
    private int count;
    private volatile string[] files = Array.Empty<string>(); // replaced, never modified, so that any thread may read it
    private readonly SimDuration length;
    private readonly List<LogEntry> waiting = new();
    private RecordingWriter? writer;
    private volatile string? failure;
    private bool isDisposed;

    /// <summary>Records a session that has no world yet.</summary>
    /// <param name="session">The session.</param>
    /// <param name="path">
    /// The file, which is created or replaced once there is a world; its name should end with <see cref="RecordingFormat.Extension"/>.
    /// Failing to create it is a <see cref="Failure"/> like any other.
    /// </param>
    /// <param name="length">Committed states later than this after the session's start are left out; null includes all.</param>
    /// <exception cref="ArgumentException">The path is empty, or only white space.</exception>
    /// <exception cref="InvalidOperationException">The session has a world already: earlier events would be missing.</exception>
    public SessionRecorder(Session session, string path, SimDuration? length = null)
        : this(session, length, Opener(path))
    {
    }

    internal SessionRecorder(Session session, Func<int, Stream> open, SimDuration? length = null)
        : this(session, length, number => (open(number), null))
    {
    }

    private SessionRecorder(Session session, SimDuration? length, Func<int, (Stream Stream, string? File)> open)
    {
        this.session = session ?? throw new ArgumentNullException(nameof(session));
        this.open = open;
        this.length = length ?? SimDuration.MaxValue;
        if (session.World is not null)
        {
            throw new InvalidOperationException("A session is recorded from its beginning on; this one has a world already.");
        }

        session.Begun += OnBegun;
        session.Renewed += OnRenewed;
        session.Logged += OnLogged;
        session.StateCommitted += OnCommitted;
    }

    /// <summary>
    /// Raised once, on the session's thread, when nothing more can be recorded, with the sentence of <see cref="Failure"/>. Handlers must
    /// not throw.
    /// </summary>
    public event Action<string>? Failed;

    /// <summary>Why nothing more is recorded, as a sentence; null while all is well. From any thread.</summary>
    public string? Failure => failure;

    /// <summary>
    /// The files written so far, in order: none before there is a world, then the requested one, and one more for each fresh snapshot that
    /// replaced the world. From any thread.
    /// </summary>
    public IReadOnlyList<string> Files => files;

    /// <summary>Ends the recording with the session's end reason, and closes the file.</summary>
    public void Dispose()
    {
        if (isDisposed)
        {
            return;
        }

        isDisposed = true;
        session.Begun -= OnBegun;
        session.Renewed -= OnRenewed;
        session.Logged -= OnLogged;
        session.StateCommitted -= OnCommitted;
        Try(() => writer?.WriteEnd(session.EndReason ?? "The recording ended before the session."));
        Close();
    }

    private static Func<int, (Stream Stream, string? File)> Opener(string path)
    {
        if (string.IsNullOrWhiteSpace(path ?? throw new ArgumentNullException(nameof(path))))
        {
            throw new ArgumentException("The path of a recording names a file; it may not be empty.", nameof(path));
        }

        return number =>
        {
            string file = number == 1 ? path : Path.ChangeExtension(path, FormattableString.Invariant($"{number}{Path.GetExtension(path)}"));
            return (RecordingFileStream.Open(file), file);
        };
    }

    private void OnRenewed(string why)
    {
        Try(() => writer?.WriteEnd($"A fresh copy took the place of the world; the recording goes on in another file. {why}"));
        Close();
        OnBegun();
    }

    private void OnBegun() => Try(() =>
    {
        SimTime start = session.World!.Simulation.Start;
        JoinedState? joined = session.LogStart > 0 || session.BegunFrom is not null ? new JoinedState(session.LogStart + 1, session.BegunFrom) : null;
        (Stream stream, string? file) = open(++count);
        files = file is null ? files : [.. files, file];
        try
        {
            writer = new RecordingWriter(stream, session.Peer, session.Scene!, start, joined);
        }
        catch
        {
            stream.Dispose();
            throw;
        }

        waiting.ForEach(entry => writer.WriteEntry(entry.Index, entry.Verdict, entry.Event));
        waiting.Clear();
    });

    private void OnLogged(LogEntry entry)
    {
        if (writer is not null)
        {
            Try(() => writer.WriteEntry(entry.Index, entry.Verdict, entry.Event));
        }
        else if (failure is null && waiting.Count < MaxWaiting)
        {
            waiting.Add(entry);
        }
        else
        {
            Fail($"More than {MaxWaiting} events came before the start.");
        }
    }

    private void OnCommitted(CommittedState state)
    {
        if (state.Time - session.World!.Simulation.Start <= length)
        {
            Try(() => writer?.WriteCommitted(state.Time, state.StateHash, state.EventHash));
        }
    }

    private void Try(Action write)
    {
        if (failure is not null)
        {
            return;
        }

        try
        {
            write();
        }
        catch (Exception cause) when (cause is IOException or UnauthorizedAccessException or ArgumentException or InvalidOperationException
            or NotSupportedException)
        {
            Fail(cause.Message);
        }
    }

    private void Fail(string why)
    {
        if (failure is not null)
        {
            return;
        }

        failure = $"The recording ends here: {why}";
        waiting.Clear();
        Close();
        Failed?.Invoke(failure);
    }

    private void Close()
    {
        RecordingWriter? closed = writer;
        writer = null;
        try
        {
            closed?.Dispose();
        }
        catch (Exception cause) when (cause is IOException or UnauthorizedAccessException)
        {
            Fail(cause.Message); // what was not yet written is lost
        }
    }
}
