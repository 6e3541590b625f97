using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>
/// Which datagrams a queue loses at its head by RFC 8289: its pseudocode (section 5), its names, over whatever queue there is.
/// </summary>
/// <remarks>Deterministic. Not thread-safe.</remarks>
internal sealed class CoDel
{
    /// <summary>RFC 8289's MAXPACKET, the longest Ethernet frame: as long as no more than that waits behind, nothing is lost.</summary>
    internal const int MaxPacketBytes = 1_514;

    /// <summary>The wait that is good enough, RFC 8289's TARGET.</summary>
    internal static readonly SimDuration Target = SimDuration.FromMilliseconds(5);

    /// <summary>For how long all must have waited longer than that, RFC 8289's INTERVAL.</summary>
    internal static readonly SimDuration Interval = SimDuration.FromMilliseconds(100);

    private readonly IWaitingLine line;
    private SimTime? firstAboveTime;
    private SimTime dropNext;
    private uint count;
    private uint lastCount;
    private bool dropping;

    internal CoDel(IWaitingLine line) => this.line = line;

    /// <summary>What CoDel needs of the queue.</summary>
    internal interface IWaitingLine
    {
        /// <summary>The bytes of all that waits.</summary>
        long WaitingBytes { get; }

        /// <summary>Takes out the one that has waited longest; false if none waits.</summary>
        bool TryTakeFirst(out Waiting first);

        /// <summary>Loses one that was taken out.</summary>
        void Drop(Waiting lost);
    }

    /// <summary>
    /// Takes out the one that goes on its way now, after those that are lost; false if none is left. To be asked whenever the line is free.
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

            // Above again soon after it was below: the rate of losses that controlled it then is where to begin.
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

    /// <summary>A datagram that waits.</summary>
    /// <param name="Bytes">Its bytes on the wire.</param>
    /// <param name="Came">When it came.</param>
    /// <param name="Decided">Told when it leaves; null if it is lost.</param>
    internal readonly record struct Waiting(int Bytes, SimTime Came, Action<SimTime?> Decided);
}
