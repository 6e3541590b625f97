using LagSim.Time;

namespace LagSim.Tests.Clocks;

/// <summary>A clock that shows what it is told.</summary>
internal sealed class ManualClock : IClock
{
    public SimTime Now { get; set; }
}
