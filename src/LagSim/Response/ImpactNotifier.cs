using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Response;

/// <summary>Reports the contacts of an impact to the observers.</summary>
internal sealed class ImpactNotifier(BodyTable bodies, TimelineStore timelines, ContactGraph graph)
{
    /// <summary>Reports the contacts of the graph that close, as they are before the impact is solved.</summary>
    internal void Tell(in EventKey key)
    {
        if (timelines.Observer is null && timelines.Triggers is null)
        {
            return;
        }

        EventKey canonical = graph.CanonicalKey(key);
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
                ImpactContact contact = new(first, second, surface, position, closing);
                timelines.Observer?.OnContact(canonical, contact);
                timelines.Triggers?.OnContact(canonical, contact);
            }
        }
    }
}
