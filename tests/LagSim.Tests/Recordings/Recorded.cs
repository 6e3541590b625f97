using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Recordings;

/// <summary>Recordings, and what tests ask of their bytes.</summary>
internal static class Recorded
{
    /// <summary>Two balls above a floor.</summary>
    internal static readonly Scene Scene = new SceneBuilder("two").WithSmallestRadius(0.25)
        .AddPlane("floor", Vector3D.Up, V(0)).AddBody("left", Ball(e: 0.8), V(-1, 3)).AddBody("right", Ball(e: 0.8), V(1, 2)).Build();

    internal static readonly SimTime Start = At(100.25);

    /// <summary>A log with every kind of event; the third was refused.</summary>
    internal static readonly LogEntry[] Log =
    [
        new(1, Verdict.Accepted, ExternalEvent.Teleport(Start + Seconds(0.5), 1, 1, First, V(-1, 4), V(2))),
        new(2, Verdict.Accepted, ExternalEvent.Spawn(Start + Seconds(0.25), 2, 1, Ball(0.25, 2), V(0, 5))),
        new(3, Verdict.TooLate, ExternalEvent.SetVelocity(Start + Seconds(0.1), 1, 2, First, V(9))),
        new(4, Verdict.Accepted, ExternalEvent.Impulse(Start + Seconds(0.75), 2, 2, Second, V(-3, 1))),
        new(5, Verdict.Accepted, ExternalEvent.SetVelocity(Start + Seconds(1.25), 0, 1, Second, V(0, 5))),
        new(6, Verdict.Accepted, ExternalEvent.Remove(Start + Seconds(1.5), 1, 3, new BodyId(2, 1, 0))),
    ];

    internal static SimDuration Seconds(double seconds) => SimDuration.FromSeconds(seconds);

    internal static byte[] Bytes(Action<RecordingWriter> write, Scene? scene = null, SimTime? start = null, byte peer = 0, JoinedState? joined = null)
    {
        MemoryStream stream = new();
        using (RecordingWriter writer = new(stream, peer, scene ?? Scene, start ?? Start, joined))
        {
            write(writer);
        }

        return stream.ToArray();
    }

    /// <summary>A recording of <see cref="Log"/> with a committed state each half second up to two, hashed from a world that had it all.</summary>
    internal static byte[] Small(
        IReadOnlyList<LogEntry>? log = null, byte peer = 0, IReadOnlyList<LogEntry>? truth = null, JoinedState? joined = null, string? end = "This peer left.")
    {
        log ??= Log;
        Simulation world = World(truth ?? Log);
        return Bytes(
            writer =>
            {
                int next = 0;
                for (int half = 0; half <= 4; half++)
                {
                    SimTime time = Start + Seconds(half / 2.0);
                    while (next < log.Count && log[next].Event.Time <= time + Seconds(0.5))
                    {
                        writer.WriteEntry(log[next].Index, log[next].Verdict, log[next].Event);
                        next++;
                    }

                    if (time >= (joined?.Time ?? Start))
                    {
                        writer.WriteCommitted(time, world.StateHash(time), world.EventHash(time));
                    }
                }

                if (end is not null)
                {
                    writer.WriteEnd(end);
                }
            },
            peer: peer, joined: joined);
    }

    /// <summary>What one began with who joined so long after the start, into a world that had all of <see cref="Log"/>.</summary>
    internal static JoinedState Joined(uint first, double seconds) => new(first, World(Log).Snapshot(Start + Seconds(seconds)));

    /// <summary>The world of one who had all accepted events at once, up to two seconds, and keeps everything.</summary>
    internal static Simulation World(IEnumerable<LogEntry> log, double seconds = 2)
    {
        Simulation simulation = new(Scene, new SimulationOptions(Start, SimDuration.MaxValue));
        foreach (LogEntry entry in log.Where(entry => entry.Verdict == Verdict.Accepted))
        {
            simulation.Submit(entry.Event);
        }

        simulation.AdvanceTo(Start + Seconds(seconds));
        return simulation;
    }

    /// <summary>The log with one entry replaced.</summary>
    internal static LogEntry[] With(uint index, Verdict verdict, in ExternalEvent what)
    {
        LogEntry[] log = [.. Log];
        log[index - 1] = new LogEntry(index, verdict, what);
        return log;
    }

    /// <summary>A world drawn by a seed, whose events came in some order.</summary>
    internal static byte[] Random(int seed, out RandomWorld world)
    {
        RandomWorld drawn = world = new(seed);
        Simulation simulation = drawn.OnTime();
        System.Random order = new(seed);
        List<ExternalEvent> waiting = [.. drawn.Events.OrderBy(_ => order.Next())];
        return Bytes(
            writer =>
            {
                uint index = 1;
                foreach (SimTime time in RandomWorld.Times)
                {
                    foreach (ExternalEvent what in waiting.Where(e => e.Time <= time || order.Next(3) == 0).ToList())
                    {
                        writer.WriteEntry(index++, Verdict.Accepted, what);
                        waiting.Remove(what);
                    }

                    writer.WriteCommitted(time, simulation.StateHash(time), simulation.EventHash(time));
                }
            },
            drawn.Scene, SimTime.Zero);
    }

    internal static Recording Read(byte[] bytes, IReadOnlyList<IAcceleration>? known = null) => Recording.Read(new MemoryStream(bytes, false), known);

    internal static RecordingReplay Replayed(Recording recording) => RecordingReplay.Run(recording, TestContext.Current.CancellationToken);

    internal static RecordingComparison Compared(Recording first, Recording second) =>
        RecordingComparison.Of(first, second, TestContext.Current.CancellationToken);

    /// <summary>Where the records begin, and where the last ends: by the layout of the page, without the library.</summary>
    internal static List<int> Boundaries(byte[] bytes)
    {
        List<int> at = [10];
        while (at[^1] < bytes.Length)
        {
            int i = at[^1] + 1, length = 0, shift = 0;
            do
            {
                length |= (bytes[i] & 0x7F) << shift;
                shift += 7;
            }
            while (bytes[i++] >= 0x80);
            at.Add(i + length + 4);
        }

        return at;
    }

    /// <summary>A record around any content, with the checksum it should have.</summary>
    internal static byte[] Record(byte kind, byte[] content)
    {
        List<byte> record = [kind];
        int rest = content.Length;
        for (; rest >= 0x80; rest >>= 7)
        {
            record.Add((byte)(rest | 0x80));
        }

        record.Add((byte)rest);
        record.AddRange(content);
        record.AddRange(BitConverter.GetBytes(Crc([.. record])));
        return [.. record];
    }

    /// <summary>A fold version that no library has.</summary>
    internal const ushort OtherFold = 999;

    /// <summary>The recording as a library of another fold version would have written it.</summary>
    internal static byte[] OfFold(byte[] bytes, ushort version)
    {
        int end = Boundaries(bytes)[1];
        byte[] header = bytes[12..(end - 4)];
        BitConverter.TryWriteBytes(header.AsSpan(17), version);
        return [.. bytes[..10], .. Record(1, header), .. bytes[end..]];
    }

    /// <summary>CRC-32 bit by bit, as the page says.</summary>
    internal static uint Crc(byte[] bytes)
    {
        uint crc = uint.MaxValue;
        foreach (byte next in bytes)
        {
            crc ^= next;
            for (int bit = 0; bit < 8; bit++)
            {
                crc = (crc >> 1) ^ ((crc & 1) * 0xEDB88320);
            }
        }

        return ~crc;
    }
}
