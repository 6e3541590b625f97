using LagSim.Timelines;

namespace LagSim.Tests;

internal static class SimulationControls
{
    extension(Simulation simulation)
    {
        internal HealingFault Fault { get => simulation.Engine.Faults.Healing; set => simulation.Engine.Faults.Healing = value; }
        internal bool SwapsOperands { get => simulation.Engine.Faults.SwapsOperands; set => simulation.Engine.Faults.SwapsOperands = value; }
        internal bool IgnoresTies { get => simulation.Engine.Faults.IgnoresTies; set => simulation.Engine.Faults.IgnoresTies = value; }
        internal bool TakesNoShortcut { get => simulation.Engine.Faults.TakesNoShortcut; set => simulation.Engine.Faults.TakesNoShortcut = value; }
        internal bool IgnoresIslands { get => simulation.Engine.Faults.IgnoresIslands; set => simulation.Engine.Faults.IgnoresIslands = value; }
        internal bool NeverCollapses { get => simulation.Engine.Faults.NeverCollapses; set => simulation.Engine.Faults.NeverCollapses = value; }
        internal bool CutsByTime { get => simulation.Engine.Faults.CutsByTime; set => simulation.Engine.Faults.CutsByTime = value; }
        internal bool GainsEnergy { get => simulation.Engine.Step.MayGainEnergy; set => simulation.Engine.Step.MayGainEnergy = value; }
        internal bool PressesOn { get => simulation.Engine.Step.HandsHaveNoLimit; set => simulation.Engine.Step.HandsHaveNoLimit = value; }
        internal bool SweepsAlone { get => simulation.Engine.Step.SweepsAlone; set => simulation.Engine.Step.SweepsAlone = value; }
        internal int FewHealed { get => simulation.Engine.Rewinder.FewHealed; set => simulation.Engine.Rewinder.FewHealed = value; }
        internal IWorkObserver? Work { get => simulation.Engine.Meter.Observer; set => simulation.Engine.Meter.Observer = value; }
    }
}
