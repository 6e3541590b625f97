using System.Threading.Tasks;

namespace LagSim.Tests.Architecture.Samples;

/// <summary>Uses it in an async method only.</summary>
internal static class InAnAsyncMethod
{
    internal static async Task<string> Text()
    {
        await Task.Yield();
        return new Used().ToString()!;
    }
}
