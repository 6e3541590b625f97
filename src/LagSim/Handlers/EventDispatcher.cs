using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Response;
using LagSim.Rollback;
using LagSim.Timelines;

namespace LagSim.Handlers;

/// <summary>
/// Has an event handled by its kind's handler, which opens segments, and then has predicted what the bodies of those segments meet next.
/// </summary>
internal sealed class EventDispatcher(
    Progress progress, ContactGraph graph, EventPredictor predictor, ImpactHandler impacts, StepEndHandler steps, ExternalHandler externals,
    CrossingHandler? crossings, LossHandler losses, StepMarks marks, RewindRequests rewinds, Rewinder rewinder)
{
    /// <summary>
    /// Processes the least event that is due. If a body that takes part is ahead of it, that body is rewound instead, and the event is due
    /// again.
    /// </summary>
    internal void Process(int slot, in EventKey key)
    {
        if (key.Kind == EventKind.None || (key.Kind is EventKind.Impact or EventKind.Crossing && predictor.IsStale(slot, key)))
        {
            predictor.Recheck(slot);
            return;
        }

        bool isDone = key.Kind switch
        {
            EventKind.Impact => impacts.TryHandle(slot, key),
            EventKind.StepEnd => steps.TryHandle(slot, key),
            EventKind.Crossing => crossings!.TryHandle(key),
            EventKind.Lost => losses.TryHandle(slot, key),
            _ => externals.TryHandle(slot, key),
        };
        while (!isDone && rewinds.TryTake(out int ahead, out EventKey to))
        {
            rewinder.Rewind(ahead, to);
        }

        if (isDone)
        {
            rewinder.RewindCarried();
            for (int i = 0; i < graph.BodyCount; i++)
            {
                predictor.Predict(graph.Slots[i]);
            }

            marks.Clear();
            progress.EventsProcessed++;
            progress.ImpactsProcessed += key.Kind == EventKind.Impact ? 1 : 0;
        }
    }
}
