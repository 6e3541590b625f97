using System;

namespace LagSim.Harness.Verification.Fuzz;

/// <summary>The memory that is held: what is left once all that nobody refers to has been collected.</summary>
internal static class LiveMemory
{
    /// <summary>
    /// Collects, and reads how many bytes are held. Others may go on meanwhile; what they have just let go counts too, some ten kilobytes.
    /// </summary>
    internal static long Read()
    {
        GC.Collect(GC.MaxGeneration, GCCollectionMode.Forced, blocking: true);
        GC.WaitForPendingFinalizers();
        GC.Collect(GC.MaxGeneration, GCCollectionMode.Forced, blocking: true);
        return GC.GetTotalMemory(forceFullCollection: false);
    }
}
