using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>
/// Decides which datagrams to drop at the head of a queue, by RFC 8289: its pseudocode (section 5) and its names, over any kind of queue.
/// </summary>
/// <remarks>Deterministic. Not thread-safe.</remarks>
internal sealed class CoDel
{
    /// <summary>RFC 8289's MAXPACKET, the longest Ethernet frame: while no more than that waits, nothing is dropped.</summary>
    internal const int MaxPacketBytes = 1_514;

    /// <summary>The acceptable wait, RFC 8289's TARGET.</summary>
    internal static readonly SimDuration Target = SimDuration.FromMilliseconds(5);

    /// <summary>How long all datagrams must have waited longer than that, RFC 8289's INTERVAL.</summary>
    internal static readonly SimDuration Interval = SimDuration.FromMilliseconds(100);

    private readonly IWaitingLine line;
    private SimTime? firstAboveTime;
    private SimTime dropNext;
    private uint count;
    private uint lastCount;
    private bool dropping;

    internal CoDel(IWaitingLine line) => this.line = line;

    /// <summary>The queue as CoDel needs it.</summary>
    internal interface IWaitingLine
    {
        /// <summary>The bytes of all waiting datagrams.</summary>
        long WaitingBytes { get; }

        /// <summary>Removes the datagram that has waited longest; false if none waits.</summary>
        bool TryTakeFirst(out Waiting first);

        /// <summary>Drops a removed datagram.</summary>
        void Drop(Waiting lost);
    }

    /// <summary>
    /// Removes the datagram to send now, after dropping those before it as needed; false if none is left. Call it whenever the line is
    /// free.
    /// </summary>
    internal bool TryDequeue(SimTime now, out Waiting first)
    {
        bool any = DoDequeue(now, out first, out bool okToDrop);
        if (dropping)
        {
            dropping = okToDrop;
            while (dropping && now >= dropNext)
            {
                line.Drop(first);
                count++;
                any = DoDequeue(now, out first, out okToDrop);
                dropping = okToDrop;
                dropNext = okToDrop ? ControlLaw(dropNext) : dropNext;
            }
        }
        else if (okToDrop)
        {
            line.Drop(first);
            any = DoDequeue(now, out first, out _);
            dropping = true;

            // Above the target again soon after it was below: start from the drop rate that controlled it then.
            uint delta = count - lastCount;
            count = delta > 1 && now - dropNext < Interval * 16 ? delta : 1;
            dropNext = ControlLaw(now);
            lastCount = count;
        }

        return any;
    }

    private bool DoDequeue(SimTime now, out Waiting first, out bool okToDrop)
    {
        okToDrop = false;
        bool any = line.TryTakeFirst(out first);
        if (!any || now - first.Came < Target || line.WaitingBytes <= MaxPacketBytes)
        {
            firstAboveTime = null;
        }
        else if (firstAboveTime is SimTime above)
        {
            okToDrop = now >= above;
        }
        else
        {
            firstAboveTime = now + Interval;
        }

        return any;
    }

    private SimTime ControlLaw(SimTime from) => from + SimDuration.FromTicks((long)(Interval.Ticks / Math.Sqrt(count)));

    /// <summary>A waiting datagram.</summary>
    /// <param name="Bytes">Its bytes on the wire.</param>
    /// <param name="Came">When it arrived.</param>
    /// <param name="Decided">Called with the time when it leaves; null if it is dropped.</param>
    internal readonly record struct Waiting(int Bytes, SimTime Came, Action<SimTime?> Decided);
}
