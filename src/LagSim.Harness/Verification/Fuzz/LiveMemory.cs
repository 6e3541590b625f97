using System;

namespace LagSim.Harness.Verification.Fuzz;

/// <summary>The live memory: what is left after a full garbage collection.</summary>
internal static class LiveMemory
{
    /// <summary>
    /// Collects, and returns the bytes in use. With other threads at work, some ten kilobytes of just released memory count too.
    /// </summary>
    internal static long Read()
    {
        GC.Collect(GC.MaxGeneration, GCCollectionMode.Forced, blocking: true);
        GC.WaitForPendingFinalizers();
        GC.Collect(GC.MaxGeneration, GCCollectionMode.Forced, blocking: true);
        return GC.GetTotalMemory(forceFullCollection: false);
    }
}
