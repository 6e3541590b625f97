using System.Collections.Generic;

namespace LagSim.Tests.Architecture.Samples;

/// <summary>Uses it in an iterator only.</summary>
internal static class InAnIterator
{
    internal static IEnumerable<string> All()
    {
        yield return new Used().ToString()!;
    }
}
