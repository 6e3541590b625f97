using System;
using System.Runtime.InteropServices.JavaScript;
using System.Runtime.Versioning;

namespace LagSim.Play.Browser;

/// <summary>What the page keeps in the memory of the runtime: for those who measure it, since a browser sees only how large that is.</summary>
[SupportedOSPlatform("browser")]
internal static partial class MemoryExports
{
    /// <summary>Collects all that nothing refers to, and returns how many bytes are left. Takes some tens of milliseconds.</summary>
    [JSExport]
    internal static double KeptBytes() => GC.GetTotalMemory(forceFullCollection: true);
}
