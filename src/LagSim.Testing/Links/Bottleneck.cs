using System;

namespace LagSim.Testing.Links;

/// <summary>Where a direction of a link is narrowest: so many bits a second get through, and so many bytes can wait for it.</summary>
/// <remarks>
/// <para>Made like the Linux kernel's token bucket filter, <c>tc qdisc add dev D root tbf rate R burst 1540 latency T</c>, against which it
/// was measured: tokens come in at the rate, up to the burst; a datagram leaves as soon as there are tokens for all of it, so after a
/// silence at once, and takes them.</para>
/// <para>Immutable, safe on any thread.</para>
/// </remarks>
public sealed class Bottleneck
{
    /// <summary>
    ///  What each datagram takes besides its own bytes, 42: 20 for IPv4, 8 for UDP, 14 for Ethernet. So the kernel counts them at a virtual
    /// Ethernet device; <see cref="PortTraffic.HeaderBytes"/>, which measures a sender and not a wire, leaves Ethernet out.
    /// </summary>
    public const int OverheadBytes = PortTraffic.HeaderBytes + 14;

    /// <summary>
    /// The burst that there is if none is said, in bytes: one full Ethernet frame and a little, the least that lets every datagram through.
    /// </summary>
    public const int DefaultBurstBytes = 1_540;

    /// <summary>The most that a burst can be, in bytes.</summary>
    public const int MaxBurstBytes = 1 << 16;

    /// <summary>The lowest rate, in bit/s.</summary>
    public const long MinBitsPerSecond = 1_000;

    /// <summary>The highest rate, in bit/s.</summary>
    public const long MaxBitsPerSecond = 10_000_000_000;

    private readonly int burst = DefaultBurstBytes;

    /// <summary>A bottleneck of that rate and queue.</summary>
    /// <param name="rateBitsPerSecond">See <see cref="RateBitsPerSecond"/>.</param>
    /// <param name="queueMilliseconds">See <see cref="QueueMilliseconds"/>.</param>
    /// <param name="discipline">See <see cref="Discipline"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is not finite or out of its range.</exception>
    public Bottleneck(long rateBitsPerSecond, double queueMilliseconds, QueueDiscipline discipline = QueueDiscipline.DropTail)
    {
        RateBitsPerSecond = Rate(rateBitsPerSecond, nameof(rateBitsPerSecond));
        QueueMilliseconds = queueMilliseconds is >= 0 and <= LinkLeg.MaxMilliseconds
            ? queueMilliseconds
            : throw new ArgumentOutOfRangeException(
                nameof(queueMilliseconds), queueMilliseconds, $"A queue holds 0 to {LinkLeg.MaxMilliseconds} ms of its rate.");
        Discipline = discipline is QueueDiscipline.DropTail or QueueDiscipline.CoDel
            ? discipline
            : throw new ArgumentOutOfRangeException(nameof(discipline), discipline, "A queue is DropTail or CoDel.");
    }

    /// <summary>
    /// How much gets through, in bit/s; <see cref="MinBitsPerSecond"/> to <see cref="MaxBitsPerSecond"/>. <see cref="OverheadBytes"/>
    /// count.
    /// </summary>
    public long RateBitsPerSecond { get; }

    /// <summary>
    /// How long the queue is, in milliseconds at that rate, besides one burst; 0 to <see cref="LinkLeg.MaxMilliseconds"/>.
    /// </summary>
    public double QueueMilliseconds { get; }

    /// <summary>What the queue does when it fills; default drop-tail.</summary>
    public QueueDiscipline Discipline { get; }

    /// <summary>
    ///  How much may leave at once after a silence, in bytes; what is longer never gets through. <see cref="DefaultBurstBytes"/>, the
    /// default, to <see cref="MaxBurstBytes"/>; or 0, a line on which each datagram takes its bits' time, whatever was before it.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">It is out of range.</exception>
    public int BurstBytes
    {
        get => burst;
        init => burst = value is 0 or >= DefaultBurstBytes and <= MaxBurstBytes
            ? value
            : throw new ArgumentOutOfRangeException(nameof(value), value, $"A burst is 0, or {DefaultBurstBytes} to {MaxBurstBytes} bytes.");
    }

    /// <summary>When the rate is another; null, the default: never. The queue's room in bytes stays.</summary>
    public PeriodicDip? Dip { get; init; }

    /// <summary>The queue's room in bytes, that datagram included which is next to leave: the rate times the time, and one burst.</summary>
    public long LimitBytes => (long)(RateBitsPerSecond / 8.0 * QueueMilliseconds / 1000) + BurstBytes;

    internal static long Rate(long bitsPerSecond, string parameter) =>
        bitsPerSecond is >= MinBitsPerSecond and <= MaxBitsPerSecond
            ? bitsPerSecond
            : throw new ArgumentOutOfRangeException(parameter, bitsPerSecond, $"A rate is {MinBitsPerSecond} to {MaxBitsPerSecond} bit/s.");
}
