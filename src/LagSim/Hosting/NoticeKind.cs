namespace LagSim.Hosting;

/// <summary>The kind of a notice: of a contact, of a crossing, or of what rules told.</summary>
public enum NoticeKind
{
    /// <summary>No notice: <c>default</c>.</summary>
    None = 0,

    /// <summary>
    /// Expected to happen within the look-ahead, or just found to have happened. A late event may still retract it.
    /// </summary>
    Predicted = 1,

    /// <summary>
    /// It happened, and no late event can change that any more. Each once, in the order of their keys, the same on every peer.
    /// </summary>
    Confirmed = 2,

    /// <summary>What was predicted does not happen, or happens differently.</summary>
    Retracted = 3,
}
