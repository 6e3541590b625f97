using LagSim.Timelines;

namespace LagSim.Tests;

internal static class SimulationControls
{
    extension(Simulation simulation)
    {
        internal int FewHealed { get => simulation.Engine.Rewinder.FewHealed; set => simulation.Engine.Rewinder.FewHealed = value; }
        internal IWorkObserver? Work { get => simulation.Engine.Meter.Observer; set => simulation.Engine.Meter.Observer = value; }
    }
}
