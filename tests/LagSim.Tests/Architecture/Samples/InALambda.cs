using System;

namespace LagSim.Tests.Architecture.Samples;

/// <summary>Uses it in a lambda only.</summary>
internal static class InALambda
{
    internal static Func<object> Make() => () => new Used();
}
