namespace LagSim.Net.Wire;

/// <summary>Why a host does not let a client in. Never renumber.</summary>
internal enum RefusalReason : byte
{
    /// <summary>The two speak different versions of the wire format.</summary>
    VersionDiffers = 1,

    /// <summary>The client's scene is not the host's.</summary>
    SceneDiffers = 2,

    /// <summary>The client's connect key is not the host's.</summary>
    WrongKey = 3,

    /// <summary>The session has no free place.</summary>
    Full = 4,

    /// <summary>The world has grown too large to be copied.</summary>
    TooLarge = 5,

    /// <summary>The client computes worlds by other rules: another <see cref="Simulation.FoldVersion"/>.</summary>
    FoldDiffers = 6,

    /// <summary>The address has the most clients that it may have.</summary>
    TooManyFromOneAddress = 7,

    /// <summary>The host lets no client in from that machine: <see cref="Sessions.HostSession.Ban"/>.</summary>
    Banned = 8,

    /// <summary>The host's sessions are protected, and the client's are not.</summary>
    ProtectedOnly = 9,

    /// <summary>The host lets in only who has a connect token.</summary>
    TokenMissing = 10,

    /// <summary>The connect token is none, or was changed.</summary>
    TokenDamaged = 11,

    /// <summary>Another backend issued the connect token.</summary>
    TokenOfOtherIssuer = 12,

    /// <summary>The connect token is for another host.</summary>
    TokenOfOtherHost = 13,

    /// <summary>The time of the connect token is over.</summary>
    TokenExpired = 14,

    /// <summary>The time of the connect token has not begun.</summary>
    TokenNotYetValid = 15,

    /// <summary>A player came in with the connect token before.</summary>
    TokenUsed = 16,

    /// <summary>Too many wrong keys came from that machine: no key of it is looked at for a while.</summary>
    TooManyWrongKeys = 17,
}
