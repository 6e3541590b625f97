using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>An order of events whose trees are never balanced.</summary>
internal sealed class FaultyEventOrder : EventOrder
{
    private protected override int Split(int tree) => tree;
}
