using LagSim.Events;
using LagSim.Time;

namespace LagSim;

/// <summary>
/// A simulation's twin, in which every late event rolls everything back: after each heal the two are held against each other.
/// </summary>
internal sealed class SyncTest
{
    private readonly Engine healed;
    private readonly Simulation twin;
    private bool isDue;

    /// <summary>Begins with two worlds that are the same.</summary>
    /// <param name="healed">The world that heals.</param>
    /// <param name="twin">The one that rolls everything back.</param>
    internal SyncTest(Engine healed, Simulation twin)
    {
        this.healed = healed;
        this.twin = twin;
        healed.Rewinder.Healed += _ => isDue = true;
    }

    /// <summary>Submits to the twin an event that the healing world gets.</summary>
    internal void Submit(in ExternalEvent external) => twin.Submit(external);

    /// <inheritdoc cref="Submit"/>
    internal void SubmitForwarded(in ExternalEvent external, SimTime arrival) => twin.SubmitForwarded(external, arrival);

    /// <summary>Retracts from the twin an event that the healing world retracts.</summary>
    internal void Retract(in ExternalEvent external) => twin.Retract(external);

    /// <summary>Has the twin drop the same history as the healing world.</summary>
    internal void DropHistoryBefore(SimTime time) => twin.DropHistoryBefore(time);

    /// <summary>Brings the twin to where the world is and, if something was healed, compares the two.</summary>
    /// <exception cref="SimulationException">They differ.</exception>
    internal void Follow()
    {
        SimTime simulatedTo = healed.Progress.SimulatedTo;
        if (twin.SimulatedTo < simulatedTo)
        {
            twin.AdvanceTo(simulatedTo);
        }

        if (healed.Rollback.IsActive || twin.SimulatedTo != simulatedTo)
        {
            return;
        }

        // Rules that look at something else than the world differ in the first call, without any heal.
        string? difference = RuleComparison.FirstDifference(twin.Engine, healed)
            ?? (isDue ? TimelineComparison.FirstDifference(twin.Engine, healed) : null);
        isDue = false;
        if (difference is not null)
        {
            throw healed.Loop.Fail(new SimulationException(
                $"The sync test failed: the world as healed and the world as fully rolled back differ. {difference}"));
        }
    }
}
