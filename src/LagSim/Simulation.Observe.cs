using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>Telling of impacts, to whoever wants to hear of them.</content>
public sealed partial class Simulation
{
    /// <summary>Is told of impacts made and cut; null, the default, costs nothing.</summary>
    internal IImpactObserver? Observer
    {
        get => heldBack.Listener;
        set
        {
            heldBack.Listener = value;
            timelines.Observer = value is null ? null : heldBack;
        }
    }

    /// <summary>Whether a heal is under way: what stands ahead of <see cref="SimulatedTo"/> may still be taken back by it.</summary>
    internal bool IsHealing => rollback.IsActive;

    /// <summary>How far behind the simulated time timelines are kept.</summary>
    internal SimDuration History => history;

    /// <summary>Tells of the contacts of the impact at hand that close, as they are before it is solved.</summary>
    private void TellContacts(in EventKey key)
    {
        if (timelines.Observer is not IImpactObserver observer)
        {
            return;
        }

        EventKey canonical = CanonicalKey(key);
        for (int i = 0; i < graph.ContactCount; i++)
        {
            ref readonly ContactPoint c = ref graph.Contacts[i];
            double closing = -ImpactSolver.Opening(c, graph.Velocities);
            if (c.IsStruck && closing > 0)
            {
                BodyId first = bodies.Id(graph.Slots[c.First]);
                BodyId second = c.Second == ContactPoint.Static ? first : bodies.Id(graph.Slots[c.Second]);
                Vector3D position = graph.Positions[c.First] - (c.Normal * bodies.Spec(graph.Slots[c.First]).Radius);
                int surface = c.Second == ContactPoint.Static ? c.Surface : ImpactContact.NoSurface;
                observer.OnContact(canonical, new ImpactContact(first, second, surface, position, closing));
            }
        }
    }
}
