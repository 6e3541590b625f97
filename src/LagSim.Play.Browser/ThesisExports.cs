using System.Runtime.InteropServices.JavaScript;
using System.Runtime.Versioning;

namespace LagSim.Play.Browser;

/// <summary>What the worker of the page calls, in a runtime of its own: the thesis's tests, which take seconds.</summary>
/// <remarks>A call returns when all is done; to stop it, the page ends the worker.</remarks>
[SupportedOSPlatform("browser")]
internal static partial class ThesisExports
{
    /// <summary>Runs the drop test with a seed, a whole number up to 2^53.</summary>
    [JSExport]
    internal static void RunDrop(double seed) => ThesisTests.RunDrop((ulong)seed, Report, Progress);

    /// <summary>Runs the test of a hand with a seed, a whole number up to 2^53.</summary>
    [JSExport]
    internal static void RunHold(double seed) => ThesisTests.RunHold((ulong)seed, Report, Progress);

    [JSImport("report", "worker")]
    private static partial void Report(string run);

    [JSImport("progress", "worker")]
    private static partial void Progress(double done);
}
