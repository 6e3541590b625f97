using LagSim.Events;

namespace LagSim.Timelines;

/// <summary>
/// Is told of every impact that is put into the timelines and of every one that is cut off again. On the thread that advances; it may
/// change nothing.
/// </summary>
internal interface IImpactObserver
{
    /// <summary>
    /// A contact of an impact, in the impact's canonical order of contacts; called for each that closes, before any segment is opened.
    /// </summary>
    void OnContact(in EventKey impact, in ImpactContact contact);

    /// <summary>
    /// A segment that the impact had opened is cut off: the impact no longer happens, unless it is told anew. Called once a party.
    /// </summary>
    void OnCut(in EventKey impact);
}
