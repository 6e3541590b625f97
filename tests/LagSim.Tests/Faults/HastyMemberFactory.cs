using LagSim.Contacts;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim.Tests.Faults;

/// <summary>Has a change within a step wait for the step's end, however fast it is.</summary>
internal sealed class HastyMemberFactory(
    BodyTable bodies, TimelineStore timelines, in Forces forces, ContactScale scale, TrajectoryFactory trajectories)
    : MemberFactory(bodies, timelines, forces, scale, trajectories)
{
    private protected override bool IsFollowed(double wanted, double step) => true;
}
