using System;
using System.Diagnostics;
using System.Runtime.InteropServices;

namespace LagSim.Harness.Experiments.Metrics;

/// <summary>
/// The time that this thread has had a core: what others take on a shared machine is not counted, so a tail is the program's own. Where the
/// system does not tell (anything but Linux) wall clock.
/// </summary>
public static class ThreadClock
{
    private const int ThreadCpuTime = 3; // CLOCK_THREAD_CPUTIME_ID

    /// <summary>What the figures are.</summary>
    public static string Name => OperatingSystem.IsLinux() ? "CPU time" : "wall clock";

    /// <summary>Microseconds from some beginning.</summary>
    public static double Microseconds
    {
        get
        {
            if (!OperatingSystem.IsLinux())
            {
                return Stopwatch.GetTimestamp() * (1e6 / Stopwatch.Frequency);
            }

            return GetTime(ThreadCpuTime, out TimeSpec now) == 0
                ? (now.Seconds * 1e6) + (now.Nanoseconds * 1e-3)
                : throw new InvalidOperationException("The system does not tell the CPU time of a thread.");
        }
    }

    [DllImport("libc", EntryPoint = "clock_gettime")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern int GetTime(int clock, out TimeSpec time);

    [StructLayout(LayoutKind.Sequential)]
    private struct TimeSpec
    {
        internal nint Seconds;
        internal nint Nanoseconds;
    }
}
