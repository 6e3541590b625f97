using System;

namespace LagSim.Testing.Links;

/// <summary>The narrowest point of a link direction: a rate in bits per second, and a queue of limited size before it.</summary>
/// <remarks>
/// <para>It is modelled on the Linux kernel's token bucket filter, <c>tc qdisc add dev D root tbf rate R burst 1540 latency T</c>, against
/// which it was measured: tokens come in at the rate, up to the burst; a datagram leaves, and takes its tokens, as soon as there are enough
/// for all of it, so at once after a silence.</para>
/// <para>Immutable, safe on any thread.</para>
/// </remarks>
public sealed class Bottleneck
{
    /// <summary>
    /// The bytes that each datagram takes besides its own, 42: 20 for IPv4, 8 for UDP, 14 for Ethernet, as the kernel counts them at a
    /// virtual Ethernet device. <see cref="PortTraffic.HeaderBytes"/>, which measures a sender rather than a wire, leaves Ethernet out.
    /// </summary>
    public const int OverheadBytes = PortTraffic.HeaderBytes + 14;

    /// <summary>The default burst in bytes: one full Ethernet frame and a little, the least that lets every datagram through.</summary>
    public const int DefaultBurstBytes = 1_540;

    /// <summary>The largest burst, in bytes.</summary>
    public const int MaxBurstBytes = 1 << 16;

    /// <summary>The lowest rate, in bit/s.</summary>
    public const long MinBitsPerSecond = 1_000;

    /// <summary>The highest rate, in bit/s.</summary>
    public const long MaxBitsPerSecond = 10_000_000_000;

    private readonly int burst = DefaultBurstBytes;

    /// <summary>Creates a bottleneck with that rate and queue.</summary>
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
    /// The rate in bit/s; <see cref="MinBitsPerSecond"/> to <see cref="MaxBitsPerSecond"/>. <see cref="OverheadBytes"/> count.
    /// </summary>
    public long RateBitsPerSecond { get; }

    /// <summary>
    /// The length of the queue, in milliseconds at that rate, besides one burst; 0 to <see cref="LinkLeg.MaxMilliseconds"/>.
    /// </summary>
    public double QueueMilliseconds { get; }

    /// <summary>How the queue drops datagrams; default drop-tail.</summary>
    public QueueDiscipline Discipline { get; }

    /// <summary>
    /// How much may leave at once after a silence, in bytes; a longer datagram never gets through. <see cref="DefaultBurstBytes"/>, the
    /// default, to <see cref="MaxBurstBytes"/>; or 0 for a line on which each datagram takes the time of its bits, whatever was before it.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">It is out of range.</exception>
    public int BurstBytes
    {
        get => burst;
        init => burst = value is 0 or >= DefaultBurstBytes and <= MaxBurstBytes
            ? value
            : throw new ArgumentOutOfRangeException(nameof(value), value, $"A burst is 0, or {DefaultBurstBytes} to {MaxBurstBytes} bytes.");
    }

    /// <summary>Periods with another rate; null, the default, for none. The queue's size in bytes stays.</summary>
    public PeriodicDip? Dip { get; init; }

    /// <summary>The queue's size in bytes, including the datagram that leaves next: the rate times the time, and one burst.</summary>
    public long LimitBytes => (long)(RateBitsPerSecond / 8.0 * QueueMilliseconds / 1000) + BurstBytes;

    internal static long Rate(long bitsPerSecond, string parameter) =>
        bitsPerSecond is >= MinBitsPerSecond and <= MaxBitsPerSecond
            ? bitsPerSecond
            : throw new ArgumentOutOfRangeException(parameter, bitsPerSecond, $"A rate is {MinBitsPerSecond} to {MaxBitsPerSecond} bit/s.");
}
