namespace LagSim.Tests.Rules;

/// <summary>The state of the world, and of a body, of <see cref="GivenRules"/>.</summary>
internal struct GivenState
{
    internal double Height;
    internal ulong Draw;
    internal int Count;
#pragma warning disable CS0649 // fills up to a multiple of eight
    internal int Spare;
#pragma warning restore CS0649
}
