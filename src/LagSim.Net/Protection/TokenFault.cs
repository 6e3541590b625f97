namespace LagSim.Net.Protection;

/// <summary>What is wrong with a connect token.</summary>
public enum TokenFault
{
    /// <summary>Nothing.</summary>
    None,

    /// <summary>It is no token, or was changed.</summary>
    Damaged,

    /// <summary>Another backend issued it.</summary>
    OtherIssuer,

    /// <summary>It is for another host.</summary>
    OtherHost,

    /// <summary>Its time is over, by this host's clock.</summary>
    Expired,

    /// <summary>Its time has not begun, by this host's clock.</summary>
    NotYetValid,

    /// <summary>A player came in with it before.</summary>
    Used,
}
