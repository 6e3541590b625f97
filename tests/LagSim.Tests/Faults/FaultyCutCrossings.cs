using LagSim.Rollback;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Does not put back the crossings that were cut.</summary>
internal sealed class FaultyCutCrossings(CrossingLog log, FaultyEngineParts faults) : CutCrossings(log)
{
    internal override void PutBack(SimTime time)
    {
        if (!faults.Has(HealingFault.PutsNoCrossingsBack))
        {
            base.PutBack(time);
        }
    }
}
