using System.Threading;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>
/// Hands whole render snapshots from the simulation's thread to one reading thread, without a lock and without waiting: a triple buffer.
/// </summary>
/// <remarks>
/// One buffer is being written, one is being read, and the third is swapped with either. A writer never waits for a reader, and a reader
/// always gets the last whole render snapshot.
/// </remarks>
public sealed class RenderTripleBuffer
{
    private const int Fresh = 4; // set on the shared buffer's number when the reader has not had it

    private readonly RenderSnapshot[] buffers = { new(), new(), new() };
    private int writing;
    private int shared = 1;
    private int reading = 2;
    private long published;

    /// <summary>The newest whole render snapshot; the one before it is given back. For one thread only, the reader's.</summary>
    public RenderSnapshot Latest()
    {
        if ((Volatile.Read(ref shared) & Fresh) != 0)
        {
            reading = Interlocked.Exchange(ref shared, reading) & ~Fresh;
        }

        return buffers[reading];
    }

    /// <summary>Publishes the simulation as it is, back to <paramref name="from"/>. For the simulation's thread.</summary>
    internal void Publish(Simulation simulation, SimTime from)
    {
        buffers[writing].Follow(simulation, from, ++published);
        writing = Interlocked.Exchange(ref shared, writing | Fresh) & ~Fresh;
    }
}
