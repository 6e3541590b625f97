namespace LagSim.Hosting;

/// <summary>What a <see cref="ContactNotice"/> says of its contact.</summary>
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

    /// <summary>What was predicted does not happen, or not so.</summary>
    Retracted = 3,
}
