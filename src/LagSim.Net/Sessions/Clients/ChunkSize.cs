using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>How long the chunks are that a download asks for: the longest, or those that every path carries (RFC 8899).</summary>
/// <remarks>
/// A request counts as fruitless if none of its chunks arrived in time, though other datagrams of the host did since it was sent. After
/// <see cref="MostFruitless"/> in a row the other length is tried. A link that loses a tenth each way loses one request in five even if
/// it asks for one chunk, and so many in a row once in 4,000 times; that costs some headers, and a long chunk that arrives late undoes it.
/// </remarks>
internal sealed class ChunkSize
{
    /// <summary>How many fruitless requests in a row make the length suspicious.</summary>
    internal const int MostFruitless = 5;

    private SimTime asked; // when the last request was sent
    private bool isFruitless; // nothing of the last request has arrived
    private bool isProven; // a chunk of this length has arrived
    private int fruitless;
    private bool wasChanged;

    /// <summary>The length of a chunk, in bytes.</summary>
    internal int Data => Shorter == 0 ? SnapshotChunkDatagram.MaxData : SnapshotChunkDatagram.LeastData;

    /// <summary>The same as a request says it.</summary>
    internal byte Shorter { get; private set; }

    /// <summary>What there is to say about it, for people; nothing as long as all is well.</summary>
    internal string Sentence => !wasChanged ? ""
        : !isProven ? " The host's other datagrams arrive, but none of the copy does, whether long or short."
        : Shorter > 0 ? $" Datagrams of more than {WireFormat.LeastPathBytes} bytes do not arrive here, so it comes in short ones." : "";

    /// <summary>Records that a chunk of this length arrived.</summary>
    internal void NoteArrived()
    {
        isFruitless = false;
        isProven = true;
        fruitless = 0;
    }

    /// <summary>Judges the last request, before the next is sent.</summary>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="heard">When the host was last heard, likewise.</param>
    /// <returns>Whether the length is another one from now on.</returns>
    internal bool ChangesBefore(SimTime now, SimTime heard)
    {
        fruitless += isFruitless && heard > asked ? 1 : 0;
        isFruitless = true;
        asked = now;
        bool changes = fruitless >= MostFruitless;
        if (changes)
        {
            Change();
        }

        return changes;
    }

    /// <summary>Takes the other length.</summary>
    internal void Change()
    {
        Shorter = Shorter == 0 ? SnapshotRequestDatagram.MaxShorter : (byte)0;
        fruitless = 0;
        isProven = false;
        wasChanged = true;
    }
}
