using LagSim.Contacts;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Statics by which everything holds that is slow, however deep it is in something.</summary>
internal sealed class FaultyIslandStatics(BodyTable bodies, in Forces forces, ContactGraph graph, ContactStep step)
    : IslandStatics(bodies, forces, graph, step)
{
    internal override bool Holds(SimTime tick, double seconds) => true;
}
