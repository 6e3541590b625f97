using LagSim.Time;

namespace LagSim.Net.Recordings;

/// <summary>Identifies a recording: the peer that made it, and its session.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class RecordingHeader
{
    internal RecordingHeader(byte peer, SimTime start, ulong sceneHash, int foldVersion, string libraryVersion)
    {
        Peer = peer;
        Start = start;
        SceneHash = sceneHash;
        FoldVersion = foldVersion;
        LibraryVersion = libraryVersion;
    }

    /// <summary>The number of the peer that recorded; 0 is the host.</summary>
    public byte Peer { get; }

    /// <summary>The shared time at which the session started.</summary>
    public SimTime Start { get; }

    /// <summary>The hash of the session's scene.</summary>
    public ulong SceneHash { get; }

    /// <summary>
    /// The <see cref="Simulation.FoldVersion"/> of the library that recorded, 1 to 65,535. A library with another one produces different
    /// states from the same scene and events.
    /// </summary>
    public int FoldVersion { get; }

    /// <summary>The version of the library that recorded.</summary>
    public string LibraryVersion { get; }
}
