namespace LagSim.Events;

/// <summary>What the host says of a player in a <see cref="PlayerEvent"/>. The numbers travel; never renumber.</summary>
/// <remarks>A player that joined is away or has left only after that, and one that is away returns or leaves.</remarks>
public enum PlayerEventKind : byte
{
    /// <summary>It is in: it was not before, or had left.</summary>
    Joined = 1,

    /// <summary>It is not heard any more, or went and may come back. Its number is kept for it meanwhile.</summary>
    Away = 2,

    /// <summary>It was away and is heard again, as the same person; its name or role may be another.</summary>
    Returned = 3,

    /// <summary>It has gone for good, or was away for so long that its number is kept no more.</summary>
    Left = 4,
}
