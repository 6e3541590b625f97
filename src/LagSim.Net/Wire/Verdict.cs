namespace LagSim.Net.Wire;

/// <summary>The host's verdict on an external event. Given once, never changed. Never renumber.</summary>
public enum Verdict : byte
{
    /// <summary>No verdict yet; the only one that a client sends.</summary>
    Pending = 0,

    /// <summary>It happened, on every peer.</summary>
    Accepted = 1,

    /// <summary>Refused: stamped before the watermark.</summary>
    TooLate = 2,

    /// <summary>Refused: stamped too far in the future.</summary>
    TooEarly = 3,

    /// <summary>Refused: its peer may not do this.</summary>
    NoRight = 4,

    /// <summary>Refused: it makes no sense in this scene.</summary>
    Invalid = 5,

    /// <summary>It happened, on every peer, at the time in the log: it came too late for the one with which its author stamped it.</summary>
    Moved = 6,
}
