namespace LagSim.Hosting;

/// <summary>The kind of a notice: that of a <see cref="ContactNotice"/> and of a <see cref="CrossingNotice"/>, with the same numbers.</summary>
internal enum NoticeKind
{
    /// <summary>It is expected, or just found; a late event may still retract it.</summary>
    Predicted = 1,

    /// <summary>No late event can change it any more.</summary>
    Confirmed = 2,

    /// <summary>What was predicted does not happen.</summary>
    Retracted = 3,
}
