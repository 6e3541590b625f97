using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Sessions in real time: alone on the machine, so that no other test takes their time.</summary>
[CollectionDefinition(Name, DisableParallelization = true)]
public sealed class RealTime
{
    internal const string Name = "sessions in real time";
}
