namespace LagSim.Hosting;

/// <summary>The kind of a <see cref="ContactNotice"/>.</summary>
public enum ContactNoticeKind
{
    /// <summary>None: of <c>default</c> alone.</summary>
    None = 0,

    /// <summary>
    /// By what is known now it happens, a look-ahead from now at most, or has just turned out to have happened. A late event may still take
    /// it back.
    /// </summary>
    Predicted = 1,

    /// <summary>
    /// It happened, and no late event can change that any more. Each contact once, in the order of their keys, the same on every peer.
    /// </summary>
    Confirmed = 2,

    /// <summary>The predicted contact does not happen, or happens differently.</summary>
    Retracted = 3,
}
