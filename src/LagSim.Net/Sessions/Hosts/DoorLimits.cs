namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// What those who are coming in can have of a host at most. Nobody sets another one but a test that takes a limit away to see it missed.
/// </summary>
internal sealed class DoorLimits
{
    /// <summary>So many may be coming in at a time. They hold no place: who is not in yet makes room for the next.</summary>
    internal int Coming { get; set; } = 256;

    /// <summary>So many of them from one machine.</summary>
    internal int ComingOfOne { get; set; } = 16;

    /// <summary>
    ///  The most memory, in bytes, that the copies being fetched may take, unless <see cref="CopiesAtLeast"/> of them are larger. A host
    /// makes at most one copy a second.
    /// </summary>
    internal long CopyBytes { get; set; } = 64 << 20;

    /// <summary>
    /// This many copies always fit, however large they are, so a client has at least three time-outs to fetch its copy before it can be
    /// dropped for others.
    /// </summary>
    internal int CopiesAtLeast { get; set; } = 4;

    /// <summary>Who comes in on the slowest link that is counted on gets so many bytes of its copy a second.</summary>
    internal double SlowestCopy { get; set; } = 1_000;

    /// <summary>One machine gets pieces of copies at this rate, 2.3 MB/s, whoever there asks for them.</summary>
    internal double PiecesPerSecond { get; set; } = 2000;

    /// <summary>And after a pause so many at once, four windows of them.</summary>
    internal int PiecesAtOnce { get; set; } = 4 * Wire.SnapshotRequestDatagram.MaxChunks;
}
