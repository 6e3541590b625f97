namespace LagSim.Tests.Architecture.Samples;

/// <summary>What the others of this folder use, each from within code of another kind.</summary>
internal sealed class Used;
