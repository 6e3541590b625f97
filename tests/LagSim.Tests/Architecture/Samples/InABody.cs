namespace LagSim.Tests.Architecture.Samples;

/// <summary>Uses it in the body of a method only.</summary>
internal static class InABody
{
    internal static string Text() => new Used().ToString()!;
}
