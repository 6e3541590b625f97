namespace LagSim.Hosting;

/// <summary>The kind of a <see cref="CrossingNotice"/>.</summary>
public enum CrossingNoticeKind
{
    /// <summary>No notice: <c>default</c>.</summary>
    None = 0,

    /// <summary>
    /// Expected to happen within the look-ahead, or just found to have happened. A late event may still retract it.
    /// </summary>
    Predicted = 1,

    /// <summary>
    /// It happened, and no late event can change that any more. Each crossing once, in the order of their keys, the same on every peer.
    /// </summary>
    Confirmed = 2,

    /// <summary>The predicted crossing does not happen, or happens at another time.</summary>
    Retracted = 3,
}
