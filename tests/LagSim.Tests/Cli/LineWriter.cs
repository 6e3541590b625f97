using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Text;
using System.Threading;

namespace LagSim.Tests.Cli;

/// <summary>Text that one thread writes and another waits for, line by line.</summary>
internal sealed class LineWriter : TextWriter
{
    private readonly object gate = new();
    private readonly StringBuilder text = new();

    public override Encoding Encoding => Encoding.UTF8;

    internal string[] Lines
    {
        get
        {
            lock (gate)
            {
                return text.ToString().Split('\n').SkipLast(1).Select(line => line.TrimEnd('\r')).ToArray();
            }
        }
    }

    public override void Write(char value) => Write(value.ToString());

    public override void Write(string? value)
    {
        lock (gate)
        {
            text.Append(value);
            Monitor.PulseAll(gate);
        }
    }

    public override void Write(char[] buffer, int index, int count) => Write(new string(buffer, index, count));

    public override void WriteLine(string? value) => Write(value + "\n");

    public override string ToString()
    {
        lock (gate)
        {
            return text.ToString();
        }
    }

    /// <summary>The first whole line that is as asked, waited for; null if none comes in time.</summary>
    internal string? WaitFor(Func<string, bool> isIt, TimeSpan timeout)
    {
        long began = Stopwatch.GetTimestamp();
        lock (gate)
        {
            while (true)
            {
                string? found = Lines.FirstOrDefault(isIt);
                TimeSpan left = timeout - Stopwatch.GetElapsedTime(began);
                if (found is not null || left <= TimeSpan.Zero)
                {
                    return found;
                }

                Monitor.Wait(gate, left);
            }
        }
    }

    /// <summary>What stands after "T n s ", by n.</summary>
    internal static Dictionary<string, string> States(IEnumerable<string> lines) => lines.Where(line => line.StartsWith("T ", StringComparison.Ordinal))
        .Select(line => line.Split(' ', 4)).ToDictionary(words => words[1], words => words[3]);
}
