using System;
using System.Reflection;
using LagSim.Net.Wire;

namespace LagSim.Net.Recordings;

/// <summary>The constants of the recording file format. The layout is in <c>docs/RECORDINGS.md</c>; all sizes are in bytes.</summary>
public static class RecordingFormat
{
    /// <summary>The file name extension of a recording.</summary>
    public const string Extension = ".lagsim";

    /// <summary>The version of the records. The scene and events in them use that of the wire, <see cref="WireFormat.Version"/>.</summary>
    public const byte Version = 6;

    /// <summary>The longest snapshot of a late client in a recording: 64 MiB.</summary>
    public const int MaxSnapshotBytes = 1 << 26;

    /// <summary>The longest end reason, in UTF-8.</summary>
    public const int MaxReasonBytes = 4000;

    internal const int PrefixBytes = 10; // magic, version, version of the wire
    internal const int HeaderBytes = 19; // peer, start, scene hash, fold version; then a text
    internal const int JoinedHeadBytes = 4; // first index; then the snapshot
    internal const int EntryHeadBytes = 5; // index, verdict; then the event
    internal const int CommittedBytes = 24;
    internal const int CrcBytes = 4;

    /// <summary>The version of this library, as stored in recordings; without the source revision.</summary>
    internal static string LibraryVersion { get; } =
        (typeof(RecordingFormat).Assembly.GetCustomAttribute<AssemblyInformationalVersionAttribute>()?.InformationalVersion ?? "0").Split('+')[0];

    /// <summary>The first eight bytes: <c>LagSim</c> and a line end that a transfer in text mode would change.</summary>
    internal static ReadOnlySpan<byte> Magic => new byte[] { 0x4C, 0x61, 0x67, 0x53, 0x69, 0x6D, 0x0D, 0x0A };

    /// <summary>The longest content of a record.</summary>
    internal static int MaxContentBytes(RecordKind kind) => kind switch
    {
        RecordKind.Header => HeaderBytes + 1 + WireText.MaxBytes,
        RecordKind.Scene => SceneFormat.MaxBytes,
        RecordKind.Joined => JoinedHeadBytes + MaxSnapshotBytes,
        RecordKind.Entry => EntryHeadBytes + EventFormat.MaxBytes,
        RecordKind.Committed => CommittedBytes,
        _ => MaxReasonBytes,
    };

    /// <summary>The name of a record in sentences, with its article.</summary>
    internal static string NameOf(RecordKind kind) => kind switch
    {
        RecordKind.Header => "a header",
        RecordKind.Scene => "a scene",
        RecordKind.Joined => "a joined state",
        RecordKind.Entry => "a log entry",
        RecordKind.Committed => "a committed state",
        _ => "an end",
    };
}
