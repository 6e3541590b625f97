namespace LagSim.Timelines;

/// <summary>
/// Notified of every crossing that is found and of every one that is cut off again. Called on the thread that advances; it may change
/// nothing.
/// </summary>
internal interface ICrossingObserver
{
    /// <summary>A body crosses a sensor.</summary>
    void OnCrossing(in Crossing crossing);

    /// <summary>A crossing is cut off: it no longer happens, unless it is reported again.</summary>
    void OnCut(in Crossing crossing);
}
