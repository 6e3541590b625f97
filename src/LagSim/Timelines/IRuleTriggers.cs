using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Timelines;

/// <summary>Notified of what rules may hear of, as the timelines get it and lose it again. It changes nothing there.</summary>
internal interface IRuleTriggers
{
    /// <summary>A contact of an impact, by the impact's canonical key; before any segment is opened.</summary>
    void OnContact(in EventKey impact, in ImpactContact contact);

    /// <summary>A body crosses a sensor.</summary>
    void OnCrossing(in Crossing crossing);

    /// <summary>A body's segment is opened by an event.</summary>
    void OnOpened(BodyId body, in EventKey key);

    /// <summary>The segment that an event had opened for a body, or a crossing of its, is cut off: the event no longer happens, unless it is reported
    /// again.</summary>
    void OnCut(BodyId body, in EventKey key);
}
