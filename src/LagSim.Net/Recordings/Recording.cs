using System;
using System.Collections.Generic;
using System.IO;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Recordings;

/// <summary>A recording of a session by one peer: the scene, the host's log, and the hashes of the peer's committed states.</summary>
/// <remarks>
/// <para>A truncated or damaged file is read up to the damage: everything before it is here, and <see cref="Damage"/> says where it ends
/// and why. A file without damage and without <see cref="EndReason"/> is from a process that was killed or still writes, or was truncated
/// where a record ends. None of these <see cref="IsWhole"/>, and what was read from any of them is valid.</para>
/// <para>Immutable, safe on any thread.</para>
/// </remarks>
public sealed class Recording
{
    internal Recording(
        RecordingHeader? header,
        Scene? scene,
        string? sceneError,
        JoinedState? joined,
        LogEntry[] entries,
        CommittedState[] committed,
        string? endReason,
        RecordingDamage? damage)
    {
        Header = header;
        Scene = scene;
        SceneError = sceneError;
        Joined = joined;
        EntryArray = entries;
        CommittedArray = committed;
        Entries = Array.AsReadOnly(entries);
        Committed = Array.AsReadOnly(committed);
        EndReason = endReason;
        Damage = damage;
    }

    /// <summary>The peer that recorded, its session, and the start; null if the file is damaged before the header's end.</summary>
    public RecordingHeader? Header { get; }

    /// <summary>The scene; null if it could not be read: see <see cref="SceneError"/>.</summary>
    public Scene? Scene { get; }

    /// <summary>
    /// Why there is no <see cref="Scene"/>, as a sentence; null if there is one. A missing acceleration is not damage: the rest of the file
    /// is read, and can be compared.
    /// </summary>
    public string? SceneError { get; }

    /// <summary>The initial state of a peer that joined late; otherwise null, and the log begins with entry 1.</summary>
    internal JoinedState? Joined { get; }

    /// <summary>The host's log in order, without gaps.</summary>
    public IReadOnlyList<LogEntry> Entries { get; }

    /// <summary>The committed states, by ascending time.</summary>
    public IReadOnlyList<CommittedState> Committed { get; }

    /// <summary>Why the recording ends, as a sentence; null if it does not say.</summary>
    public string? EndReason { get; }

    /// <summary>Where the file can no longer be read; null if all of it was.</summary>
    public RecordingDamage? Damage { get; }

    /// <summary>Whether nothing is missing: the file has its end record, and no damage.</summary>
    public bool IsWhole => EndReason is not null && Damage is null;

    /// <summary>
    /// The time of the last committed state, up to which the recording can be replayed and compared; null if it has none.
    /// </summary>
    public SimTime? HoldsUpTo => CommittedArray.Length > 0 ? CommittedArray[^1].Time : null;

    /// <summary>
    /// How far it goes and what it lacks, as the rest of a sentence whose subject is the recording: <c>holds 3 log entries, and ...</c>
    /// </summary>
    public string Extent
    {
        get
        {
            string held = Header is null ? "nothing"
                : HoldsUpTo is SimTime time ? $"{Words.Count(EntryArray.Length, "log entry")}, and {Words.Count(CommittedArray.Length, "committed state")} up to {Words.SinceStart(time, Header.Start)}"
                : $"{Words.Count(EntryArray.Length, "log entry")} and no committed state";
            return Damage is not null ? FormattableString.Invariant($"is damaged at byte {Damage.Offset}, and holds {held} before that: {Damage.Reason}")
                : IsWhole ? $"holds {held}."
                : $"has no end record: its writer was ended or still writes, or the file is cut; it holds {held}.";
        }
    }

    internal LogEntry[] EntryArray { get; }

    internal CommittedState[] CommittedArray { get; }

    /// <summary>Reads a recording to its end or to its first damage. No content of a file makes it throw.</summary>
    /// <param name="stream">A readable stream, read from its current position to its end. It stays open.</param>
    /// <param name="known">The accelerations available to the scene; null for none.</param>
    /// <param name="rules">The rules available to the scene; null for none.</param>
    /// <remarks>
    /// Memory: a few times the bytes that are there, whatever they announce. For the cost of the scene see <see cref="Wire.SceneFormat"/>.
    /// </remarks>
    /// <exception cref="ArgumentNullException">The stream is null.</exception>
    /// <exception cref="IOException">The stream itself cannot be read.</exception>
    public static Recording Read(
        Stream stream, IReadOnlyList<IAcceleration>? known = null, IReadOnlyList<SceneRules>? rules = null) =>
        new RecordingReader(stream ?? throw new ArgumentNullException(nameof(stream)), new SceneCode(known, rules)).Read();

    /// <summary>
    /// Reads a file, as <see cref="Read(Stream, IReadOnlyList{IAcceleration}, IReadOnlyList{SceneRules})"/> does; also one that is still being written.
    /// </summary>
    /// <param name="path">The file.</param>
    /// <param name="known">The accelerations available to the scene; null for none.</param>
    /// <param name="rules">The rules available to the scene; null for none.</param>
    /// <exception cref="IOException">The file cannot be opened or read.</exception>
    /// <exception cref="UnauthorizedAccessException">The file may not be read.</exception>
    public static Recording Read(
        string path, IReadOnlyList<IAcceleration>? known = null, IReadOnlyList<SceneRules>? rules = null)
    {
        using FileStream file = new(path, FileMode.Open, FileAccess.Read, FileShare.ReadWrite);
        return Read(file, known, rules);
    }
}
