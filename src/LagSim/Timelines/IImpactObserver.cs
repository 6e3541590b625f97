using LagSim.Events;

namespace LagSim.Timelines;

/// <summary>
/// Notified of every impact that is added to the timelines and of every one that is cut off again. Called on the thread that advances; it
/// may change nothing.
/// </summary>
internal interface IImpactObserver
{
    /// <summary>
    /// A contact of an impact, in the impact's canonical order of contacts; called for each that closes, before any segment is opened.
    /// </summary>
    void OnContact(in EventKey impact, in ImpactContact contact);

    /// <summary>
    /// A segment that the impact had opened is cut off: the impact no longer happens, unless it is reported again. Called once for each
    /// body.
    /// </summary>
    void OnCut(in EventKey impact);
}
