using LagSim.Contacts;
using LagSim.Timelines;

namespace LagSim.Response;

/// <summary>Counts the impacts by which instants without end are closed, and the energy that is lost in them.</summary>
internal sealed class ClosedInstants(Progress progress, ContactGraph graph)
{
    private double before;

    /// <summary>Whether the current impact is such a one.</summary>
    internal bool IsOpen { get; set; }

    /// <summary>The graph has the velocities with which its bodies come.</summary>
    internal void Before() => before = IsOpen ? KineticEnergy() : 0;

    /// <summary>The graph has those with which they leave.</summary>
    internal void After()
    {
        if (IsOpen)
        {
            progress.ImpactsClosed++;
            progress.EnergyLostInClosing += graph.HasHand() ? 0 : before - KineticEnergy(); // a hand gives and takes
        }
    }

    private double KineticEnergy()
    {
        double sum = 0;
        for (int i = 0; i < graph.BodyCount; i++)
        {
            double arm = ContactProblem.SphereInertia * graph.Radii[i] * graph.Radii[i];
            double square = graph.Velocities[i].LengthSquared + (arm * graph.Spins[i].LengthSquared);
            sum += double.IsPositiveInfinity(graph.Masses[i]) ? 0 : 0.5 * graph.Masses[i] * square;
        }

        return sum;
    }
}
