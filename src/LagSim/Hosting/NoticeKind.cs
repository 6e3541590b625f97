namespace LagSim.Hosting;

/// <summary>The kind of a notice: of a contact, of a crossing, of a lost body, or of what rules told.</summary>
/// <remarks>
/// Of each thing that is told the first notice is <see cref="Predicted"/> and the last <see cref="Confirmed"/>, <see cref="Retracted"/> or, after a
/// rejoin, <see cref="Unresolved"/>, each once. Between them are any number of <see cref="Moved"/> and <see cref="InDoubt"/>. All of them carry the same <c>Id</c>.
/// </remarks>
public enum NoticeKind
{
    /// <summary>No notice: <c>default</c>.</summary>
    None = 0,

    /// <summary>Expected to happen within the look-ahead, or just found to have happened. A late event may still change it.</summary>
    Predicted = 1,

    /// <summary>
    /// It happened, and no late event can change that any more. Each once, in the order of their keys, the same on every peer.
    /// </summary>
    Confirmed = 2,

    /// <summary>
    /// What was predicted does not happen, and no late event can bring it back: nothing that it could have moved to is left within half a
    /// second of it.
    /// </summary>
    Retracted = 3,

    /// <summary>
    /// It happens at another instant than was told, or otherwise, such as faster: a late event came before it. The notice has what is true
    /// now, and the instant that was told before.
    /// </summary>
    Moved = 4,

    /// <summary>
    /// A late event took it out of what is to happen. Show it no more, but do not give it up: it is <see cref="Moved"/> if it comes again,
    /// and <see cref="Retracted"/> once it cannot.
    /// </summary>
    InDoubt = 5,

    /// <summary>
    /// Whether it happened is not known here: a fresh copy of the world took the place of the one that predicted it, as when a client joins
    /// again, and the copy is of a later instant, or of one so little before that it may have moved to there. Where it does happen after that
    /// instant, it may come as a new one, with an identity of its own. The state of the world and of its rules is right all the same.
    /// </summary>
    Unresolved = 6,
}
