namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Limits on what joining clients may take from a host. Only tests set other ones, to check that a missing limit is noticed.
/// </summary>
internal sealed class JoinLimits
{
    /// <summary>
    /// The most clients that may be joining at a time. They hold no place: one that is not in yet makes room for the next.
    /// </summary>
    internal int Coming { get; set; } = 256;

    /// <summary>The most of those from one machine.</summary>
    internal int ComingOfOne { get; set; } = 16;

    /// <summary>
    /// The most memory, in bytes, for the snapshots being downloaded, unless <see cref="MinSnapshots"/> of them are larger. A host makes
    /// at most one snapshot per second.
    /// </summary>
    internal long SnapshotBytes { get; set; } = 64 << 20;

    /// <summary>
    /// The number of snapshots that always fit, however large, so that a client has at least three timeouts to download its own before it
    /// can be dropped for others.
    /// </summary>
    internal int MinSnapshots { get; set; } = 4;

    /// <summary>
    /// The rate at which a client on the slowest supported link downloads its snapshot, in bytes per second: three fifths of what a link of 12 kbit/s
    /// carries that falls to a fifth for five of every six seconds. A slower download holds no place, only its share of <see cref="SnapshotBytes"/>.
    /// </summary>
    internal double SlowestDownload { get; set; } = 300;

    /// <summary>The rate at which one machine is sent chunks, for all its clients together: 2.3 MB/s.</summary>
    internal double ChunksPerSecond { get; set; } = 2000;

    /// <summary>
    /// The rate at which handshakes are read from one machine, each of which costs up to 0.6 ms (bench/README.md).
    /// </summary>
    internal double HandshakesPerSecond { get; set; } = 1;

    /// <summary>The burst of handshakes after a pause: as many as there are places.</summary>
    internal int HandshakeBurst { get; set; } = SessionOptions.MaxClients;

    /// <summary>
    /// The rate at which handshakes are read from all machines together, and their burst: at most a fifth of a core,
    /// however many former keys the host has, so that thousands of machines do not hold up those who play.
    /// </summary>
    internal double HandshakesPerSecondOfAll { get; set; } = 250;

    /// <summary>After how many wrong connect keys of one machine the next has to wait: who types one in may err.</summary>
    internal int FreeWrongKeys { get; set; } = 5;

    /// <summary>How many wrong keys a second of all machines together are looked at, at length.</summary>
    internal double WrongKeysPerSecondOfAll { get; set; } = 10;

    /// <summary>How many of them at once after a pause.</summary>
    internal int WrongKeyBurstOfAll { get; set; } = 100;

    /// <summary>How many bans for a while are kept, of players and of machines each: some 500 kB.</summary>
    internal int PassingBans { get; set; } = 4096;

    /// <summary>The burst of chunks after a pause: four windows.</summary>
    internal int ChunkBurst { get; set; } = 4 * Wire.SnapshotRequestDatagram.MaxChunks;
}
