using System;
using System.Diagnostics;
using System.Runtime.InteropServices;

namespace LagSim.Harness.Experiments.Metrics;

/// <summary>
/// The CPU time of this thread, so that tails are the program's own and other load on the machine is not counted. Wall-clock time where the
/// system does not provide it (anything but Linux).
/// </summary>
public static class ThreadClock
{
    private const int ThreadCpuTime = 3; // CLOCK_THREAD_CPUTIME_ID

    /// <summary>A description of the clock, for reports.</summary>
    public static string Name => OperatingSystem.IsLinux() ? "CPU time" : "wall clock";

    /// <summary>Microseconds since an arbitrary origin.</summary>
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
